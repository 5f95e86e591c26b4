#pragma once

#include <string>
#include <vector>

#include "core/model/range_log.hpp"
#include "core/model/status.hpp"
#include "core/range_slam/known_landmarks.hpp"

namespace mapproof {

/// @throws InvalidInput unless the ranges are from 0 to below 1e9 m, of landmarks 0 to
///         `landmarks` - 1, and ascend in time.
void check_ranges(const std::vector<RangeReading>& ranges, Eigen::Index landmarks);

/// What keeps known landmarks from being used with n landmarks: a place for each of some different
/// rows is needed; empty if nothing.
std::string known_problem(const KnownLandmarks& known, Eigen::Index n);

/// Which landmarks have a reading from `first_s` to `last_s`: N.
std::vector<bool> heard_between(const RangeLog& log, double first_s, double last_s);

/// kLandmarkUnseen with the names of the landmarks that are not placed, if there are any.
void tell_unplaced(const RangeLog& log, const std::vector<bool>& is_placed,
                   std::vector<Status>& statuses);

}  // namespace mapproof
