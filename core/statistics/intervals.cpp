#include "core/statistics/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <boost/math/distributions/students_t.hpp>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

/// Sum over clusters of the squared sum of the values' deviations from the mean.
double squared_cluster_sums(std::span<const double> values, std::span<const int> clusters,
                            double mean, int& count) {
  std::vector<std::size_t> order;  // Empty: as they are.
  if (!std::ranges::is_sorted(clusters)) {
    order.resize(values.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return clusters[i]; });
  }
  const auto at = [&](std::size_t i) { return order.empty() ? i : order[i]; };
  count = 0;
  double total = 0.0;
  for (std::size_t first = 0; first < values.size(); ++count) {
    const int cluster = clusters[at(first)];
    double sum = 0.0;
    for (; first < values.size() && clusters[at(first)] == cluster; ++first)
      sum += values[at(first)] - mean;
    total += sum * sum;
  }
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

double student_t_quantile(double probability, double freedom) {
  if (!(probability > 0.0 && probability < 1.0))
    throw InvalidInput("student_t_quantile: probability must lie between 0 and 1");
  if (!(freedom > 0.0)) throw InvalidInput("student_t_quantile: freedom must be positive");
  return boost::math::quantile(boost::math::students_t(freedom), probability);
}

}  // namespace mapproof
