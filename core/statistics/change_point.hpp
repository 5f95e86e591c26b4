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

}  // namespace mapproof
