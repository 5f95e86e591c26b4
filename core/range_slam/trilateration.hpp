#pragma once

#include "core/model/range_log.hpp"

namespace mapproof {

/// Positions of landmarks from their ranges along a path, each on its own: the best point of a grid
/// that reaches as far as the ranges, then Gauss and Newton's steps, robust against what drift
/// bends.
///
/// @param range_scale  Measured range over distance, > 0.
/// @return N x 2; NaN rows for landmarks with fewer than 3 measurements within the path's time.
/// Along a
///         straight path a landmark and its mirror image fit alike: which comes out is arbitrary.
/// @throws InvalidInput unless the range scale is positive; for ranges that check_ranges() refuses,
///         or a path_problem().
/// @note O(T + R log T) time for R measurements; for each landmark a grid of 41 x 41 positions with
/// 200
///       measurements, and at most 50 rounds over all of its measurements.
Points trilaterated(const RangeLog& log, const Trajectory& path, double range_scale = 1.0);

}  // namespace mapproof
