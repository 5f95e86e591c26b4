#pragma once

#include <string>

#include "app/command_line.hpp"
#include "app/map/incremental_map.hpp"
#include "reports/html/templates.hpp"

namespace mapproof {

/// Where a followed map goes, and what its report says of where it came from.
struct FollowedPlace {
  std::string out;
  std::string observations;
  std::string command;
  Templates page;
};

/// Writes map.json, map.csv and the figure after every update, each at once, and tables and report
/// after the last. The folder is locked until the returned function is gone; a map that was there
/// is replaced.
/// @throws IoError if the folder holds something else, or another process writes there.
WriteFollowed followed_outputs(FollowedPlace place);

/// Says on the console what is to be said of the last map, and prints the result.
/// @return The exit code: kNo if no landmark has a position.
int report_followed(const MapResult& map, const std::string& out, const Invocation& invocation);

}  // namespace mapproof
