#pragma once

#include <Eigen/Core>

namespace mapproof {

/// J A J with J = I - 11'/n: rows and columns sum to zero.
/// @param matrix  n x n, symmetric, finite.
Eigen::MatrixXd centered(Eigen::MatrixXd matrix);

/// B = -1/2 J D J with J = I - 11'/n: the inner products behind squared distances, about their
/// centroid [torgerson1952].
/// @param squared_distances  n x n, symmetric, finite.
Eigen::MatrixXd double_centered(const Eigen::MatrixXd& squared_distances);

}  // namespace mapproof
