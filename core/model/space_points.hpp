#pragma once

#include <Eigen/Core>

namespace mapproof {

/// Positions in space, a point a row, z upward, metres where a name says so.
using SpacePoints = Eigen::Matrix<double, Eigen::Dynamic, 3>;

}  // namespace mapproof
