#pragma once

#include "core/trials/topic.hpp"

namespace mapproof {

/// Landmarks that move once: how far they must for the move to be noticed, named and dated, and how
/// often one is named that did not move.
extern const Topic kMovedTopic;

}  // namespace mapproof
