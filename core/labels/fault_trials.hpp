#pragma once

#include <optional>
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

/// The fault that lowers the cost of a map the most; empty if none does. The best of each kind is
/// sharpened to the scan before they are compared: whole blocks favour now one, now the other.
/// @param labels  A landmark of each detection, as they are so far.
/// @param map  Of the pairs under these labels.
std::optional<FaultTrial> best_trial(const LabelledScans& scans, const std::vector<int>& labels,
                                     const RobustMap& map);

}  // namespace mapproof
