
#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/linalg/packed_product.hpp"

namespace mapproof {
namespace {

// Fewer than a tile has, whole tiles and one over, several blocks.
constexpr Eigen::Index kSizes[] = {1, 2, 7, 8, 9, 48, 49, 150, 333};

Eigen::MatrixXd noise(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed) {
  Random random(seed);
  return Eigen::MatrixXd::NullaryExpr(
      rows, columns, [&](Eigen::Index, Eigen::Index) { return random.uniform() - 0.5; });
}

TEST(TileKernels, GiveTheSameBitsOfEveryDepth) {
  const std::vector<TileKernel> kernels = tile_kernels();
  ASSERT_EQ(kernels.back().name, "fma");
  for (const Eigen::Index depth : {0, 1, 2, 17, 300}) {
    const Eigen::MatrixXd rows = noise(kTileRows, depth, 1);
    const Eigen::MatrixXd columns = noise(kTileColumns, depth, 2);
    Eigen::MatrixXd expected(kTileRows, kTileColumns);
    kernels.back().multiply(rows.data(), columns.data(), depth, expected.data());
    EXPECT_LT((expected - rows * columns.transpose()).norm(), 1e-13);
    for (const TileKernel& kernel : kernels) {
      Eigen::MatrixXd tile = Eigen::MatrixXd::Constant(kTileRows, kTileColumns, 7.0);
      kernel.multiply(rows.data(), columns.data(), depth, tile.data());
      EXPECT_EQ(tile, expected) << kernel.name << " " << depth;
    }
  }
}

TEST(PackedProduct, AddsWhatEigenAddsAndNothingAboveTheDiagonal) {
  for (const Eigen::Index n : kSizes)
    for (const double sign : {1.0, -1.0}) {
      const Eigen::MatrixXd A = noise(n, 300, 1);
      const Eigen::MatrixXd B = noise(n + 5, 300, 2);
      Eigen::MatrixXd product = noise(n, n + 5, 6);
      const Eigen::MatrixXd expected = product + sign * A * B.transpose();
      add_product(A, B, sign, product);
      EXPECT_LT((product - expected).norm(), 1e-13 * expected.norm()) << n;

      Eigen::MatrixXd square = noise(n, n, 7);
      const Eigen::MatrixXd before = square;
      const Eigen::MatrixXd whole = before + sign * A * A.transpose();
      add_gram(A, sign, square);
      const Eigen::MatrixXd off = (square - whole).triangularView<Eigen::Lower>();
      EXPECT_LT(off.norm(), 1e-13 * whole.norm()) << n;
      const Eigen::MatrixXd above = (square - before).triangularView<Eigen::StrictlyUpper>();
      EXPECT_TRUE(above.isZero(0.0)) << n;
    }
}

}  // namespace
}  // namespace mapproof
