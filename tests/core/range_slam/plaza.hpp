#pragma once

#include <optional>
#include <string>

#include "core/model/range_log.hpp"
#include "core/model/slam.hpp"

namespace mapproof::test {

/// One of the Plaza data sets, from the folder that MAPPROOF_PLAZA names.
struct Plaza {
  RangeLog log;         ///< With the truth.
  Trajectory odometry;  ///< Dead-reckoned from the recovered odometry.
};

/// @param name  "plaza1" or "plaza2".
/// @return Empty where MAPPROOF_PLAZA is not set.
std::optional<Plaza> plaza(const std::string& name);

/// Mean distance of the estimated path to the truth after that alignment.
double mean_error_m(const Plaza& plaza, const SlamEstimate& estimate, Alignment alignment);

}  // namespace mapproof::test
