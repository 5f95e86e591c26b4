#include "core/statistics/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr double kTiny = 1e-300;

/// Continued fraction of the incomplete beta function by Lentz's method [thompson1986]; converges
/// fast for x < (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x) {
  const auto away_from_zero = [](double value) { return std::abs(value) < kTiny ? kTiny : value; };
  double c = 1.0;
  double d = 1.0 / away_from_zero(1.0 - (a + b) * x / (a + 1.0));
  double fraction = d;
  for (int m = 1; m <= 10000; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1.0 / away_from_zero(1.0 + even * d);
    c = away_from_zero(1.0 + even / c);
    fraction *= c * d;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1.0 / away_from_zero(1.0 + odd * d);
    c = away_from_zero(1.0 + odd / c);
    const double change = c * d;
    fraction *= change;
    if (std::abs(change - 1.0) < 1e-15) break;
  }
  return fraction;
}

/// P(T > t) for t >= 0.
double student_t_upper_tail(double t, double freedom) {
  return 0.5 * incomplete_beta(0.5 * freedom, 0.5, freedom / (freedom + t * t));
}

/// Sum over clusters of the squared sum of what values lie beside the mean.
double squared_cluster_sums(std::span<const double> values, std::span<const int> clusters,
                            double mean, int& count) {
  std::map<int, double> sums;
  for (std::size_t i = 0; i < values.size(); ++i) sums[clusters[i]] += values[i] - mean;
  count = static_cast<int>(sums.size());
  double total = 0.0;
  for (const auto& [cluster, sum] : sums) total += sum * sum;
  return total;
}

}  // namespace

MeanEstimate clustered_mean(std::span<const double> values, std::span<const int> clusters,
                            double confidence) {
  if (values.empty()) throw InvalidInput("clustered_mean: no value");
  if (values.size() != clusters.size())
    throw InvalidInput("clustered_mean: as many clusters as values are needed");
  if (!(confidence > 0.0 && confidence < 1.0))
    throw InvalidInput("clustered_mean: confidence must lie between 0 and 1");
  if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); }))
    throw InvalidInput("clustered_mean: a value is not finite");

  MeanEstimate estimate;
  estimate.values = static_cast<int>(values.size());
  const double n = static_cast<double>(values.size());
  // Divided first: a sum of huge values must not overflow.
  for (const double value : values) estimate.mean += value / n;
  const double squares = squared_cluster_sums(values, clusters, estimate.mean, estimate.clusters);
  if (estimate.clusters > 1) {
    // The variance of a ratio estimator over clusters, with the factor L / (L - 1) that makes it
    // that of the clusters' means where all have one size.
    const double L = estimate.clusters;
    const double standard_error = std::sqrt(L / (L - 1.0) * squares) / n;
    estimate.half_width = student_t_quantile(0.5 + 0.5 * confidence, L - 1.0) * standard_error;
  }
  return estimate;
}

double median(std::span<const double> values) {
  if (values.empty()) throw InvalidInput("median: no value");
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * sorted[half - 1] + 0.5 * sorted[half];
}

double incomplete_beta(double a, double b, double x) {
  if (!(a > 0.0 && b > 0.0 && x >= 0.0 && x <= 1.0))
    throw InvalidInput("incomplete_beta: a, b > 0 and 0 <= x <= 1 are needed");
  if (x == 0.0 || x == 1.0) return x;
  const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                a * std::log(x) + b * std::log1p(-x));
  if (x < (a + 1.0) / (a + b + 2.0)) return front * beta_fraction(a, b, x) / a;
  return 1.0 - front * beta_fraction(b, a, 1.0 - x) / b;
}

double student_t_quantile(double probability, double freedom) {
  if (!(probability > 0.0 && probability < 1.0))
    throw InvalidInput("student_t_quantile: probability must lie between 0 and 1");
  if (!(freedom > 0.0)) throw InvalidInput("student_t_quantile: freedom must be positive");
  if (probability == 0.5) return 0.0;
  if (probability < 0.5) return -student_t_quantile(1.0 - probability, freedom);

  // The tail falls from 1/2 to 0: bracket, then halve until the ends are neighbours.
  const double tail = 1.0 - probability;
  double low = 0.0;
  double high = 1.0;
  while (student_t_upper_tail(high, freedom) > tail && high < 1e150) {
    low = high;
    high *= 2.0;
  }
  for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (student_t_upper_tail(middle, freedom) > tail ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace mapproof
