#pragma once

#include "core/model/sighting_log.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {

/// The proximities of what one kind of sensor saw in some looks, without their array: equal to
/// those of history_of(log, sensor) up to rounding.
///
/// @throws InvalidInput if a sighting names no landmark.
/// @note O(sum of k^2) time over looks with k sightings, O(M^2) memory beside the log.
Proximities sighted_proximities(const SightingLog& log, Sensor sensor);

}  // namespace mapproof
