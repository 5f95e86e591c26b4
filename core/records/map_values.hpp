#pragma once

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.hpp"
#include "core/model/map_record.hpp"

namespace mapproof {

/// One map within another file.
nlohmann::ordered_json map_value(const MapRecord& map);

/// @throws IoError with the place.
MapRecord read_map(const JsonCursor& object);

}  // namespace mapproof
