#pragma once

#include "core/trials/topic.hpp"

namespace mapproof {

/// Whether several kinds of sensor in one map are better than the best of them alone.
extern const Topic kMixedTopic;

}  // namespace mapproof
