#pragma once

#include <cstddef>
#include <vector>

#include "core/model/detection_log.hpp"

namespace mapproof {

/// Two detections of one scan that both measured range and bearing: their distance needs no pose.
struct ScanPair {
  int step = 0;
  std::size_t first = 0;  ///< Row among the log's detections; first < second.
  std::size_t second = 0;
  double distance_m = 0.0;  ///< By the law of cosines.
};

/// All pairs of detections in one scan, by step.
///
/// If there are more than `most`: those of every second, third, ... scan that has any.
/// @throws InvalidInput if a detection names no landmark or no step of the log, steps descend, or a
///         value is infinite.
/// @note Linear in detections and pairs.
std::vector<ScanPair> scan_pairs(const DetectionLog& log, std::size_t most = 2'000'000);

/// The landmark that each detection of the log names: the data association under test.
std::vector<int> given_ids(const DetectionLog& log);

/// A log cut into stretches within which errors are correlated, and IDs are taken to be right or
/// wrong all together.
struct LogBlocks {
  int count = 0;
  std::vector<int> of_step;  ///< The block of each step of the log.
  /// The steps in orders in which IDs may be wrong over an interval: as they are given (robot by
  /// robot) and, if that differs, by time. Each is a permutation of all steps.
  std::vector<std::vector<int>> step_orders;
  std::vector<std::vector<int>> block_orders;  ///< The blocks in the same orders.
  std::vector<int> slice;  ///< Of each block: its index in time, 0 first; robots share slices.
};

/// Cuts a log: where times decrease another robot begins (up to 64, else the times are ignored),
/// and all robots are cut at common times, so that the slices hold about equal numbers of pairs.
/// Without times, steps are cut.
/// @param slices  Of time, >= 1; fewer where there are fewer scans.
/// @throws InvalidInput unless there are no times, or finite ones, one per step.
LogBlocks cut_in_blocks(const DetectionLog& log, const std::vector<ScanPair>& pairs, int slices);

}  // namespace mapproof
