#pragma once

#include "core/model/points.hpp"
#include "core/model/sighting_log.hpp"

namespace mapproof {

/// Whether the looks show triples of landmarks the other way round than the map has them, more of
/// their area than not. Looks with range and bearing of three mapped landmarks or more tell; no if
/// there are none.
/// @param map  M x 2; NaN rows: not mapped.
/// @note Linear in the sightings: in each look the triples of neighbours by number.
bool seen_mirrored(const SightingLog& log, const Points& map);

}  // namespace mapproof
