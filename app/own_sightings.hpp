#pragma once

#include "app/own_map.hpp"
#include "core/records/sightings.hpp"

namespace mapproof {

/// Maps the distances that sightings of range and bearing measured (core/pairs). With anchors the
/// map is fitted to them as `options.fit` says, or rigidly. Without, it is in metres all the same,
/// its place and turn arbitrary; if the truth is known, laid on it rigidly for the errors.
/// @param rigid  Keep the scale: turn, shift and perhaps mirror the map onto the anchors.
/// @throws IoError as map_own().
OwnMap map_pairs(SightingSource source, const std::optional<NamedPointsFile>& anchors,
                 const std::optional<NamedPointsFile>& truth, const OwnMapOptions& options,
                 bool rigid);

/// As map_own() of what one kind of sensor saw, without an array of landmarks times looks.
OwnMap map_sparse(SightingSource source, Sensor sensor,
                  const std::optional<NamedPointsFile>& anchors,
                  const std::optional<NamedPointsFile>& truth, const OwnMapOptions& options);

}  // namespace mapproof
