#pragma once

#include <Eigen/Core>

namespace mapproof {

/// X X', exactly symmetric.
///
/// Every entry is summed in the same order, over blocks of 256 columns, whatever the width of the
/// processor's vectors, which only decide how many entries are summed at a time: same bits on all,
/// as a BLAS would not give.
/// @param X  n x c.
/// @note n^2 c / 2 multiplications and additions.
Eigen::MatrixXd gram(const Eigen::MatrixXd& X);

/// Copies the half below the diagonal to that above.
void mirror_lower(Eigen::MatrixXd& matrix);

}  // namespace mapproof
