#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace mapproof {

/// Blocks of matrices, whatever matrix they are part of.
using Block = Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
using ConstBlock = Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

/// out += sign A A', on and below the diagonal alone.
///
/// Every entry is summed in the same order, over blocks of 256 columns, each product added with one
/// rounding, whatever the width of the processor's vectors, which only decide how many entries are
/// summed at a time: same bits on all, as a BLAS would not give. Threads share large products by
/// rows, which changes no sum.
/// @param A     n x c, no part of `out`.
/// @param sign  1 or -1.
/// @param out   n x n.
void add_gram(const ConstBlock& A, double sign, Block out);

/// out += sign A B', all entries, summed as by add_gram().
/// @param A, B  n x c and m x c, no part of `out`.
/// @param out   n x m.
void add_product(const ConstBlock& A, const ConstBlock& B, double sign, Block out);

// A tile of a product is as large as the registers of the processor.
inline constexpr Eigen::Index kTileRows = 8;
inline constexpr Eigen::Index kTileColumns = 6;

/// tile(r, c) = sum over k of rows(r, k) * columns(c, k), summed in the order of k, each product
/// added with one rounding: same bits whatever vectors the processor has, as std::fma has them.
/// @param rows     8 x depth, column by column.
/// @param columns  6 x depth, column by column.
/// @param tile     8 x 6, column by column.
/// @note A processor of x86-64 without FMA (from before 2013) takes a hundred times as long.
void multiply_tile(const double* rows, const double* columns, Eigen::Index depth, double* tile);

/// One implementation of it.
struct TileKernel {
  std::string_view name;
  void (*multiply)(const double* rows, const double* columns, Eigen::Index depth, double* tile);
};

/// Those that this processor can run, fastest first: multiply_tile() takes the first.
std::vector<TileKernel> tile_kernels();

}  // namespace mapproof
