#pragma once

#include <vector>

#include "core/model/detection_log.hpp"
#include "core/model/points.hpp"

namespace mapproof {

/// Whether the scans show triples of landmarks with the opposite orientation to the map's, for more
/// of their area than not. Uses scans with range and bearing of three mapped landmarks or more;
/// false if there are none.
/// @param map  M x 2; NaN rows: not mapped.
/// @note Linear in the detections: in each scan the triples of neighbours by number.
bool seen_mirrored(const DetectionLog& log, const Points& map);

/// The orientation in which scans show three landmarks.
struct SeenOrientation {
  int first = 0;  ///< Landmarks, first < second < third.
  int second = 0;
  int third = 0;
  int scans = 0;           ///< With range and bearing of all three.
  double direction = 0.0;  ///< 1: counter-clockwise in all scans, -1: clockwise; near 0 for three
                           ///< that stand on a line, or whose IDs are confused.
};

/// The triples that scans show; of scans of more than 8 landmarks those of neighbours by number.
/// @note O(56 detections log triples) time.
std::vector<SeenOrientation> seen_turns(const DetectionLog& log);

/// The triples whose orientation on the map, or on its reflection if that has fewer, differs from
/// the scans', and whose three landmarks clearly are not on one line.
std::vector<SeenOrientation> at_other_orientation(const std::vector<SeenOrientation>& turns,
                                                  const Points& map);

/// In how many scans the orientation differs from the map's, or from its reflection's if that is
/// less.
/// @param most_scans  More scans of a triple do not count.
/// @param map  M x 2; triples with NaN rows do not count.
double scans_at_other_orientation(const std::vector<SeenOrientation>& turns, const Points& map,
                                  double most_scans);

}  // namespace mapproof
