#include "core/missing/missing_pattern.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

constexpr std::array kRecommendationNames = {
    std::string_view("pairwise-complete"), std::string_view("ppca"), std::string_view("covisible")};
constexpr double kFewSteps = 5.0;
constexpr double kPatterned = 2.0;  ///< Dispersion above this is not random.
/// Nearness below this: a sensor of short range. Landmarks that hide leave -0.2 to -0.65; where the
/// range is limited, filling in costs a map far more than pairs cost one of the other kind.
constexpr double kByDistance = -0.66;
constexpr double kManyApart = 0.15;  ///< Of pairs with few shared steps: no model can fill them.

/// Ranks from 1; equal values have their mean rank.
std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return values[k]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first + 1;
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    for (std::size_t k = first; k < end; ++k)
      ranks[order[k]] = 0.5 * static_cast<double>(first + 1 + end);
    first = end;
  }
  return ranks;
}

/// Spearman's; 0 where either does not vary.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> x = ranks_of(a), y = ranks_of(b);
  const double middle = 0.5 * static_cast<double>(x.size() + 1);
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - middle) * (x[k] - middle);
    yy += (y[k] - middle) * (y[k] - middle);
    xy += (x[k] - middle) * (y[k] - middle);
  }
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 0.0;
}

/// Standard deviations of a pair's number of shared steps from that at random (hypergeometric).
double excess(double common, double a, double b, double steps) {
  const double expected = a * b / steps;
  const double variance = expected * (1.0 - a / steps) * (1.0 - b / steps);
  return variance > 1e-9 ? (common - expected) / std::sqrt(variance) : 0.0;
}

}  // namespace

MissingPattern missing_pattern(const HistoryBlocks& history, Eigen::Index steps) {
  require_steps(history, steps);
  MissingPattern pattern;
  const Eigen::Index M = history.landmarks();
  const auto N = static_cast<double>(steps);
  if (M == 0 || history.is_complete()) return pattern;
  double observed = 0.0;
  for_blocks(history, steps, [&](Eigen::Index, const Eigen::MatrixXd& values) {
    observed += static_cast<double>((values.array() == values.array()).count());
  });
  pattern.missing_share = 1.0 - observed / (static_cast<double>(M) * N);
  if (M < 2 || pattern.missing_share == 0.0) return pattern;
  const Eigen::MatrixXd common = steps_observed_together(history, steps);
  const Eigen::MatrixXd D = proximities(history, steps).squared_distances;
  std::vector<double> excesses, distances;
  double squares = 0.0;
  const double pairs = 0.5 * static_cast<double>(M) * static_cast<double>(M - 1);
  for (Eigen::Index j = 0; j < M; ++j)
    for (Eigen::Index i = j + 1; i < M; ++i) {
      const double z = excess(common(i, j), common(i, i), common(j, j), N);
      squares += z * z;
      pattern.apart_share += common(i, j) < 1.0 ? 1.0 / pairs : 0.0;
      pattern.few_share += common(i, j) < kFewSteps ? 1.0 / pairs : 0.0;
      if (!std::isfinite(D(i, j))) continue;
      excesses.push_back(z);
      distances.push_back(D(i, j));
    }
  pattern.dispersion = std::sqrt(squares / pairs);
  pattern.nearness = rank_correlation(excesses, distances);
  return pattern;
}

std::string_view name(MissingStrategy strategy) {
  return kRecommendationNames[static_cast<std::size_t>(strategy)];
}

StrategyAdvice advised_strategy(const MissingPattern& pattern, Sensor sensor) {
  if (pattern.missing_share == 0.0)
    return {MissingStrategy::kPairwiseComplete, StrategyReason::kNothingMissing};
  if (sensor == Sensor::kVisibility)
    return {MissingStrategy::kPairwiseComplete, StrategyReason::kOfVisibility};
  const bool patterned = pattern.dispersion > kPatterned;
  if (sensor == Sensor::kRange && patterned && pattern.few_share > kManyApart)
    return {MissingStrategy::kCovisible, StrategyReason::kHardlyEver};
  if (sensor == Sensor::kBearing && patterned && pattern.nearness < kByDistance)
    return {MissingStrategy::kPairwiseComplete, StrategyReason::kByDistance};
  return {MissingStrategy::kPpca,
          patterned ? StrategyReason::kByAPattern : StrategyReason::kAtRandom};
}

double median_disagreement(const Proximities& filled, const Proximities& common) {
  const Eigen::MatrixXd& D = common.squared_distances;
  if (filled.squared_distances.rows() != D.rows())
    throw InvalidInput("the compared distances must be of the same landmarks");
  std::vector<double> shares;
  for (Eigen::Index j = 0; j < D.cols(); ++j)
    for (Eigen::Index i = j + 1; i < D.rows(); ++i)
      if (std::isfinite(D(i, j)) && D(i, j) > 0.0)
        shares.push_back(std::abs(std::sqrt(filled.squared_distances(i, j) / D(i, j)) - 1.0));
  if (shares.empty()) return kNaN;
  return upper_median(std::move(shares));
}

}  // namespace mapproof
