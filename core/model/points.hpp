#pragma once

#include <Eigen/Core>

namespace mapproof {

/// Positions in space, one point per row, z upward, metres where a name says so.
using SpacePoints = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Positions in the plane, one point per row, metres where a name says so.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 2>;

}  // namespace mapproof
