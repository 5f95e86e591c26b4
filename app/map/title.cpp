#include "app/map/title.hpp"

#include <filesystem>

#include "core/base/input_file.hpp"

namespace mapproof {

std::string map_title(const std::string& observations) {
  const bool has_place = !handed_in(observations);
  return "Map of " + (has_place ? std::filesystem::path(observations).filename().string()
                                : input_name(observations));
}

}  // namespace mapproof
