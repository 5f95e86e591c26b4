#include "core/linalg/tile_product.hpp"

#include <cmath>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

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

}  // namespace mapproof
