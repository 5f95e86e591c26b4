#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/model/range_log.hpp"

namespace mapproof {

/// A path as TUM's text [sturm2012]: a line `t x y z qx qy qz qw` a pose, z = 0, the quaternion
/// that of the heading, or of none where headings are not known. Numbers read back as they were.
/// @throws InvalidInput for a path_problem().
std::string trajectory_tum(const Trajectory& path);

/// Reads such a text: z, roll and pitch are passed over, as are lines that begin with #
/// and poses of the same time as the one before.
/// @throws IoError with the line: other than eight numbers, one that is not finite, times that
///         descend; or if there is no pose.
Trajectory parse_trajectory_tum(std::string_view text, const std::string& source);

/// A path as CSV with the columns time_s, x_m, y_m and, if it is known, heading_rad; lines end in
/// CR LF [rfc4180]. @throws InvalidInput as above.
std::string trajectory_csv(const Trajectory& path);

/// Landmarks as CSV with the columns name, x_m, y_m, which read_landmarks() takes.
/// @throws InvalidInput if `positions_m` has other than `names.size()` rows.
/// @note A landmark without a position is left out.
std::string landmarks_csv(const std::vector<std::string>& names, const Points& positions_m);

}  // namespace mapproof
