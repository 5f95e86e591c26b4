#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "core/records/observations/detections.hpp"

namespace mapproof {

inline double in_radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// A cell as a range in metres or a bearing in radians, NaN if it is missing. Empty if it is wrong:
/// detection_problem() says how.
std::optional<double> detection_value(std::string_view cell, Sensor sensor, AngleUnit unit);
std::string detection_problem(std::string_view cell, Sensor sensor, AngleUnit unit);

/// Long CSV, as read_detections() has it.
DetectionSource read_long_detections(ByteSource& source, const DetectionFormat& format);

}  // namespace mapproof
