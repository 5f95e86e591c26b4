#include "core/association/held_out.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/association/log_blocks.hpp"
#include "core/base/median.hpp"
#include "core/pairs/pair_map.hpp"

namespace mapproof {
namespace {

constexpr int kHeldOutBlocks = 20;

/// Which half of the blocks a step is in: 0 or 1.
int half_of(int step, int steps) {
  return static_cast<int>(static_cast<long long>(step) * kHeldOutBlocks / std::max(1, steps)) % 2;
}

Points map_of_half(DetectionLog log, int half) {
  const int steps = log.steps;
  std::erase_if(log.detections,
                [&](const Detection& seen) { return half_of(seen.step, steps) != half; });
  return pair_map_of(log).embedding.coordinates;
}

/// Absolute residuals of the held-out pairs, by either map.
struct HeldOutResiduals {
  std::vector<double> given;
  std::vector<double> repaired;
  double longest = 0.0;
};

void add_half(const DetectionLog& log, const std::vector<ScanPair>& pairs, int half,
              const DetectionLog& repaired, HeldOutResiduals& residuals) {
  const Points given_map = map_of_half(log, 1 - half);
  const Points repaired_map = map_of_half(repaired, 1 - half);
  for (const ScanPair& pair : pairs) {
    if (half_of(pair.step, log.steps) != half) continue;
    const int a = log.detections[pair.first].landmark;
    const int b = log.detections[pair.second].landmark;
    const double given = (given_map.row(a) - given_map.row(b)).norm();
    const double other = (repaired_map.row(a) - repaired_map.row(b)).norm();
    if (!std::isfinite(given) || !std::isfinite(other)) continue;
    residuals.given.push_back(std::abs(pair.distance_m - given));
    residuals.repaired.push_back(std::abs(pair.distance_m - other));
    residuals.longest = std::max(residuals.longest, pair.distance_m);
  }
}

/// Mean log-likelihood under a mixture whose share of outliers is fitted by expectation
/// maximisation.
double mean_likelihood(const std::vector<double>& residuals, double sigma, double width) {
  constexpr int kRounds = 30;
  const double peak = 1.0 / (sigma * std::sqrt(2.0 * std::numbers::pi));
  double outliers = 0.1;
  double sum = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    double share = 0.0;
    sum = 0.0;
    for (const double residual : residuals) {
      const double normal = residual / sigma;
      const double inside = (1.0 - outliers) * peak * std::exp(-0.5 * normal * normal);
      const double outside = outliers / width;
      share += outside / (inside + outside);
      sum += std::log(inside + outside);
    }
    outliers = std::clamp(share / static_cast<double>(residuals.size()), 1e-4, 0.999);
  }
  return sum / static_cast<double>(residuals.size());
}

}  // namespace

HeldOutFit held_out_fit(const DetectionLog& given, const DetectionLog& repaired) {
  const std::vector<ScanPair> pairs = scan_pairs(given);
  HeldOutResiduals residuals;
  for (const int half : {0, 1}) add_half(given, pairs, half, repaired, residuals);
  HeldOutFit fit{.pairs = static_cast<int>(residuals.given.size())};
  if (fit.pairs == 0 || !(residuals.longest > 0.0)) return {};
  constexpr double kDeviation = 1.4826;
  const double sigma =
      std::max(kDeviation * std::min(median(residuals.given), median(residuals.repaired)),
               1e-4 * residuals.longest);
  fit.given = mean_likelihood(residuals.given, sigma, residuals.longest);
  fit.repaired = mean_likelihood(residuals.repaired, sigma, residuals.longest);
  return fit;
}

}  // namespace mapproof
