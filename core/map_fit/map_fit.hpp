#pragma once

#include <vector>

#include "core/association/association_check.hpp"
#include "core/map_fit/pair_fit.hpp"
#include "core/model/detection_log.hpp"
#include "core/model/fit.hpp"
#include "core/model/points.hpp"

namespace mapproof {

// When a test of a map of range and bearing is an alarm. The bounds are set between what 72 sound
// logs of MRCLAM show (sets 1, 2, 3 and 6, their robots and the halves of both) and what faults put
// into them do: docs/methods/map-fit.md has both.
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

}  // namespace mapproof
