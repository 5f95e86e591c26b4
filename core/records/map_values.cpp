#include "core/records/map_values.hpp"

#include "core/json/record_json.hpp"
#include "core/records/map_fields.hpp"

namespace mapproof {

nlohmann::ordered_json map_value(const MapRecord& map) { return to_json_value(map); }

MapRecord read_map(const JsonCursor& object) { return from_json_value<MapRecord>(object); }

}  // namespace mapproof
