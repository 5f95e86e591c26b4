#pragma once

#include <string>

#include "app/own_map.hpp"

namespace mapproof {

/// What was observed, and by which method it was mapped, in words.
std::string observed_words(const OwnMap& map);
std::string method_words(const OwnMap& map);

/// What the record does not say of either; empty if it does.
std::string what_words(const OwnMap& map);

/// "Map of seen.csv", for a report.
std::string map_title(const std::string& observations);

}  // namespace mapproof
