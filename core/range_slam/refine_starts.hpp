#pragma once

#include <cstdint>

#include "core/model/range_log.hpp"
#include "core/model/slam.hpp"

namespace mapproof {

/// Places of landmarks from their ranges along a path, each on its own: the best point of a grid
/// that reaches as far as the ranges, then Gauss and Newton's steps, robust against what drift
/// bends.
///
/// @param range_scale  Measured range over distance, > 0.
/// @return N x 2; NaN rows for landmarks with fewer than 3 readings within the path's time. Along a
///         straight path a landmark and its mirror image fit alike: which comes out is arbitrary.
/// @throws InvalidInput if the log or the path breaks its bounds.
Points trilaterated(const RangeLog& log, const Trajectory& path, double range_scale = 1.0);

/// Dead reckoning, and the landmarks that its path gives.
SlamEstimate dead_reckoning_start(const RangeLog& log);

/// Dead reckoning, and landmarks anywhere within reach of its path.
SlamEstimate random_start(const RangeLog& log, std::uint64_t seed);

/// A path at the times of another one, which leads from each of its poses to the next as odometry
/// does: T poses with headings, not wrapped.
///
/// @param path  n >= 1 poses at any times, with headings or not: without, they are those under
/// which
///              odometry fits the path around.
/// @param odometry  T poses, with headings.
Trajectory carried_along(const Trajectory& path, const Trajectory& odometry);

}  // namespace mapproof
