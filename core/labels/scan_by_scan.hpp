#pragma once

#include <vector>

#include "core/labels/labelled_scans.hpp"
#include "core/labels/robust_map.hpp"

namespace mapproof {

/// A fault of labels that was tried, and what came of it.
struct FaultTrial {
  LabelHypothesis fault;
  StepStretch stretch;
  std::vector<int> labels;
  RobustMap map;
  bool scattered = false;  ///< In single scans, whenever; the stretch is then the whole log.
};

/// Two labels given anew scan by scan, each scan as it costs less in a map.
///
/// kSwapped: in a scan both stand for each other, or neither; else detections under the first label
/// may be of the second landmark, unless that is in the scan. Another label than `labels` gives
/// must gain two variances.
/// @param given  The labels before the fault is corrected; `labels` are those believed so far.
/// @param map  Turned as seen (see scan_costs.hpp).
/// @note Linear in detections.
std::vector<int> labels_scan_by_scan(const LabelledScans& scans, const std::vector<int>& given,
                                     const std::vector<int>& labels, const LabelHypothesis& fault,
                                     const Points& map, double width_m);

/// Gives both labels anew and lowers the map's cost again, in turn, until no label changes.
/// @param labels  As they are believed before: where a scan tells nothing they stay.
/// @param start  M x 2: the map to begin with.
/// @param told_m  Width of Huber's cost by which scans are told; the map's is `width_m`.
FaultTrial settled_trial(const LabelledScans& scans, const std::vector<int>& given,
                         const std::vector<int>& labels, FaultTrial trial, const Points& start,
                         double told_m, double width_m);

}  // namespace mapproof
