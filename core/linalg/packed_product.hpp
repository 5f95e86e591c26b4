#pragma once

#include <Eigen/Core>

namespace mapproof {

/// Blocks of matrices, whatever matrix they are part of.
using Block = Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
using ConstBlock = Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

/// out += sign A A', on and below the diagonal alone.
///
/// Every entry is summed in the same order, over blocks of 256 columns, each product added with one
/// rounding, whatever the width of the processor's vectors, which only decide how many entries are
/// summed at a time: same bits on all, as a BLAS would not give.
/// @param A     n x c, no part of `out`.
/// @param sign  1 or -1.
/// @param out   n x n.
void add_gram(const ConstBlock& A, double sign, Block out);

/// out += sign A B', all entries, summed as by add_gram().
/// @param A, B  n x c and m x c, no part of `out`.
/// @param out   n x m.
void add_product(const ConstBlock& A, const ConstBlock& B, double sign, Block out);

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
