#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/points.hpp"
#include "core/model/range_log.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// @throws InvalidInput unless the ranges are from 0 to below 1e9 m, of landmarks 0 to
///         `landmarks` - 1, and ascend in time.
void check_ranges(const std::vector<RangeMeasurement>& ranges, Eigen::Index landmarks);

/// Points of a planarity up to this are so near one line that ranges to or from them hardly
/// distinguish its two sides.
inline constexpr double kNearlyFlat = 0.03;

/// kDegenerateGeometry for landmarks nearly on one line, kUndetermined for a path that is, with the
/// condition number (the greater extent over the less); empty if they are not. For points that are
/// all finite.
std::optional<Status> landmarks_on_a_line(const Points& landmarks_m);
std::optional<Status> path_on_a_line(const Points& positions_m);

/// Which landmarks have a measurement from `first_s` to `last_s`: N.
std::vector<bool> heard_between(const RangeLog& log, double first_s, double last_s);

/// kLandmarkUnseen with the names of the landmarks that are not placed, if there are any.
void report_unplaced(const RangeLog& log, const std::vector<bool>& is_placed,
                     std::vector<Status>& statuses);

}  // namespace mapproof
