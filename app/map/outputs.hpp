#pragma once

#include <string>

#include "app/command_line.hpp"
#include "app/map/map_folder.hpp"
#include "app/map/map_result.hpp"
#include "reports/html/templates.hpp"

namespace mapproof {

/// Where a map goes, and the origin that its report names.
struct MapOutput {
  std::string out;
  std::string observations;
  std::string command;  ///< The one that makes the map again.
  Templates page;
  int jobs = 1;  ///< Threads.
  const Disclosure& disclosure;
};

/// The step write: map.json, map.csv, figures, and what else the steps contributed.
/// @param last  With tables and report; else another map of the same observations comes.
/// @return Why the map in space could not be drawn; empty if it was, or has none.
/// @throws IoError.
std::string write_map(const MapFolder& folder, const MapOutput& location, const MapResult& map,
                      bool last = true);

/// Shows a map's warnings and its result, and, last, if and why there is no map.
/// @return The command's exit code.
int report_map(const MapResult& map, const MapOutput& location, const Invocation& invocation);

}  // namespace mapproof
