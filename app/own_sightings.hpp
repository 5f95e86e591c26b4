#pragma once

#include "app/own_map.hpp"
#include "core/certainty/history_certainty.hpp"
#include "core/pairs/pair_map.hpp"
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

/// Brings a map in metres into the frame of the anchors as asked for or, without any, of the truth
/// for its errors, and scores it.
/// @return How maps of other looks are brought to the same frame.
CertaintyFrame place_pairs(OwnMap& result, const Reference& known, AffineFit fit, bool rigid);

/// What a map of pairs says of itself, and how many of all pairs it holds.
void describe_pairs(OwnMap& result, const PairMap& map);

/// As map_own() of what one kind of sensor saw, without an array of landmarks times looks.
OwnMap map_sparse(SightingSource source, Sensor sensor,
                  const std::optional<NamedPointsFile>& anchors,
                  const std::optional<NamedPointsFile>& truth, const OwnMapOptions& options);

}  // namespace mapproof
