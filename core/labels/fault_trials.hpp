#pragma once

#include <optional>
#include <vector>

#include "core/labels/labelled_scans.hpp"
#include "core/labels/robust_map.hpp"
#include "core/labels/scan_by_scan.hpp"

namespace mapproof {

/// The fault that lowers the cost of a map the most; empty if none does. The best of each kind is
/// sharpened to the scan before they are compared: whole blocks favour now one, now the other.
/// @param labels  A landmark of each detection, as they are so far.
/// @param map  Of the pairs under these labels.
std::optional<FaultTrial> best_trial(const LabelledScans& scans, const std::vector<int>& labels,
                                     const RobustMap& map);

/// Single detections under one label that are another landmark's, whenever they were: those that
/// cost more than chance makes them and less than half under the other label.
/// @return The two labels of which that gains the most; empty if no detection is such.
/// @note O(M P) time for M landmarks and P pairs, and 8 M bytes a detection.
std::optional<FaultTrial> mixed_trial(const LabelledScans& scans, const std::vector<int>& labels,
                                      const RobustMap& map);

/// Two labels that stand for each other, or one for the other, in single scans, whenever those are:
/// found by the two places that both labels' detections share, then settled scan by scan.
///
/// Which place is whose the scans cannot say: it is taken so that one label alone is at fault, or
/// else so that fewer detections are.
/// @param map  Of the pairs under these labels; the trial's cost is at its width.
/// @return The one of the least cost; empty if no two labels share places.
/// @note Some 1 s for 15 landmarks.
std::optional<FaultTrial> scattered_trial(const LabelledScans& scans,
                                          const std::vector<int>& labels, const RobustMap& map);

/// Of a swap that changes the detections under one label alone: that label's fault, if it explains
/// as much.
FaultTrial simplified(const LabelledScans& scans, const std::vector<int>& labels, FaultTrial trial);

}  // namespace mapproof
