#pragma once

#include "app/map/one_sensor.hpp"
#include "core/certainty/history_certainty.hpp"
#include "core/pairs/pair_map.hpp"
#include "core/records/observations/detections.hpp"

namespace mapproof {

/// Maps the distances that detections of range and bearing measured (core/pairs). With anchors the
/// map is fitted to them as `options.fit` says, or rigidly. Without, it is in metres all the same,
/// its place and turn arbitrary; if the truth is known, aligned to it rigidly for the errors.
/// @param rigid  Keep the scale: turn, shift and perhaps mirror the map onto the anchors.
/// @throws IoError as map_observations().
MapResult map_pairs(DetectionSource source, const std::optional<NamedPointsFile>& anchors,
                    const std::optional<NamedPointsFile>& truth, const MapOptions& options,
                    bool rigid);

/// Brings a map in metres into the frame of the anchors as asked for or, without any, of the truth
/// for its errors, and scores it.
/// @return How maps of other scans are brought to the same frame.
CertaintyFrame place_pairs(MapResult& result, const Reference& known, AffineFit fit, bool rigid);

/// What a map of pairs says of itself, and how many of all pairs it holds.
void describe_pairs(MapResult& result, const PairMap& map);

/// As map_observations() of what one kind of sensor saw, without an array of landmarks times scans.
MapResult map_sparse(DetectionSource source, Sensor sensor,
                     const std::optional<NamedPointsFile>& anchors,
                     const std::optional<NamedPointsFile>& truth, const MapOptions& options);

}  // namespace mapproof
