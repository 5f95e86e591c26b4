#pragma once

#include "core/model/detection_log.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {

/// The proximities of what one sensor saw in some scans, without their array: equal to those of
/// history_of(log, sensor) up to rounding.
///
/// @throws InvalidInput if a detection names no landmark.
/// @note O(sum of k^2) time over scans with k detections, O(M^2) memory in addition to the log.
Proximities detected_proximities(const DetectionLog& log, Sensor sensor);

}  // namespace mapproof
