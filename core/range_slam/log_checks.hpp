#pragma once

#include <string>

#include "core/model/range_log.hpp"
#include "core/range_slam/known_landmarks.hpp"

namespace mapproof {

/// @throws InvalidInput unless the ranges are finite, of landmarks of the log and ascend in time.
void check_ranges(const RangeLog& log);

/// What keeps known landmarks from being used with n landmarks; empty if nothing.
std::string known_problem(const KnownLandmarks& known, Eigen::Index n);

}  // namespace mapproof
