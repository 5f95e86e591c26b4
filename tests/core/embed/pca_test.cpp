
#include <algorithm>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/embed/pca.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

using test::distances_of;
using test::procrustes_gap;
using test::scattered;

TEST(KernelPca, IsLpcaForAPolynomialOfDegreeOne) {
  const Points points = scattered(20, 1);
  const Embedding map = kernel_pca(points * points.transpose(), PolynomialKernel{.degree = 1});
  EXPECT_LT(procrustes_gap(points, map.coordinates), 1e-12);
}

TEST(KernelPca, TendsToLpcaAsTheGaussianWidens) {
  const Points points = scattered(20, 1);
  const double variance = 1e6;
  const Embedding map =
      kernel_pca(distances_of(points).cwiseAbs2(), GaussianKernel{.variance = variance});
  EXPECT_LT(procrustes_gap(points, std::sqrt(variance) * map.coordinates), 1e-5);
}

// Of n landmarks all equally far, the centred kernel is (1 - k) (I - 11'/n).
TEST(KernelPca, ReportsThatEquallyFarLandmarksHaveNoMap) {
  const Eigen::MatrixXd D = Eigen::MatrixXd::Ones(8, 8) - Eigen::MatrixXd::Identity(8, 8);
  const Embedding map = kernel_pca(D, GaussianKernel{.variance = 0.5});
  ASSERT_FALSE(map.statuses.empty());
  EXPECT_EQ(map.statuses.front().code, StatusCode::kUndetermined);
  EXPECT_NEAR(map.spectrum(0), 1.0 - std::exp(-1.0), 1e-12);
}

TEST(KernelPca, KeepsHugeInnerProductsFinite) {
  const Points points = 1e20 * scattered(20, 1);
  const Embedding map = kernel_pca(points * points.transpose(), PolynomialKernel{.degree = 20});
  EXPECT_TRUE(map.coordinates.allFinite());
  EXPECT_GT(map.coordinates.norm(), 0.0);
}

TEST(KernelPca, RefusesKernelsOutOfBounds) {
  const Eigen::MatrixXd D = distances_of(scattered(5, 1));
  EXPECT_THROW(kernel_pca(D, GaussianKernel{.variance = 0.0}), InvalidInput);
  EXPECT_THROW(kernel_pca(D, GaussianKernel{.variance = std::nan("")}), InvalidInput);
  EXPECT_THROW(kernel_pca(D, PolynomialKernel{.degree = 0}), InvalidInput);
  EXPECT_THROW(kernel_pca(D, PolynomialKernel{.degree = 21}), InvalidInput);
  EXPECT_THROW(kernel_pca(Eigen::MatrixXd::Constant(5, 5, HUGE_VAL), GaussianKernel{}),
               InvalidInput);
}

TEST(KernelPca, ReportsThatAKernelNearTheIdentityGivesNoMap) {
  const Eigen::MatrixXd squares = distances_of(test::grid(5, 6)).cwiseAbs2();
  const auto is_undetermined = [&](double variance) {
    const Embedding map = kernel_pca(squares, GaussianKernel{variance});
    return std::ranges::any_of(map.statuses, [](const Status& status) {
      return status.code == StatusCode::kUndetermined;
    });
  };
  EXPECT_TRUE(is_undetermined(0.02));
  EXPECT_FALSE(is_undetermined(20.0));
}

}  // namespace
}  // namespace mapproof
