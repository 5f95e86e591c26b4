#pragma once

#include <vector>

#include "core/model/range_log.hpp"
#include "core/model/slam/slam.hpp"
#include "core/model/status.hpp"
#include "core/range_slam/known_landmarks.hpp"

namespace mapproof::test {

bool has(const std::vector<Status>& statuses, StatusCode code);

/// All landmarks of a log with a ground truth, where they truly are.
KnownLandmarks all_known(const RangeLog& log);

/// Mean distance of the estimated path to the true one after that alignment; infinite if they have
/// no time in common.
double mean_error_m(const RangeLog& log, const SlamEstimate& estimate, Alignment alignment);

}  // namespace mapproof::test
