#pragma once

#include "core/model/range_log.hpp"

namespace mapproof {

/// Positions of a path at other times, on straight lines between its poses: n x 2, one row per
/// time; NaN before its first and after its last pose.
/// @throws InvalidInput for a times_problem() of the path.
/// @note O(T + n log T).
Points positions_at(const Trajectory& path, const Eigen::VectorXd& times_s);

}  // namespace mapproof
