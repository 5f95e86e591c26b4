#pragma once

#include "core/trials/topic.hpp"

namespace mapproof {

/// Confused labels: bearings whose landmarks are not told apart, entry by entry or row by row over
/// stretches; the correspondence is estimated with the map, against the share that is confused.
extern const Topic kLabelsTopic;

}  // namespace mapproof
