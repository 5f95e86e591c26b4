#pragma once

#include <optional>
#include <string>

#include "core/model/range_log.hpp"

namespace mapproof::test {

/// One of the Plaza data sets, from the folder that MAPPROOF_PLAZA names.
struct Plaza {
  RangeLog log;         ///< With the truth.
  Trajectory odometry;  ///< Dead-reckoned from odometry_drp.csv.
};

/// @param name  "plaza1" or "plaza2".
/// @return Empty where MAPPROOF_PLAZA is not set.
std::optional<Plaza> plaza(const std::string& name);

/// Mean distance of the estimated path to the truth after the best motion.
/// @param may_move  False: compared as it is.
double mean_error_m(const Plaza& plaza, const Trajectory& path, bool may_move);

}  // namespace mapproof::test
