#pragma once

#include "core/trials/topic.hpp"

namespace mapproof {

/// Errors of maps over the size of the room, the number and diameter of landmarks, the sensor's
/// reach, its noise, the steps and the number of anchors, by one factor or two at a time.
extern const Topic kSweepTopic;

}  // namespace mapproof
