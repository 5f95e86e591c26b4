#pragma once

#include <vector>

#include "core/association/association_check.hpp"
#include "core/map_fit/pair_fit.hpp"
#include "core/model/detection_log.hpp"
#include "core/model/fit.hpp"
#include "core/model/histories/history_blocks.hpp"
#include "core/model/points.hpp"

namespace mapproof {

// When a test of a map of range and bearing is an alarm. The bounds are set between what 72
// fault-free logs of MRCLAM show (sets 1, 2, 3 and 6, their robots and the halves of both) and what
// faults put into them do: docs/methods/map-fit.md has both.
inline constexpr double kMostGross = 0.05;     ///< ScatterFit::gross.
inline constexpr double kMostRelative = 0.12;  ///< ScatterFit::relative, if the tail is heavy,
inline constexpr double kMostTail = 3.3;       ///< ScatterFit::tail, if the scatter is large.
inline constexpr double kMostRatio = 0.15;     ///< Logarithm of RobotFit::ratio.
inline constexpr double kMostMirrored = 0.5;   ///< RobotFit::mirrored.
inline constexpr double kLeastLossFall = 0.2;  ///< Share of the loss that a wrong ID explains.
inline constexpr double kMostMisfits = 3.0;    ///< KnownFit::misfit_m, in standard deviations.
inline constexpr double kMostScale = 0.1;      ///< Logarithm of KnownFit::scale.
inline constexpr double kWeak = 0.1;           ///< WeakMode::sigma_m, of the median distance:
inline constexpr double kOpen = 0.3;           ///< doubtful, and undetermined.
inline constexpr int kFewestPairs = 20;        ///< Pairs of detections, to test at all,
inline constexpr int kFewestForIds =
    400;  ///< and for scatter and wrong IDs to be more than doubtful.

/// What is known besides the scans and the map; null: not asked.
struct MapEvidence {
  const Points* known_m = nullptr;  ///< M x 2; NaN rows: unknown.
  const AssociationCheck* association = nullptr;
};

/// Whether the scans fit a map of range and bearing: the tests of pair_fit(), known positions of
/// the largest part by known_fit(), and what checks of the landmark IDs found.
///
/// kUndetermined if the map falls into parts of three landmarks or more, or a mode of it is open;
/// kNotTestable without redundancy. Of the others the gravest cause decides.
/// @param map  As pair_fit() takes it.
Fit range_bearing_fit(const DetectionLog& log, const Points& map, const MapEvidence& evidence);

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
/// exchanged after some time. kWeakBridge, kDisconnected: groups of landmarks with few steps
/// in common, or none. With five known positions or more: what an affine fit of the map misses them
/// by, and whether one of them, or an exchange of two, explains it.
/// @param map  M x 2, in any affine frame; NaN rows: not mapped.
/// @param known_m  M x 2; NaN rows: unknown.
/// @param most_known_share  Bound of kKnownLandmarksAtOdds. Some methods are far off in sound
/// worlds.
/// @note O(M^2 N) for each time, of at most some 4e6 entries.
Fit history_fit(const HistoryBlocks& history, Eigen::Index steps, const Points& map,
                const Points& known_m, double most_known_share = kMostKnownShare);

/// Adds tests that were made after the others, in the frame of the anchors, and those of them that
/// exceed their bounds as causes. The verdict is that of all causes; a fit that could not be tested
/// stays so unless there is a cause.
Fit with_tests(Fit fit, std::vector<FitCause> tests);

}  // namespace mapproof
