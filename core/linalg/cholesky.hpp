#pragma once

#include <Eigen/Core>

#include "core/linalg/packed_product.hpp"

namespace mapproof {

/// Replaces the lower half of A by its Cholesky factor L, A = L L'; the other half is left alone.
///
/// By columns of blocks where they fit the cache, recursive above that; on multiply_tile(): same
/// bits on all processors.
/// @param A  n x n, symmetric (the lower half is read).
/// @return False if A is not positive definite to working precision or not finite: A is then
///         spoilt.
/// @note n^3 / 6 multiplications and additions.
[[nodiscard]] bool factor_cholesky(Block A);

/// The solution x of L L' x = b.
Eigen::VectorXd solve_cholesky(const Eigen::MatrixXd& L, const Eigen::VectorXd& b);

/// L^-1 of a lower triangular L, whose other half is not read; the result's other half is zero.
/// @note n^3 / 6 multiplications and additions; same bits on all processors.
Eigen::MatrixXd inverse_of_lower(const Eigen::MatrixXd& L);

/// y = A x, each entry summed in the order of the columns: same bits on all processors.
/// @param x  As long as A has columns, contiguous.
/// @param y  As long as A has rows.
void multiply(const Eigen::MatrixXd& A, const Eigen::VectorXd& x, Eigen::VectorXd& y);

}  // namespace mapproof
