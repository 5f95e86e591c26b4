#include "app/map_words.hpp"

#include <filesystem>

#include "core/base/input_file.hpp"

namespace mapproof {

std::string observed_words(const OwnMap& map) {
  return map.observed.empty() ? observed(map.record) : map.observed;
}

std::string method_words(const OwnMap& map) {
  return map.made_by.empty() ? made_by(map.record) : map.made_by;
}

std::string what_words(const OwnMap& map) {
  return map.made_by.empty() && !map.record.of_pairs
             ? std::string()
             : method_words(map) + ", " + observed_words(map);
}

std::string map_title(const std::string& observations) {
  const bool has_place = !handed_in(observations);
  return "Map of " + (has_place ? std::filesystem::path(observations).filename().string()
                                : input_name(observations));
}

}  // namespace mapproof
