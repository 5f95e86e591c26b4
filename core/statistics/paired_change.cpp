#include "core/statistics/paired_change.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/statistics/intervals.hpp"
#include "core/statistics/signed_rank.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostUnits = 2000;

bool takes_ranks(int units, const PairedChangeOptions& options) {
  return least_signed_rank_p(units) <= options.finest_p;
}

/// How many Walsh averages lie outside the interval at either end, by the normal limit of the rank
/// sum [conover1999].
std::size_t averages_left_out(double n, double confidence) {
  const double z = boost::math::quantile(boost::math::normal(), 0.5 + 0.5 * confidence);
  const double sum = n * (n + 1.0) / 4.0 - z * std::sqrt(n * (n + 1.0) * (2.0 * n + 1.0) / 24.0);
  return static_cast<std::size_t>(std::max(0.0, std::floor(sum)));
}

void judge_by_ranks(std::span<const double> differences, double confidence, PairedChange& change) {
  std::vector<double> averages;
  averages.reserve(differences.size() * (differences.size() + 1) / 2);
  for (std::size_t i = 0; i < differences.size(); ++i)
    for (std::size_t j = i; j < differences.size(); ++j)
      averages.push_back(0.5 * differences[i] + 0.5 * differences[j]);
  std::ranges::sort(averages);
  change.by_ranks = true;
  change.shift = median(averages);
  const std::size_t out =
      std::min(averages_left_out(static_cast<double>(differences.size()), confidence),
               (averages.size() - 1) / 2);
  change.low = averages[out];
  change.high = averages[averages.size() - 1 - out];
  change.p = signed_rank_test(differences).p;
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
  if (differences.empty() || differences.size() > kMostUnits)
    throw InvalidInput("paired_change: from 1 to 2000 differences are needed");
  if (!(options.confidence > 0.0 && options.confidence < 1.0))
    throw InvalidInput("paired_change: confidence must lie between 0 and 1");
  if (!std::ranges::all_of(differences, [](double value) { return std::isfinite(value); }))
    throw InvalidInput("paired_change: a difference is not finite");
  PairedChange change{.units = static_cast<int>(differences.size())};
  if (takes_ranks(change.units, options))
    judge_by_ranks(differences, options.confidence, change);
  else
    judge_by_t(differences, options.confidence, change);
  return change;
}

}  // namespace mapproof
