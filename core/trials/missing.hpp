#pragma once

#include "core/trials/topic.hpp"

namespace mapproof {

/// Missing entries: bearings with gaps at random, of a sensor of limited range, and behind other
/// landmarks; gaps are filled or left, and mapped, against the share that is missing.
extern const Topic kMissingTopic;

}  // namespace mapproof
