#pragma once

#include <Eigen/Core>

namespace mapproof {

/// Positions in space, a point a row, z upward, metres where a name says so.
using SpacePoints = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Positions in the plane, a point a row, metres where a name says so.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 2>;

}  // namespace mapproof
