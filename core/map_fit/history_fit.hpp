#pragma once

#include "core/model/fit.hpp"
#include "core/model/observation_history.hpp"
#include "core/model/points.hpp"

namespace mapproof {

// When a test of a map of one sensor is an alarm: docs/methods/map-fit.md has what they were set
// on.
inline constexpr double kMostExchangeGain = 2.0;      ///< Of the median change of a landmark,
inline constexpr double kMostGainIfMissing = 6.0;     ///< and if much of the history is missing.
inline constexpr double kMostKnownShare = 0.8;        ///< Of the spread of the known positions.
inline constexpr double kMostKnownShareOfReal = 0.4;  ///< Where pairs give a better map, as MRCLAM.
inline constexpr int kFewestStepsToTest = 60;         ///< For tests over time.

/// Whether the observations of one sensor fit its map. They have no unit in which the map could be
/// compared with them, but they repeat: at each of five times the distances of the observation
/// vectors before are compared with those after.
///
/// kIdsExchanged: two landmarks whose distances to the others agree better if their IDs are
/// exchanged after some time. kWeakBridge, kDisconnected: groups of landmarks with few common
/// steps, or none. With five known positions or more: what an affine fit of the map misses them by,
/// and whether one of them, or an exchange of two, explains it.
/// @param map  M x 2, in any affine frame; NaN rows: not mapped.
/// @param known_m  M x 2; NaN rows: unknown.
/// @param most_known_share  Bound of kKnownLandmarksAtOdds. Some methods are far off in sound
/// worlds.
/// @note O(M^2 N) for each time, of at most some 4e6 entries.
Fit history_fit(const ObservationHistory& history, Eigen::Index steps, const Points& map,
                const Points& known_m, double most_known_share = kMostKnownShare);

}  // namespace mapproof
