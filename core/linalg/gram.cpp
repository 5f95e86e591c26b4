#include "core/linalg/gram.hpp"

#include <algorithm>
#include <vector>

#include "core/base/vectorised.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

// A tile of the product is as large as the registers; a block of columns as the caches.
constexpr Index kTileRows = 8;
constexpr Index kTileColumns = 6;
constexpr Index kDepth = 256;     ///< Columns of X at a time.
constexpr Index kBlockRows = 96;  ///< Rows of X that stay in the second cache.

/// Four entries at a time; on processors with narrower vectors the compiler splits them.
using Lanes [[gnu::vector_size(32)]] = double;
using LanesInMemory [[gnu::vector_size(32), gnu::aligned(8), gnu::may_alias]] = double;

/// tile(r, c) = sum over k of rows(r, k) * columns(c, k), both packed k by k.
MAPPROOF_VECTORISED void multiply_tile(const double* rows, const double* columns, Index depth,
                                       double* tile) {
  Lanes sums[kTileColumns][2] = {};
  for (Index k = 0; k < depth; ++k) {
    const Lanes low = *reinterpret_cast<const LanesInMemory*>(rows);
    const Lanes high = *reinterpret_cast<const LanesInMemory*>(rows + 4);
    for (Index c = 0; c < kTileColumns; ++c) {
      sums[c][0] += low * columns[c];
      sums[c][1] += high * columns[c];
    }
    rows += kTileRows;
    columns += kTileColumns;
  }
  for (Index c = 0; c < kTileColumns; ++c)
    for (Index half = 0; half < 2; ++half)
      *reinterpret_cast<LanesInMemory*>(tile + c * kTileRows + 4 * half) = sums[c][half];
}

/// Rows of some columns of X in panels of so many, each k by k, the last one filled with zeros.
template <Index kHeight>
void pack(const Eigen::MatrixXd& X, Index first, Index depth, std::vector<double>& packed) {
  const Index n = X.rows();
  const Index panels = (n + kHeight - 1) / kHeight;
  packed.resize(static_cast<std::size_t>(panels * kHeight * depth));
  for (Index panel = 0; panel < panels; ++panel) {
    const double* in = X.data() + first * n + panel * kHeight;
    double* out = packed.data() + panel * kHeight * depth;
    const Index count = std::min(kHeight, n - panel * kHeight);
    for (Index k = 0; k < depth; ++k, in += n, out += kHeight) {
      if (count == kHeight) {
        for (Index r = 0; r < kHeight; ++r) out[r] = in[r];
      } else {
        for (Index r = 0; r < kHeight; ++r) out[r] = r < count ? in[r] : 0.0;
      }
    }
  }
}

/// Adds a tile to the product where both lie, on and below the diagonal.
void add_tile(const double* tile, Index row, Index column, Eigen::MatrixXd& G) {
  const Index columns = std::min(kTileColumns, G.cols() - column);
  for (Index c = 0; c < columns; ++c) {
    const Index from = std::max<Index>(0, column + c - row);
    const Index to = std::min(kTileRows, G.rows() - row);
    double* out = G.data() + (column + c) * G.rows() + row;
    for (Index r = from; r < to; ++r) out[r] += tile[c * kTileRows + r];
  }
}

}  // namespace

void mirror_lower(Eigen::MatrixXd& matrix) {
  constexpr Index kBlock = 32;  // of both halves fits the first cache
  const Index n = matrix.rows();
  for (Index j0 = 0; j0 < n; j0 += kBlock)
    for (Index i0 = j0; i0 < n; i0 += kBlock)
      for (Index j = j0; j < std::min(j0 + kBlock, n); ++j)
        for (Index i = std::max(i0, j + 1); i < std::min(i0 + kBlock, n); ++i)
          matrix(j, i) = matrix(i, j);
}

Eigen::MatrixXd gram(const Eigen::MatrixXd& X) {
  const Index n = X.rows();
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(n, n);
  std::vector<double> rows;
  std::vector<double> columns;
  alignas(32) double tile[kTileRows * kTileColumns];
  for (Index first = 0; first < X.cols(); first += kDepth) {
    const Index depth = std::min(kDepth, X.cols() - first);
    pack<kTileRows>(X, first, depth, rows);
    pack<kTileColumns>(X, first, depth, columns);
    for (Index block = 0; block < n; block += kBlockRows) {
      const Index end = std::min(block + kBlockRows, n);
      for (Index column = 0; column < end; column += kTileColumns)
        for (Index row = block; row < end; row += kTileRows) {
          if (row + kTileRows <= column) continue;  // above the diagonal
          multiply_tile(rows.data() + row * depth, columns.data() + column * depth, depth, tile);
          add_tile(tile, row, column, G);
        }
    }
  }
  mirror_lower(G);
  return G;
}

}  // namespace mapproof
