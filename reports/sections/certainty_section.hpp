#pragma once

#include "core/model/map_certainty.hpp"
#include "core/model/map_record.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// Uncertainty of each landmark of a map: half axes and angle of its ellipse, the largest first.
/// @throws InvalidInput unless there is a covariance a landmark.
Section certainty_section(const MapRecord& record, const MapCertainty& certainty);

}  // namespace mapproof
