#pragma once

#include <string>
#include <string_view>

#include "core/model/paths/space_path.hpp"

namespace mapproof {

/// Errors of the poses of a path as CSV with the columns `time_s` (or `pose`, without times),
/// `distance_m`, `x_m`, `y_m`, `z_m`, `true_x_m`, `true_y_m`, `true_z_m`, `error_m` and, if
/// orientations are known, `error_deg`. A row of the ground truth or of the estimate
/// alone has its time and position.
/// Numbers read back as they were.
std::string pose_errors_csv(const PoseErrors& errors);

/// Reads such a table, whatever the order of its columns. The columns `z_m` and `true_z_m` may both
/// be missing: the path is then in the plane.
/// @param text  From checked_text().
/// @throws IoError with the line: columns that are missing, unknown or there twice, a row of
///         another length, a cell that is not a finite number, times or distances that descend, an
///         error < 0; or if there is no row.
PoseErrors parse_pose_errors_csv(std::string_view text, const std::string& source);

}  // namespace mapproof
