#include "core/statistics/robust_noise.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/statistics/intervals.hpp"

namespace mapproof {

namespace {

constexpr std::size_t kMostValues = 10'000;

int sign(double value) { return (value > 0.0) - (value < 0.0); }

/// Pettitt's K+: the largest U_t, each from the one before: U_t = U_(t-1) + sum over j of
/// sgn(x_j - x_t).
double largest_statistic(std::span<const double> x) {
  double u = 0.0;
  double largest = 0.0;
  for (const double value : x) {
    int sum = 0;
    for (const double other : x) sum += sign(other - value);
    u += sum;
    largest = std::max(largest, u);
  }
  return largest;
}

/// Each value as the median of itself and its two neighbours: a single outlier is removed.
std::vector<double> smoothed(std::span<const double> x) {
  std::vector<double> out(x.begin(), x.end());
  for (std::size_t i = 1; i + 1 < x.size(); ++i)
    out[i] = std::max(std::min(x[i - 1], x[i]), std::min(std::max(x[i - 1], x[i]), x[i + 1]));
  return out;
}

struct Fit {
  double squares = kInfinity;
  std::size_t first = 0;
  double slope = 0.0;
};

/// y = a + b max(0, f(i)) by least squares, f a step or a ramp from `first` on.
Fit fit_from(const std::vector<double>& y, std::size_t first, bool ramp) {
  const double n = static_cast<double>(y.size());
  double sx = 0, sxx = 0, sy = 0, sxy = 0, syy = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double x = i < first ? 0.0 : ramp ? static_cast<double>(i - first + 1) : 1.0;
    sx += x;
    sxx += x * x;
    sy += y[i];
    sxy += x * y[i];
    syy += y[i] * y[i];
  }
  const double spread = sxx - sx * sx / n;
  const double together = sxy - sx * sy / n;
  return {syy - sy * sy / n - together * together / spread, first, together / spread};
}

Fit best_fit(const std::vector<double>& y, bool ramp) {
  Fit best;
  for (std::size_t first = 1; first + 1 < y.size(); ++first) {
    const Fit fit = fit_from(y, first, ramp);
    if (fit.slope > 0.0 && fit.squares < best.squares) best = fit;
  }
  return best;
}

}  // namespace

ChangePoint rise_in(std::span<const double> values) {
  if (values.size() > kMostValues) throw InvalidInput("rise_in: more than 10,000 values");
  if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); }))
    throw InvalidInput("rise_in: a value is not finite");
  ChangePoint change{.values = static_cast<int>(values.size())};
  if (values.size() < 3) return change;
  const double n = static_cast<double>(values.size());
  const double k = largest_statistic(values);
  change.p = std::min(1.0, std::exp(-6.0 * k * k / (n * n * n + n * n)));

  std::vector<double> y = smoothed(values);
  const double middle = median(y);
  for (double& value : y) value -= middle;
  const Fit step = best_fit(y, false);
  const Fit ramp = best_fit(y, true);
  if (!std::isfinite(step.squares)) return change;  // Falls throughout.
  change.gradual = ramp.squares < step.squares;
  const Fit& best = change.gradual ? ramp : step;
  change.first = static_cast<int>(best.first);
  change.rise = change.gradual
                    ? best.slope * static_cast<double>(values.size() - best.first)
                    : median(values.subspan(best.first)) - median(values.subspan(0, best.first));
  return change;
}

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
