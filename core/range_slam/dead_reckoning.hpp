#pragma once

#include "core/model/range_log.hpp"

namespace mapproof {

/// The path that odometry alone gives from the log's start: T poses for T - 1 motions. Headings are
/// not wrapped.
/// @throws InvalidInput if the log has no odometry, holds a number that is not finite, or its times
/// do not ascend from the start.
Trajectory dead_reckoned(const RangeLog& log);

}  // namespace mapproof
