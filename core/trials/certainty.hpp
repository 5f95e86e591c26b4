#pragma once

#include "core/trials/topic.hpp"

namespace mapproof {

/// How often the ellipses of a map hold the mean of the maps of many walks in the same world, and
/// how often the truth: by sensor, method and number of steps, and by the length of the blocks.
extern const Topic kCertaintyTopic;

}  // namespace mapproof
