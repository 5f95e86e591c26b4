#include "core/statistics/paired_change.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/statistics/intervals.hpp"
#include "core/statistics/signed_rank.hpp"

namespace mapproof {
namespace {

bool takes_ranks(int units, const PairedChangeOptions& options) {
  return least_signed_rank_p(units) <= options.finest_p;
}

bool are_equal(std::span<const double> differences) {
  constexpr double kShare = 0.005;
  const auto [least, most] = std::ranges::minmax(differences);
  const double largest = std::max(std::abs(least), std::abs(most));
  return largest > 0.0 && most - least <= kShare * largest;
}

/// How many Walsh averages lie outside the interval at either end, by the normal limit of the rank
/// sum [conover1999].
std::size_t averages_left_out(double n, double confidence) {
  const double z = boost::math::quantile(boost::math::normal(), 0.5 + 0.5 * confidence);
  const double sum = n * (n + 1.0) / 4.0 - z * std::sqrt(n * (n + 1.0) * (2.0 * n + 1.0) / 24.0);
  return static_cast<std::size_t>(std::max(0.0, std::floor(sum)));
}

/// The means of all pairs of values, each with itself too, in ascending order.
class WalshAverages {
 public:
  explicit WalshAverages(std::span<const double> values) : sorted_(values.begin(), values.end()) {
    std::ranges::sort(sorted_);
  }

  std::size_t size() const { return sorted_.size() * (sorted_.size() + 1) / 2; }

  /// The one that so many are before: of all doubles the least that more averages are not above.
  double operator[](std::size_t before) const {
    std::uint64_t low = rank_of(sorted_.front()), high = rank_of(sorted_.back());
    while (low < high) {
      const std::uint64_t middle = low + (high - low) / 2;
      if (count_up_to(of_rank(middle)) > before)
        high = middle;
      else
        low = middle + 1;
    }
    return of_rank(low) + 0.0;  // Not -0.
  }

  double median() const {
    const std::size_t half = size() / 2;
    return size() % 2 == 1 ? (*this)[half] : 0.5 * (*this)[half - 1] + 0.5 * (*this)[half];
  }

 private:
  static constexpr std::uint64_t kSign = std::uint64_t{1} << 63;

  /// Where a double stands among all of them.
  static std::uint64_t rank_of(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    return (bits & kSign) != 0 ? ~bits : bits | kSign;
  }
  static double of_rank(std::uint64_t rank) {
    return std::bit_cast<double>((rank & kSign) != 0 ? rank & ~kSign : ~rank);
  }

  /// Rounding keeps the order: of a row, and of a column, of averages.
  std::size_t count_up_to(double value) const {
    std::size_t count = 0;
    std::size_t end = sorted_.size();
    for (std::size_t i = 0; i < end; ++i) {
      while (end > i && 0.5 * sorted_[i] + 0.5 * sorted_[end - 1] > value) --end;
      count += end - i;
    }
    return count;
  }

  std::vector<double> sorted_;
};

void judge_by_ranks(std::span<const double> differences, double confidence, PairedChange& change) {
  change.by_ranks = true;
  change.p = change.ranks.p;
  const WalshAverages averages(differences);
  change.shift = averages.median();
  const std::size_t out =
      std::min(averages_left_out(static_cast<double>(differences.size()), confidence),
               (averages.size() - 1) / 2);
  change.low = averages[out];
  change.high = averages[averages.size() - 1 - out];
}

void judge_by_t(std::span<const double> differences, double confidence, PairedChange& change) {
  const double n = static_cast<double>(differences.size());
  for (const double difference : differences) change.shift += difference / n;
  change.low = -kInfinity;
  change.high = kInfinity;
  if (differences.size() < 2) return;
  double squares = 0.0;
  for (const double difference : differences)
    squares += (difference - change.shift) * (difference - change.shift);
  const double error = std::sqrt(squares / (n - 1.0) / n);
  const double half_width = student_t_quantile(0.5 + 0.5 * confidence, n - 1.0) * error;
  change.low = change.shift - half_width;
  change.high = change.shift + half_width;
  if (error == 0.0) {
    change.p = change.shift == 0.0 ? 1.0 : 0.0;
    return;
  }
  const boost::math::students_t t(n - 1.0);
  change.p = 2.0 * boost::math::cdf(boost::math::complement(t, std::abs(change.shift) / error));
}

}  // namespace

double least_paired_p(int units, const PairedChangeOptions& options) {
  if (units < 2) return 1.0;
  return takes_ranks(units, options) ? least_signed_rank_p(units) : 0.0;
}

PairedChange paired_change(std::span<const double> differences,
                           const PairedChangeOptions& options) {
  if (differences.empty()) throw InvalidInput("paired_change: no difference");
  if (!(options.confidence > 0.0 && options.confidence < 1.0))
    throw InvalidInput("paired_change: confidence must lie between 0 and 1");
  if (!std::ranges::all_of(differences, [](double value) { return std::isfinite(value); }))
    throw InvalidInput("paired_change: a difference is not finite");
  PairedChange change{.units = static_cast<int>(differences.size()),
                      .equal = are_equal(differences),
                      .ranks = signed_rank_test(differences)};
  if (takes_ranks(change.units, options))
    judge_by_ranks(differences, options.confidence, change);
  else
    judge_by_t(differences, options.confidence, change);
  return change;
}

}  // namespace mapproof
