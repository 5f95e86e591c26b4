#pragma once

#include <string>

#include "core/model/sighting_log.hpp"

namespace mapproof::test {

/// The sightings as long CSV: step, landmark, range in m, bearing.
/// @param unit  What a bearing in radians is multiplied by: 180 / pi for degrees.
std::string sightings_csv(const SightingLog& log, double unit = 1.0);

}  // namespace mapproof::test
