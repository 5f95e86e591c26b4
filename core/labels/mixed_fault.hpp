#pragma once

#include <optional>
#include <vector>

#include "core/labels/fault_trials.hpp"

namespace mapproof {

/// Single detections under one label that are another landmark's, whenever they were: those that
/// cost more than chance makes them and less than half under the other label.
/// @return The two labels of which that gains the most; empty if no detection is such.
/// @note O(M P) time for M landmarks and P pairs, and 8 M bytes a detection.
std::optional<FaultTrial> mixed_trial(const LabelledScans& scans, const std::vector<int>& labels,
                                      const RobustMap& map);

}  // namespace mapproof
