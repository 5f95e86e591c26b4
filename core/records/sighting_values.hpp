#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "core/records/sightings.hpp"

namespace mapproof {

inline double in_radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// A cell as a range in metres or a bearing in radians, NaN if it is missing. Empty if it is wrong:
/// sighting_problem() says how.
std::optional<double> sighting_value(std::string_view cell, Sensor sensor, AngleUnit unit);
std::string sighting_problem(std::string_view cell, Sensor sensor, AngleUnit unit);

/// Long CSV, as read_sightings() has it.
SightingSource read_long_sightings(ByteSource& source, const SightingFormat& format);

}  // namespace mapproof
