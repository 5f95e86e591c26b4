#pragma once

#include <string>

#include "app/map/arguments.hpp"
#include "app/map/one_sensor.hpp"
#include "reports/html/report_html.hpp"

namespace mapproof {

/// Writes a map's record, tables, figures and report into the folder that the arguments name.
/// @param command  The one that makes the map again. @throws IoError.
void write_outputs(const MapArguments& arguments, const MapResult& map, const Templates& page,
                   const std::string& command);

}  // namespace mapproof
