#pragma once

#include <optional>
#include <vector>

#include "core/labels/fault_trials.hpp"

namespace mapproof {

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
