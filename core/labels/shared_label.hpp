#pragma once

#include <optional>
#include <vector>

#include "core/model/detection_log.hpp"

namespace mapproof {

/// A label that two landmarks bear: its detections are of two places.
struct SharedLabel {
  int label = 0;
  double apart_m = 0.0;      ///< The two places,
  int first_detections = 0;  ///< the detections of the one that has more,
  int second_detections = 0;
  int untold = 0;  ///< and those of which no scan tells whose they are.
  /// Of each detection of the log: 1 or 2, the place that it shows; 0: of another label, or untold.
  std::vector<char> place = {};
  double loss_before_m = 0.0;  ///< Root mean square of the pairs' residuals, far ones drawn in,
  double loss_after_m = 0.0;   ///< with one place and with two.
};

/// The label whose detections stand most plainly at two places, if splitting it explains the scans
/// clearly better: one landmark was called by another's name in all its detections.
///
/// Each label in turn is left out of the map; where a scan shows two other landmarks or more, it
/// then tells where the label's detection stands.
/// @note Of each label a pair_map_of().
std::optional<SharedLabel> shared_label(const DetectionLog& log);

/// The log with the second place under a label of its own; untold detections are left out.
/// @param second  Row of its name: one that has no detections, or the next after the last.
DetectionLog split_label(const DetectionLog& log, const SharedLabel& shared, int second);

}  // namespace mapproof
