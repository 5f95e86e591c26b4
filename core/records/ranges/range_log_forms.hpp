#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include "core/base/files/byte_source.hpp"
#include "core/model/range_log.hpp"
#include "core/records/ranges/range_log_options.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {

/// The register of the forms that read_range_log() describes; range_log_NAME.cpp reads the form
/// NAME. Files next to a file are found by its path.
RangeLog read_range_log_csv(ByteSource& source, const RangeLogOptions& options);
RangeLog read_range_log_mat(ByteSource& source, const RangeLogOptions& options);
RangeLog read_range_log_pyfg(ByteSource& source, const RangeLogOptions& options);
RangeLog read_range_log_text(ByteSource& source, const RangeLogOptions& options);

/// The path of NAME_TD.txt or NAME_DR.txt, packed or not, without that end; empty for others. Of
/// the form text.
std::filesystem::path text_stem(const std::filesystem::path& path);

// range_log_path.cpp: the ground truth's path.

/// Whether a source, which stays unread, is a path as TUM or KITTI write it: 8 or 12 numbers
/// between blanks in its first row.
bool is_path_text(ByteSource& source);

/// "TUM" or "KITTI" if the first row holds a pose: a quaternion or the rows of a matrix have unit
/// length. Empty: it is none. The source stays unread.
std::string_view path_form(ByteSource& source);

/// Such a path in the plane.
///
/// - TUM: t x y z qx qy qz qw. The heading is the quaternion's yaw; if all quaternions are 0 0 0 1,
///   there is none.
/// - KITTI: the first three rows of the matrix from the pose's frame to the world's, row by row,
///   without times. The plane is x and y; or, if z varies more than y as in a camera's frame, z
///   (ahead) and -x (to the left).
/// @param times_s  Of KITTI's poses, if times.txt is not next to the file.
/// @throws IoError with the line for what is not a finite number, times that do not ascend, or a
///         path without times of another length than `times_s`.
Trajectory read_path_text(ByteSource& source, const Eigen::VectorXd& times_s);

}  // namespace mapproof
