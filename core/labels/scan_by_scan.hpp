#pragma once

#include <vector>

#include "core/labels/labelled_scans.hpp"
#include "core/labels/robust_map.hpp"

namespace mapproof {

/// A data-association hypothesis that was tested, and its result.
struct FaultTrial {
  LabelHypothesis fault;
  StepStretch stretch;
  std::vector<int> labels;
  RobustMap map;
  bool scattered = false;  ///< In single scans, at any time; the stretch is then the whole log.
};

/// The scans of a log with their landmark IDs; all three must outlive it.
struct ScanLabels {
  const LabelledScans& scans;
  const std::vector<int>& given;   ///< The IDs before the fault is corrected.
  const std::vector<int>& labels;  ///< The current ones: they stay where a scan gives no evidence.
};

/// Reassigns two IDs scan by scan, each scan as it costs less in a map.
///
/// kSwapped: in a scan both are exchanged, or neither; else detections under the first ID may be of
/// the second landmark, unless that is in the scan. An ID other than that in `labels` must gain two
/// variances.
/// @param map  Reflected as seen (see scan_costs.hpp).
/// @note Linear in detections.
std::vector<int> labels_scan_by_scan(const ScanLabels& of, const LabelHypothesis& fault,
                                     const Points& map, double width_m);

/// Alternates between reassigning both IDs and minimizing the map's cost until no ID changes.
/// @param start  M x 2: the initial map.
/// @param told_m  Width of Huber's cost by which scans are judged; the map's is `width_m`.
FaultTrial settled_trial(const ScanLabels& of, FaultTrial trial, const Points& start, double told_m,
                         double width_m);

}  // namespace mapproof
