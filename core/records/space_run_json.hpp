#pragma once

#include <string>
#include <string_view>

#include "core/model/space_slam.hpp"

namespace mapproof {

/// space.json of a range-only study (mapproof.space_run): a flight and what was made of its ranges.
std::string space_run_json(const SpaceRun& run);
/// @throws IoError with the place.
SpaceRun parse_space_run(std::string_view text, const std::string& source);

}  // namespace mapproof
