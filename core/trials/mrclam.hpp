#pragma once

#include "core/trials/topic.hpp"

namespace mapproof {

/// Real robots' looks at surveyed landmarks (MRCLAM [leung2011]): a map per kind of sensor and
/// method, without poses and odometry, against the survey; the pairs that range and bearing
/// measured, and how sure each landmark is.
extern const Topic kMrclamTopic;

}  // namespace mapproof
