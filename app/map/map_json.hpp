#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "app/map/one_sensor.hpp"

namespace mapproof {

/// What a map came to, as one JSON object. @param out  The folder that it was written to.
nlohmann::ordered_json map_json(const MapResult& map, const std::filesystem::path& out);

/// The same in two lines: method, steps and errors, and the report.
std::string map_text(const MapResult& map, const std::filesystem::path& out);

}  // namespace mapproof
