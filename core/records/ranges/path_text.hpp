#pragma once

#include <Eigen/Core>

#include "core/base/files/byte_source.hpp"
#include "core/model/range_log.hpp"

namespace mapproof {

/// Whether a source, which stays unread, is a path as TUM or KITTI write it: 8 or 12 numbers
/// between blanks in its first row.
bool is_path_text(ByteSource& source);

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
