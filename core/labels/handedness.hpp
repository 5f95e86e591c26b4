#pragma once

#include "core/model/points.hpp"
#include "core/model/sighting_log.hpp"

namespace mapproof {

/// A map of a log's pairs, mirrored if that is what most looks at three landmarks or more say:
/// distances leave the hand open, bearings tell it.
/// @param map  M x 2; NaN rows: unmapped.
/// @return As given where looks say nothing or as much for the one as for the other.
/// @note Linear in the sightings.
Points with_hand_of_looks(const SightingLog& log, Points map);

}  // namespace mapproof
