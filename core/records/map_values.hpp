#pragma once

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.hpp"
#include "core/model/map_record.hpp"

namespace mapproof {

/// A map's value, without what is the same in `shared` (names, truth and anchors), if given.
nlohmann::ordered_json map_value(const MapRecord& map, const MapRecord* shared = nullptr);

/// @param object  A map; keys that it leaves out are taken from `shared`, if given.
/// @param extra_keys  May stand in `object` besides those of a map.
/// @throws IoError with the place.
MapRecord read_map(const JsonCursor& object, const MapRecord* shared = nullptr,
                   const std::vector<std::string_view>& extra_keys = {});

/// "names", "truth_m" and "anchors" of a map, or of all maps of a run.
void put_landmarks(nlohmann::ordered_json& object, const MapRecord& map);
void read_landmarks(const JsonCursor& object, MapRecord& map);

}  // namespace mapproof
