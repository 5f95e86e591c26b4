#pragma once

#include <Eigen/Core>

namespace mapproof {

/// The cone that all states [1, -p, |p|^2/2] of positions p lie on: X' Q0 X = 0. It is its own
/// inverse, so that landmark states lie on it too.
/// @param dimension  Of p, 1 or more.
/// @return (dimension + 2) x (dimension + 2).
Eigen::MatrixXd state_cone(Eigen::Index dimension = 2);

/// The products v_i v_j, i <= j, of each column; unequal pairs times sqrt(2), so that a rotation of
/// the coordinates rotates the products.
/// @param V  q x T.
/// @return T x q (q + 1) / 2: 10 of 4, 15 of 5.
Eigen::MatrixXd quadratic_monomials(const Eigen::MatrixXd& V);

/// The symmetric q x q Q of the v' Q v that has these q (q + 1) / 2 coefficients on the monomials.
Eigen::MatrixXd quadric_of(const Eigen::VectorXd& coefficients);

/// A triangle R with R'R = A'A, from a tall A; A itself where it is not tall.
Eigen::MatrixXd triangle_of(const Eigen::MatrixXd& A);

}  // namespace mapproof
