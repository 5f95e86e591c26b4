#include "core/linalg/packed_product.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "core/base/parallel.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

void multiply_with_fma(const double* rows, const double* columns, Index depth, double* tile) {
  double sums[kTileColumns][kTileRows] = {};
  for (Index k = 0; k < depth; ++k, rows += kTileRows, columns += kTileColumns)
    for (Index c = 0; c < kTileColumns; ++c)
      for (Index r = 0; r < kTileRows; ++r) sums[c][r] = std::fma(rows[r], columns[c], sums[c][r]);
  for (Index c = 0; c < kTileColumns; ++c)
    for (Index r = 0; r < kTileRows; ++r) tile[c * kTileRows + r] = sums[c][r];
}

#if defined(__x86_64__)

// In intrinsics: the compiler does not vectorise a loop over std::fma.
[[gnu::target("avx512f")]] void multiply_with_avx512(const double* rows, const double* columns,
                                                     Index depth, double* tile) {
  __m512d sums[kTileColumns];
  for (__m512d& sum : sums) sum = _mm512_setzero_pd();
  for (Index k = 0; k < depth; ++k, rows += kTileRows, columns += kTileColumns) {
    const __m512d row = _mm512_loadu_pd(rows);
    for (Index c = 0; c < kTileColumns; ++c)
      sums[c] = _mm512_fmadd_pd(row, _mm512_set1_pd(columns[c]), sums[c]);
  }
  for (Index c = 0; c < kTileColumns; ++c) _mm512_storeu_pd(tile + c * kTileRows, sums[c]);
}

[[gnu::target("avx2,fma")]] void multiply_with_avx2(const double* rows, const double* columns,
                                                    Index depth, double* tile) {
  __m256d upper[kTileColumns];
  __m256d lower[kTileColumns];
  for (Index c = 0; c < kTileColumns; ++c) upper[c] = lower[c] = _mm256_setzero_pd();
  for (Index k = 0; k < depth; ++k, rows += kTileRows, columns += kTileColumns) {
    const __m256d first = _mm256_loadu_pd(rows);
    const __m256d second = _mm256_loadu_pd(rows + 4);
    for (Index c = 0; c < kTileColumns; ++c) {
      const __m256d column = _mm256_set1_pd(columns[c]);
      upper[c] = _mm256_fmadd_pd(first, column, upper[c]);
      lower[c] = _mm256_fmadd_pd(second, column, lower[c]);
    }
  }
  for (Index c = 0; c < kTileColumns; ++c) {
    _mm256_storeu_pd(tile + c * kTileRows, upper[c]);
    _mm256_storeu_pd(tile + c * kTileRows + 4, lower[c]);
  }
}

#endif

constexpr Index kDepth = 256;     ///< Columns of A at a time.
constexpr Index kBlockRows = 96;  ///< Rows of A that stay in the second cache.

/// Multiplications from which on threads share them: some milliseconds.
constexpr Index kWorthSharing = Index{1} << 27;

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
struct TilePosition {
  Index row = 0;
  Index column = 0;
  bool lower_only = false;
};

void add_tile(const double* tile, const TilePosition& at, double sign, Block& out) {
  const Index columns = std::min(kTileColumns, out.cols() - at.column);
  const Index to = std::min(kTileRows, out.rows() - at.row);
  for (Index c = 0; c < columns; ++c) {
    const Index from = at.lower_only ? std::max<Index>(0, at.column + c - at.row) : Index{0};
    double* entry = out.data() + (at.column + c) * out.outerStride() + at.row;
    const double* column = tile + c * kTileRows;
    if (from == 0 && to == kTileRows) {  // Most are whole, which goes by vectors.
      for (Index r = 0; r < kTileRows; ++r) entry[r] += sign * column[r];
    } else {
      for (Index r = from; r < to; ++r) entry[r] += sign * column[r];
    }
  }
}

/// Columns of A and B, packed for multiply_tile().
struct Packed {
  const std::vector<double>& rows;     ///< Of A.
  const std::vector<double>& columns;  ///< Rows of B.
  Index columns_count;
  Index depth;
  bool lower_only;
};

/// Adds the tiles of the packed rows from `block` on, times all packed columns.
void add_block(const Packed& packed, Index block, Index end, double sign, Block& out) {
  alignas(64) double tile[kTileRows * kTileColumns];
  const Index last_column = packed.lower_only ? end : packed.columns_count;
  for (Index column = 0; column < last_column; column += kTileColumns) {
    // Whole tiles above the diagonal are left out.
    const Index above = packed.lower_only ? std::max<Index>(0, (column - block) / kTileRows) : 0;
    for (Index row = block + above * kTileRows; row < end; row += kTileRows) {
      multiply_tile(packed.rows.data() + row * packed.depth,
                    packed.columns.data() + column * packed.depth, packed.depth, tile);
      add_tile(tile, {.row = row, .column = column, .lower_only = packed.lower_only}, sign, out);
    }
  }
}

void add(const ConstBlock& A, const ConstBlock& B, double sign, bool lower_only, Block& out) {
  static thread_local std::vector<double> rows;
  static thread_local std::vector<double> columns;
  for (Index first = 0; first < A.cols(); first += kDepth) {
    const Index depth = std::min(kDepth, A.cols() - first);
    pack<kTileRows>(A, first, depth, rows);
    pack<kTileColumns>(B, first, depth, columns);
    const Packed packed{rows, columns, B.rows(), depth, lower_only};
    const auto add_one = [&](Index block) {
      add_block(packed, block, std::min(block + kBlockRows, A.rows()), sign, out);
    };
    if (A.rows() * B.rows() * depth < kWorthSharing) {
      for (Index block = 0; block < A.rows(); block += kBlockRows) add_one(block);
      continue;
    }
    // While a thread waits for others it must not begin a product that would pack its own.
    const Index blocks = (A.rows() + kBlockRows - 1) / kBlockRows;
    run_isolated([&] {
      parallel_for(static_cast<std::size_t>(blocks), [&](std::size_t i) {
        add_one((blocks - 1 - static_cast<Index>(i)) * kBlockRows);
      });
    });
  }
}

}  // namespace

std::vector<TileKernel> tile_kernels() {
  std::vector<TileKernel> kernels;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) kernels.push_back({"avx512", multiply_with_avx512});
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    kernels.push_back({"avx2", multiply_with_avx2});
#endif
  kernels.push_back({"fma", multiply_with_fma});
  return kernels;
}

void multiply_tile(const double* rows, const double* columns, Index depth, double* tile) {
  static const TileKernel best = tile_kernels().front();
  best.multiply(rows, columns, depth, tile);
}

void add_gram(const ConstBlock& A, double sign, Block out) { add(A, A, sign, true, out); }

void add_product(const ConstBlock& A, const ConstBlock& B, double sign, Block out) {
  add(A, B, sign, false, out);
}

}  // namespace mapproof
