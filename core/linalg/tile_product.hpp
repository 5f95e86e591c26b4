#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace mapproof {

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
