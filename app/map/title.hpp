#pragma once

#include <string>

namespace mapproof {

/// "Map of seen.csv", for a report.
std::string map_title(const std::string& observations);

}  // namespace mapproof
