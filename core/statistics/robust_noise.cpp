#include "core/statistics/robust_noise.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/statistics/intervals.hpp"

namespace mapproof {

RobustNoise robust_noise(std::span<const double> values) {
  std::vector<double> known;
  for (const double value : values)
    if (!std::isnan(value)) known.push_back(value);
  if (known.empty()) return {};
  RobustNoise noise{.median = median(known), .values = static_cast<int>(known.size())};
  for (double& value : known) value = std::abs(value - noise.median);
  noise.sigma = 1.4826 * median(known);
  return noise;
}

double upper_limit(const RobustNoise& noise, double p, double floor) {
  if (!(p > 0.0 && p < 1.0)) throw InvalidInput("upper_limit: p must lie between 0 and 1");
  if (!(floor >= 0.0)) throw InvalidInput("upper_limit: the floor must not be negative");
  const double n = std::max(1, noise.values);
  const double freedom = std::max(2.0, 0.5 * n);
  // The variance of a median is pi / 2 times that of the mean.
  const double spread = std::sqrt(1.0 + 0.5 * std::numbers::pi / n);
  // What is floored is known, not estimated: a normal's quantile.
  const double estimated = noise.sigma * student_t_quantile(1.0 - p, freedom);
  const double believed = floor * student_t_quantile(1.0 - p, 1e6);
  return noise.median + spread * std::max(estimated, believed);
}

}  // namespace mapproof
