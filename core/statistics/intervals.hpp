#pragma once

#include <optional>
#include <span>

namespace mapproof {

/// A mean with its uncertainty.
struct MeanEstimate {
  double mean = 0.0;
  int values = 0;
  int clusters = 0;                  ///< Independent units among the values.
  std::optional<double> half_width;  ///< Of the confidence interval; empty with one cluster.
};

/// Mean of values, and its confidence interval where values of one cluster are not independent
/// (runs in one layout): Student's t over the clusters. With equally many values in each, it is the
/// t interval of the clusters' means.
///
/// @param clusters    The cluster of each value, as many as values.
/// @param confidence  In (0, 1).
/// @throws InvalidInput if there is no value, a value is not finite, or a bound is broken.
MeanEstimate clustered_mean(std::span<const double> values, std::span<const int> clusters,
                            double confidence = 0.95);

/// The x below which Student's t with `freedom` degrees lies with `probability`.
/// @throws InvalidInput unless 0 < probability < 1 and freedom > 0.
double student_t_quantile(double probability, double freedom);

}  // namespace mapproof
