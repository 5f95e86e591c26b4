#pragma once

#include <cstddef>
#include <vector>

#include "core/model/detection_log.hpp"

namespace mapproof {

/// Two detections of one scan that measured range and bearing both: their distance needs no pose.
struct ScanPair {
  int step = 0;
  std::size_t first = 0;  ///< Row among the log's detections; first < second.
  std::size_t second = 0;
  double distance_m = 0.0;  ///< By the law of cosines.
};

/// All pairs of detections in one scan, by step.
///
/// Of more than `most` those of every second, third, ... scan that shows any.
/// @throws InvalidInput if a detection names no landmark or no step of the log, steps descend, or a
///         value is infinite.
/// @note Linear in detections and pairs.
std::vector<ScanPair> scan_pairs(const DetectionLog& log, std::size_t most = 2'000'000);

/// The landmark that each detection of the log names: what may be doubted.
std::vector<int> given_labels(const DetectionLog& log);

}  // namespace mapproof
