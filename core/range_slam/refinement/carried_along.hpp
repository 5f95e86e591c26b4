#pragma once

#include "core/model/range_log.hpp"

namespace mapproof {

/// A path at the times of another one, which leads from each of its poses to the next as odometry
/// does: T poses with headings, not wrapped.
///
/// @param path  n >= 1 poses at any times, with headings or not: without, they are those under
///              which odometry fits the path around. Those of no finite position are left out.
/// @param odometry  T poses, with headings.
/// @throws InvalidInput for a times_problem() of either, a heading that is not finite, or if no
///         pose of `path` is within the time of the odometry.
/// @note O(n + T log n).
Trajectory carried_along(const Trajectory& path, const Trajectory& odometry);

}  // namespace mapproof
