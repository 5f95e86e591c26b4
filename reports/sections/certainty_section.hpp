#pragma once

#include "core/model/map_certainty.hpp"
#include "core/model/map_record.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// How sure each landmark of a map is: half axes and turn of its ellipse, the least sure first.
/// @throws InvalidInput unless there is a covariance a landmark.
Section certainty_section(const MapRecord& record, const MapCertainty& certainty);

}  // namespace mapproof
