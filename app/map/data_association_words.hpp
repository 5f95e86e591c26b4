#pragma once

#include <string>

#include "core/labels/anchor_labels.hpp"
#include "core/labels/mislabelled.hpp"
#include "core/labels/moved.hpp"

namespace mapproof {

/// A sentence: "7 and 12 look swapped from step 1200 on (310 detections): loss 0.410 -> 0.130 m".
std::string described(const LabelFinding& finding, const DetectionLog& log);

/// A sentence: "7 moved by 0.21 m between step 1198 and step 1204 (p = 0.015)".
std::string described(const MovedLandmark& moved, const DetectionLog& log);

/// A sentence: "3 and 10 look exchanged in all detections: known places missed by 1.930 m, then by
/// 0.120 m".
std::string described(const AnchorExchange& exchange, const DetectionLog& log);

}  // namespace mapproof
