#pragma once

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.hpp"
#include "core/model/map_sensors.hpp"

namespace mapproof {

/// The sensors of a joint map as JSON; a continuity that is not told is null.
nlohmann::ordered_json sensors_value(const MapSensors& sensors);

/// @throws IoError with the place.
MapSensors read_sensors(const JsonCursor& value);

}  // namespace mapproof
