#pragma once

#include <span>

namespace mapproof {

/// Whether a series rose, and where.
struct ChangePoint {
  int values = 0;
  double p = 1.0;        ///< Of no change, against a rise.
  int first = 0;         ///< The first value of the changed part, counted from 0.
  bool gradual = false;  ///< A line that rises from `first` on fits better than a step there.
  double rise = 0.0;     ///< Step: median after less median before. Gradual: of the fitted line.
};

/// Pettitt's test for a change at an unknown index [pettitt1979], against a rise: by ranks, so that
/// a few outliers and the scale of the noise do not matter. p is his limit, too large for short
/// series. The index is that of the step, or of the bend into a rising line, that leaves the least
/// sum of squares of the values, outliers being clipped.
///
/// @param values  In order of time; finite.
/// @throws InvalidInput if one is not finite or there are more than 10,000.
/// @note O(n^2).
ChangePoint rise_in(std::span<const double> values);

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
