#pragma once

#include <span>

namespace mapproof {

/// A robust location and scale of values.
struct RobustNoise {
  double median = 0.0;
  double sigma = 0.0;  ///< 1.4826 times the median absolute deviation: a normal's standard
                       ///< deviation [rousseeuw1993].
  int values = 0;
};

/// NaN are left out; without any value all is 0. Up to half of the values may be outliers.
RobustNoise robust_noise(std::span<const double> values);

/// How far above the median one more value of the same normal noise lies with chance `p`, seen that
/// sigma was estimated from few values: Student's t quantile with half as many degrees of freedom
/// as there are values (the median absolute deviation is .37 as efficient as the standard
/// deviation), and the median's own error added.
/// @param floor  The least sigma that is accepted.
/// @throws InvalidInput unless 0 < p < 1 and floor >= 0.
double upper_limit(const RobustNoise& noise, double p, double floor);

}  // namespace mapproof
