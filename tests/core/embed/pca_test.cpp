
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/embed/pca.hpp"
#include "core/observe/history_vectors.hpp"
#include "core/observe/proximities.hpp"
#include "core/observe/seen_lists.hpp"
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

// Of detections alone, and some steps at a time, as of all vectors.
TEST(LpcaOfVectors, NeedsNoArrayOfThem) {
  const auto seen_at = [](Eigen::Index i, Eigen::Index t) {
    return (3 * i + 7 * t) % 23 < 1 || std::abs(i - t) < 30;
  };
  ObservationHistory seen{.sensor = Sensor::kVisibility,
                          .names = std::vector<std::string>(120, "a"),
                          .values = Eigen::MatrixXd::Zero(120, 140)};
  for (Eigen::Index t = 0; t < 140; ++t)
    for (Eigen::Index i = 0; i < 120; ++i)
      if (seen_at(i, t)) seen.values(i, t) = 1.0;
  ASSERT_TRUE(unseen_landmarks(seen, 140).empty());
  const SeenLists lists(seen, 140);
  const Embedding of_lists = lpca_of_vectors(visibility_vectors(lists));
  const Embedding of_array = lpca(proximities(seen, 140).squared_distances);
  EXPECT_LT((of_lists.coordinates - of_array.coordinates).norm(),
            1e-9 * of_array.coordinates.norm());

  for (const Sensor sensor : {Sensor::kBearing, Sensor::kRange}) {
    ObservationHistory history{.sensor = sensor,
                               .names = seen.names,
                               .values = 0.1 * Eigen::MatrixXd::Random(120, 300).cwiseAbs()};
    for (Eigen::Index i = 0; i < 120; ++i)
      for (Eigen::Index t = 0; t < 300; ++t)
        history.values(i, t) +=
            std::abs(0.02 * static_cast<double>(i) - 0.008 * static_cast<double>(t));
    const Embedding held = lpca_of_vectors(history_vectors(history, 300));
    const Embedding streamed = lpca_of_vectors(history_vectors(history, 300, 0));
    const Embedding expected = lpca(proximities(history, 300).squared_distances);
    EXPECT_LT((held.coordinates - expected.coordinates).norm(),
              1e-9 * expected.coordinates.norm());
    EXPECT_LT((streamed.coordinates - expected.coordinates).norm(),
              1e-9 * expected.coordinates.norm());
  }
  EXPECT_THROW(history_vectors(seen, 140), InvalidInput);
}

}  // namespace
}  // namespace mapproof
