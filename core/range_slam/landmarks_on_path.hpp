#pragma once

#include <Eigen/Core>

#include "core/model/points.hpp"

namespace mapproof {

/// Landmarks, and a scale that all ranges share, told by a path.
struct LandmarksOnPath {
  Points landmarks_m;        ///< N x 2.
  double range_scale = 1.0;  ///< Measured range over distance; 1 where the path cannot tell it.
};

/// The linear regression of squared ranges on a path, Y = b (|m|^2/2 - m'p + |p|^2/2), with one b
/// for all landmarks: the square of the range scale.
///
/// A metric upgrade in noise errs in the ratio of landmarks to path, which their products leave
/// free (m s and p / s), so that a path of the right scale leaves the landmarks to be told.
/// @param positions_m  T x 2, not on one line. On a circle b is not told, and taken for 1.
/// @param Y            N x T, 1/2 d^2, m^2.
/// @throws InvalidInput unless sizes agree, all is finite and the path spans the plane.
/// @note O(N T) time.
LandmarksOnPath landmarks_on_path(const Points& positions_m, const Eigen::MatrixXd& Y);

}  // namespace mapproof
