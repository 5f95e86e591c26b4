#pragma once

#include <Eigen/Core>

namespace mapproof {

/// X X', exactly symmetric.
///
/// Same bits on all processors (see add_gram()).
/// @param X  n x c.
/// @note n^2 c / 2 multiplications and additions.
Eigen::MatrixXd gram(const Eigen::MatrixXd& X);

/// Copies the half below the diagonal to that above.
void mirror_lower(Eigen::MatrixXd& matrix);

}  // namespace mapproof
