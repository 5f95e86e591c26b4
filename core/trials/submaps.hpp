#pragma once

#include "core/trials/topic.hpp"

namespace mapproof {

/// Sub-maps against the whole map: by their size, by their overlap, and where a sensor of limited
/// range leaves gaps.
extern const Topic kSubmapsTopic;

}  // namespace mapproof
