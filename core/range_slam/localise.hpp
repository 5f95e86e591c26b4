#pragma once

#include <Eigen/Core>

#include "core/model/points.hpp"

namespace mapproof {

/// Positions from squared ranges to a map, each step on its own: Y = C X by least squares with the
/// first entry of X, which is 1, held at 1. Far less noise than in positions_of(), where it is
/// free.
/// @param landmarks_m  N x 2, not on one line.
/// @param Y            N x T, 1/2 d^2, m^2.
/// @return T x 2.
/// @throws InvalidInput unless sizes agree, all is finite and the landmarks span the plane.
/// @note O(N T) time.
Points localise(const Points& landmarks_m, const Eigen::MatrixXd& Y);

}  // namespace mapproof
