
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

// The distances, their Gram matrix and its Lanczos steps are another way to the same map.
TEST(LpcaOfVectors, IsThatOfTheirDistances) {
  Eigen::MatrixXd vectors = 5.0 + 0.05 * Eigen::MatrixXd::Random(150, 400).array();
  const Points points = scattered(150, 1);
  vectors.col(7) += 3.0 * points.col(0);
  vectors.col(9) += 2.0 * points.col(1);
  const Embedding by_vectors = lpca_of_vectors(vectors);
  Eigen::MatrixXd squares(150, 150);
  for (Eigen::Index j = 0; j < 150; ++j)
    squares.col(j) = (vectors.rowwise() - vectors.row(j)).rowwise().squaredNorm();
  const Embedding by_distances = lpca(squares);
  EXPECT_TRUE(by_vectors.statuses.empty());
  EXPECT_LT((by_vectors.coordinates - by_distances.coordinates).cwiseAbs().maxCoeff(),
            1e-9 * by_distances.coordinates.cwiseAbs().maxCoeff());
  ASSERT_EQ(by_vectors.spectrum.size(), 10);
  EXPECT_LT((by_vectors.spectrum - by_distances.spectrum).cwiseAbs().maxCoeff(),
            1e-5 * by_distances.spectrum(0));
}

TEST(LpcaOfVectors, ReportsVectorsOnOneLine) {
  const Eigen::MatrixXd vectors =
      Eigen::VectorXd::LinSpaced(120, 0.0, 1.0) * Eigen::RowVectorXd::LinSpaced(30, 1.0, 2.0);
  const Embedding map = lpca_of_vectors(vectors);
  ASSERT_FALSE(map.statuses.empty());
  EXPECT_EQ(map.statuses.front().code, StatusCode::kRankDeficient);
  EXPECT_THROW(lpca_of_vectors(Eigen::MatrixXd::Zero(50, 10)), InvalidInput);
}

}  // namespace
}  // namespace mapproof
