#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/model/detection_log.hpp"
#include "core/records/detections/detections.hpp"

namespace mapproof::test {

/// A set of the folder that MAPPROOF_MRCLAM names; empty if it names none.
std::optional<DetectionSource> real_scans(const std::string& set);

/// The robot of each step of pooled logs, from 0: times decrease where the next begins.
std::vector<int> robots_of(const DetectionLog& log);

/// The time before which half of the scans were.
double middle_time_s(const DetectionLog& log);

/// Detections of a landmark by one robot in scans that show others too.
int shared_detections(const DetectionLog& log, const std::vector<int>& robots, int robot,
                      int landmark);

/// A log with a fault of two landmark IDs: "half" or "tenth" of the scans at random with both
/// swapped, "stretch": swapped from .3 to .6 of the scans' times; "replaced30" or "replaced70":
/// detections of the first under the second's name in .3 of the scans at random, or in the last .7
/// of the time.
DetectionLog with_fault(const DetectionLog& log, const std::string& kind, int first, int second,
                        std::uint64_t seed);

/// Mean distance from the ground truth of the map that `mapproof map --sensor range-bearing --fit
/// rigid`
/// makes of a log, m.
double map_error_m(const DetectionLog& log, const Points& ground_truth_m);

}  // namespace mapproof::test
