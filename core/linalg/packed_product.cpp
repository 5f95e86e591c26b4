#include "core/linalg/packed_product.hpp"

#include <algorithm>
#include <vector>

#include "core/linalg/tile_product.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

constexpr Index kDepth = 256;     ///< Columns of A at a time.
constexpr Index kBlockRows = 96;  ///< Rows of A that stay in the second cache.

/// Rows of some columns of A in panels of so many, each k by k, the last one filled with zeros.
template <Index kHeight>
void pack(const ConstBlock& A, Index first, Index depth, std::vector<double>& packed) {
  const Index n = A.rows();
  const Index stride = A.outerStride();
  const Index panels = (n + kHeight - 1) / kHeight;
  packed.resize(static_cast<std::size_t>(panels * kHeight * depth));
  for (Index panel = 0; panel < panels; ++panel) {
    const double* in = A.data() + first * stride + panel * kHeight;
    double* out = packed.data() + panel * kHeight * depth;
    const Index count = std::min(kHeight, n - panel * kHeight);
    for (Index k = 0; k < depth; ++k, in += stride, out += kHeight) {
      if (count == kHeight) {
        for (Index r = 0; r < kHeight; ++r) out[r] = in[r];
      } else {
        for (Index r = 0; r < kHeight; ++r) out[r] = r < count ? in[r] : 0.0;
      }
    }
  }
}

/// Where a tile goes, and which half of it if it lies on the diagonal.
struct Place {
  Index row = 0;
  Index column = 0;
  bool lower_only = false;
};

void add_tile(const double* tile, const Place& place, double sign, Block& out) {
  const Index columns = std::min(kTileColumns, out.cols() - place.column);
  const Index to = std::min(kTileRows, out.rows() - place.row);
  for (Index c = 0; c < columns; ++c) {
    const Index from =
        place.lower_only ? std::max<Index>(0, place.column + c - place.row) : Index{0};
    double* entry = out.data() + (place.column + c) * out.outerStride() + place.row;
    for (Index r = from; r < to; ++r) entry[r] += sign * tile[c * kTileRows + r];
  }
}

void add(const ConstBlock& A, const ConstBlock& B, double sign, bool lower_only, Block& out) {
  static thread_local std::vector<double> rows;
  static thread_local std::vector<double> columns;
  alignas(64) double tile[kTileRows * kTileColumns];
  for (Index first = 0; first < A.cols(); first += kDepth) {
    const Index depth = std::min(kDepth, A.cols() - first);
    pack<kTileRows>(A, first, depth, rows);
    pack<kTileColumns>(B, first, depth, columns);
    for (Index block = 0; block < A.rows(); block += kBlockRows) {
      const Index end = std::min(block + kBlockRows, A.rows());
      const Index last_column = lower_only ? end : B.rows();
      for (Index column = 0; column < last_column; column += kTileColumns) {
        // Whole tiles above the diagonal are left out.
        const Index above = lower_only ? std::max<Index>(0, (column - block) / kTileRows) : 0;
        for (Index row = block + above * kTileRows; row < end; row += kTileRows) {
          multiply_tile(rows.data() + row * depth, columns.data() + column * depth, depth, tile);
          add_tile(tile, {.row = row, .column = column, .lower_only = lower_only}, sign, out);
        }
      }
    }
  }
}

}  // namespace

void add_gram(const ConstBlock& A, double sign, Block out) { add(A, A, sign, true, out); }

void add_product(const ConstBlock& A, const ConstBlock& B, double sign, Block out) {
  add(A, B, sign, false, out);
}

}  // namespace mapproof
