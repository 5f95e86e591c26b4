#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/json/json_cursor.hpp"
#include "core/records/sightings.hpp"

namespace mapproof {

/// A cell as a range in metres or a bearing in radians, NaN if it is missing. Empty if it is wrong:
/// sighting_problem() says how.
std::optional<double> sighting_value(std::string_view cell, Sensor sensor, AngleUnit unit);
std::string sighting_problem(std::string_view cell, Sensor sensor, AngleUnit unit);

/// The key "unit" of an object, rad or deg; radians if it is not there. @throws IoError.
AngleUnit read_angle_unit(const JsonCursor& object);

/// Long CSV, as read_sightings() has it.
SightingSource read_long_sightings(ByteSource& source, const SightingFormat& format);

}  // namespace mapproof
