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

}  // namespace mapproof
