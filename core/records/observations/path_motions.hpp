#pragma once

#include <vector>

#include "core/model/range_log.hpp"

namespace mapproof {

/// A start and the motions that lead from it along a path.
struct RecoveredOdometry {
  StartPose start;
  std::vector<Motion> motions;  ///< T - 1.
};

/// The odometry that integrates to the positions of `path`, whose headings are not looked at: each
/// pose heads for the next one, so the last turn is 0.
///
/// @param path  T >= 2 poses.
/// @param distances_m  T - 1, for their signs: where one is negative, the robot drove backwards.
///                     Empty: always forwards.
/// @note Steps below a nanometre keep the heading before them.
RecoveredOdometry motions_along(const Trajectory& path, const std::vector<double>& distances_m);

}  // namespace mapproof
