#pragma once

#include <Eigen/Core>

namespace mapproof {

/// The cone that all states [1, -x, -y, (x^2 + y^2)/2] lie on: X' Q0 X = 0. It is its own inverse,
/// so that landmark states lie on it too.
Eigen::Matrix4d state_cone();

/// The products v_i v_j, i <= j, of each column; unequal pairs times sqrt(2), so that a turn of the
/// coordinates turns the products.
/// @param V  q x T.
/// @return T x q (q + 1) / 2: 10 of 4.
Eigen::MatrixXd quadratic_monomials(const Eigen::MatrixXd& V);

/// The symmetric Q of the v' Q v that has these coefficients on the monomials.
Eigen::Matrix4d quadric_of(const Eigen::VectorXd& coefficients);

/// A triangle R with R'R = A'A, from a tall A; A itself where it is not tall.
Eigen::MatrixXd triangle_of(const Eigen::MatrixXd& A);

}  // namespace mapproof
