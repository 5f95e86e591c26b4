#include "core/statistics/signed_rank.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <boost/math/distributions/normal.hpp>

#include "core/base/errors.hpp"
#include "core/statistics/ties.hpp"

namespace mapproof {
namespace {

constexpr int kMostExact = 200;

/// The chance that the sum of ranks with a fair sign each is at most `sum`. Doubled ranks are
/// whole, ties or not.
double chance_of_at_most(const std::vector<double>& ranks, double sum) {
  const double all = std::accumulate(ranks.begin(), ranks.end(), 0.0);
  const auto top = static_cast<std::size_t>(std::lround(2.0 * all));
  std::vector<double> chance(top + 1, 0.0);
  chance[0] = 1.0;
  std::size_t reached = 0;
  for (const double rank : ranks) {
    const auto step = static_cast<std::size_t>(std::lround(2.0 * rank));
    reached += step;
    for (std::size_t s = reached + 1; s-- > 0;)
      chance[s] = 0.5 * (chance[s] + (s >= step ? chance[s - step] : 0.0));
  }
  const auto end = static_cast<std::size_t>(std::lround(2.0 * sum)) + 1;
  return std::accumulate(chance.begin(), chance.begin() + static_cast<std::ptrdiff_t>(end), 0.0);
}

/// Of the ranks of sizes, ties sharing theirs.
struct RankSums {
  double plus = 0.0, minus = 0.0, squares = 0.0;

  double all() const { return plus + minus; }
  double lesser() const { return std::min(plus, minus); }
};

/// @param differences  Which are put in the order of their sizes: ranks take no memory.
/// @param ranks  Gets the rank of each, unless it is null.
RankSums rank_sums(std::vector<double>& differences, std::vector<double>* ranks) {
  std::ranges::sort(differences, {}, [](double value) { return std::abs(value); });
  RankSums sums;
  const auto same = [&](std::size_t a, std::size_t b) {
    return std::abs(differences[a]) == std::abs(differences[b]);
  };
  for_each_tie(differences.size(), same, [&](std::size_t first, std::size_t end, double rank) {
    for (; first < end; ++first) {
      (differences[first] > 0.0 ? sums.plus : sums.minus) += rank;
      sums.squares += rank * rank;
      if (ranks != nullptr) ranks->push_back(rank);
    }
  });
  return sums;
}

/// Of the lesser rank sum. The variance is n (n + 1) (2n + 1) / 24, less (t^3 - t) / 48 for each t
/// that tie: a quarter of the sum of squared ranks.
double normal_p(const RankSums& sums) {
  const double from_mean = 0.5 * sums.all() - sums.lesser() - 0.5;
  if (from_mean <= 0.0) return 1.0;
  const double z = from_mean / std::sqrt(0.25 * sums.squares);
  return 2.0 * boost::math::cdf(boost::math::complement(boost::math::normal(), z));
}

}  // namespace

SignedRankTest signed_rank_test(std::span<const double> differences) {
  SignedRankTest test;
  test.pairs = static_cast<int>(differences.size());
  std::vector<double> nonzero;
  nonzero.reserve(differences.size());
  for (const double difference : differences) {
    if (!std::isfinite(difference))
      throw InvalidInput("signed_rank_test: a difference is not finite");
    if (difference != 0.0) nonzero.push_back(difference);
  }
  test.nonzero = static_cast<int>(nonzero.size());
  if (nonzero.empty()) return test;

  test.exact = test.nonzero <= kMostExact;
  std::vector<double> ranks;  // Of few.
  const RankSums sums = rank_sums(nonzero, test.exact ? &ranks : nullptr);
  test.rank_sum_plus = sums.plus;
  test.rank_sum_minus = sums.minus;
  test.effect = (sums.plus - sums.minus) / sums.all();
  test.p =
      std::min(1.0, test.exact ? 2.0 * chance_of_at_most(ranks, sums.lesser()) : normal_p(sums));
  return test;
}

double least_signed_rank_p(int pairs) { return pairs < 1 ? 1.0 : std::ldexp(2.0, -pairs); }

std::vector<double> holm(std::span<const double> p) {
  for (const double value : p)
    if (!(value >= 0.0 && value <= 1.0)) throw InvalidInput("holm: a p is not in [0, 1]");
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p[i]; });
  std::vector<double> corrected(p.size());
  double most = 0.0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    most = std::max(most, static_cast<double>(p.size() - rank) * p[order[rank]]);
    corrected[order[rank]] = std::min(1.0, most);
  }
  return corrected;
}

}  // namespace mapproof
