#pragma once

#include "app/map/map_result.hpp"
#include "core/model/detection_log.hpp"
#include "core/model/histories/history_blocks.hpp"

namespace mapproof {

/// How many landmarks the scans hold.
struct ScanSizes {
  long scans = 0;
  long detections = 0;
  long with_two = 0;  ///< Scans with two landmarks or more: only these measure distances of pairs.
  long most = 0;      ///< Landmarks of the fullest scan.
};

ScanSizes scan_sizes(const DetectionLog& log);
/// Of a history: entries that are not missing, or of visibility those that are 1.
ScanSizes scan_sizes(const HistoryBlocks& history);

/// Adds a fact about the observations, and the member "scans" of --json.
void add_scan_sizes(const ScanSizes& sizes, MapResult& result);

}  // namespace mapproof
