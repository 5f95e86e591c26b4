#pragma once

#include "core/base/files/byte_source.hpp"
#include "core/model/paths/space_path.hpp"

namespace mapproof {

/// Reads a path in space.
///
/// - TUM: `t x y z qx qy qz qw` between blanks, times in seconds.
/// - KITTI: between blanks the first three rows of the matrix from the frame of the pose to that of
///   the path, row by row; without times.
/// - EuRoC: between commas `t, x, y, z, qw, qx, qy, qz` and perhaps more, times in whole
///   nanoseconds; or `t, x, y, z` without orientations.
/// - g2o: vertices VERTEX_SE3:QUAT and VERTEX_SE2 in ascending order of their numbers, without
///   times; all other lines are passed over.
///
/// Lines that begin with # are comments. Quaternions are normalized; matrices stay as they are.
/// @throws IoError with the line: what is not a finite number, a row of another length, times that
///         descend, a quaternion of length 0, a matrix that is not a rotation; or if there is no
///         pose.
SpacePath read_space_path(ByteSource& source);

}  // namespace mapproof
