#pragma once

#include <vector>

#include "core/model/fit.hpp"
#include "core/model/points.hpp"
#include "core/records/observations/sources.hpp"

namespace mapproof {

/// The gravest of the fits of several sensors to one map. @param sources  In the rows of the map.
Fit joint_fit(const std::vector<ObservationSource>& sources, const Points& map,
              const Points& known_m);

}  // namespace mapproof
