#pragma once

#include <Eigen/Core>

#include "core/linalg/packed_product.hpp"

namespace mapproof {

/// Replaces the lower half of A by its Cholesky factor L, A = L L'; the other half is left alone.
///
/// Recursive, on add_gram() and add_product(): same bits on all processors.
/// @param A  n x n, symmetric (the lower half is read).
/// @return False if A is not positive definite to working precision or not finite: A is then
///         spoilt.
/// @note n^3 / 6 multiplications and additions.
[[nodiscard]] bool factor_cholesky(Block A);

/// The solution x of L L' x = b.
Eigen::VectorXd solve_cholesky(const Eigen::MatrixXd& L, const Eigen::VectorXd& b);

}  // namespace mapproof
