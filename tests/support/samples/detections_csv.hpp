#pragma once

#include <string>

#include "core/model/detection_log.hpp"

namespace mapproof::test {

/// The detections as long CSV: step, landmark, range in m, bearing.
/// @param unit  What a bearing in radians is multiplied by: 180 / pi for degrees.
std::string detections_csv(const DetectionLog& log, double unit = 1.0);

}  // namespace mapproof::test
