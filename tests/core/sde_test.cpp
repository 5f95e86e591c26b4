#include "core/embed/sde/sde.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/embed/pca.hpp"
#include "tests/support/samples/worlds.hpp"
#include "tests/support/statuses.hpp"

namespace mapproof {
namespace {

using test::distances_of;
using test::has;
using test::procrustes_gap;
using test::scattered;

class EverySolver : public ::testing::TestWithParam<SdpSolver> {
 protected:
  static Embedding unfolded(const Eigen::MatrixXd& distances, int neighbours) {
    return sde(distances, {.neighbours = {.neighbours = neighbours}, .solver = GetParam()});
  }
};

/// Distances of points in the plane that noise in many more dimensions has moved.
Eigen::MatrixXd noisy_distances(Eigen::Index n, std::uint64_t seed) {
  Eigen::MatrixXd points(n, 24);
  points.leftCols(2) = scattered(n, seed);
  for (Eigen::Index k = 2; k < 24; k += 2)
    points.middleCols(k, 2) = 0.05 * scattered(n, seed + static_cast<std::uint64_t>(100 * k));
  Eigen::MatrixXd distances(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    distances.col(i) = (points.rowwise() - points.row(i)).rowwise().norm();
  return distances;
}

TEST_P(EverySolver, WithAllNeighboursIsLpca) {
  const Eigen::MatrixXd D = noisy_distances(12, 3);
  const Embedding map = unfolded(D, 11);
  EXPECT_TRUE(map.statuses.empty());
  EXPECT_LT(procrustes_gap(lpca(D.cwiseAbs2()).coordinates, map.coordinates), 1e-6);
}

TEST_P(EverySolver, RecoversAGridFromItsNeighbourhoods) {
  const Points grid = test::grid(5, 6);
  const Embedding map = unfolded(distances_of(grid), 8);
  EXPECT_LT(procrustes_gap(grid, map.coordinates), 1e-4);
  EXPECT_FALSE(has(map, StatusCode::kRankDeficient));
}

TEST_P(EverySolver, UnrollsAChainOntoALineOfKnownVariance) {
  // Nine points a unit apart along a zigzag: with one neighbour kept, a line from -4 to 4.
  Points chain(9, 2);
  for (Eigen::Index i = 0; i < 9; ++i)
    chain.row(i) << 0.8 * static_cast<double>(i), 0.6 * static_cast<double>(i % 2);
  Eigen::MatrixXd D = distances_of(chain);
  for (Eigen::Index i = 0; i + 1 < 9; ++i)
    D(i, i + 1) = D(i + 1, i) = 1.0 - 1e-3 * static_cast<double>(i);
  const Embedding map = unfolded(D, 1);
  double variance = 0.0;
  double sum = 0.0;
  Eigen::VectorXd along = Eigen::VectorXd::Zero(9);
  for (Eigen::Index i = 1; i < 9; ++i) along(i) = along(i - 1) + D(i - 1, i);
  sum = along.mean();
  variance = (along.array() - sum).square().sum();
  ASSERT_TRUE(map.certificate);
  EXPECT_NEAR(map.certificate->primal, variance, 1e-6 * variance);
  EXPECT_TRUE(has(map, StatusCode::kRankDeficient));
}

TEST_P(EverySolver, KeepsLandmarksOfOneLineOnIt) {
  Points line = Points::Zero(15, 2);
  for (Eigen::Index i = 0; i < 15; ++i) line(i, 0) = 0.1 * static_cast<double>(i * i);
  const Embedding map = unfolded(distances_of(line), 4);
  EXPECT_LT(procrustes_gap(line, map.coordinates), 1e-4 * line.norm());
  EXPECT_TRUE(has(map, StatusCode::kRankDeficient));
}

TEST_P(EverySolver, CertifiesItsSolution) {
  for (const int neighbours : {3, 5, 8}) {
    const Embedding map = unfolded(noisy_distances(30, 7), neighbours);
    ASSERT_TRUE(map.certificate);
    EXPECT_EQ(map.certificate->solver, GetParam());
    EXPECT_LT(map.certificate->relative_gap, 1e-6);
    EXPECT_LT(map.certificate->constraint_residual, 1e-6);
    EXPECT_NEAR(map.certificate->primal, map.certificate->dual, 1e-6 * map.certificate->dual);
    EXPECT_FALSE(has(map, StatusCode::kUncertified) || has(map, StatusCode::kNotEuclidean));
  }
}

TEST_P(EverySolver, ReachesAVarianceNoLessThanThatOfTheData) {
  const Eigen::MatrixXd D = noisy_distances(20, 2);
  const double variance = D.cwiseAbs2().sum() / (2.0 * 20.0);
  EXPECT_GE(unfolded(D, 4).certificate->primal, variance * (1.0 - 1e-6));
}

TEST_P(EverySolver, MapsLandmarksAtOnePositionToOnePoint) {
  Points points = scattered(12, 5);
  points.row(7) = points.row(2);
  points.row(9) = points.row(2);
  const Embedding map = unfolded(distances_of(points), 11);
  EXPECT_EQ(map.coordinates.row(7), map.coordinates.row(2));
  EXPECT_EQ(map.coordinates.row(9), map.coordinates.row(2));
  EXPECT_LT(procrustes_gap(points, map.coordinates), 1e-4);
}

TEST_P(EverySolver, MapsThreeLandmarks) {
  const Points points = scattered(3, 5);
  EXPECT_LT(procrustes_gap(points, unfolded(distances_of(points), 2).coordinates), 1e-5);
}

TEST_P(EverySolver, ReportsWhenNoPointsHaveSuchDistances) {
  Eigen::MatrixXd D = distances_of(scattered(10, 4));
  D(2, 5) = D(5, 2) = 9.0;  // Longer than any way round.
  const Embedding map = unfolded(D, 9);
  EXPECT_TRUE(has(map, StatusCode::kNotEuclidean) || has(map, StatusCode::kUncertified));
  EXPECT_FALSE(is_certified(*map.certificate));
  EXPECT_TRUE(map.coordinates.allFinite());
  EXPECT_GT(map.certificate->constraint_residual, 1e-3);
  EXPECT_GT(map.certificate->relative_gap, 1e-3);  // Of no sign: a bound below 0 certifies nothing.
}

INSTANTIATE_TEST_SUITE_P(Sde, EverySolver,
                         ::testing::Values(SdpSolver::kInteriorPoint, SdpSolver::kCsdp),
                         [](const auto& solver) { return std::string(name(solver.param)); });

TEST(Sde, FactorsOfLowRankComeNearTheOptimum) {
  const Eigen::MatrixXd D = noisy_distances(30, 7);
  for (const int neighbours : {3, 5, 8}) {
    SdeOptions options{.neighbours = {.neighbours = neighbours}, .solver = SdpSolver::kLowRank};
    const Certificate near = sde(D, options).certificate.value();
    options.solver = SdpSolver::kInteriorPoint;
    const Certificate exact = sde(D, options).certificate.value();
    EXPECT_EQ(near.solver, SdpSolver::kLowRank);
    EXPECT_NEAR(near.primal, exact.primal, 5e-3 * exact.primal);
    EXPECT_GE(near.dual, exact.primal * (1.0 - 1e-6));  // Its bound is one.
    EXPECT_LT(near.relative_gap, 2e-2);
  }
}

TEST(Sde, ReportsThatItBridgedIslands) {
  Points points(20, 2);
  points << scattered(10, 1), (scattered(10, 2).rowwise() + Eigen::RowVector2d(50, 0));
  const Embedding map = sde(distances_of(points), {.neighbours = {.neighbours = 3}});
  EXPECT_TRUE(has(map, StatusCode::kBridged));
  EXPECT_TRUE(map.coordinates.allFinite());
}

TEST(Sde, RefusesWhatIsOutOfBounds) {
  const Eigen::MatrixXd D = distances_of(scattered(6, 1));
  EXPECT_THROW(sde(D, {.neighbours = {.neighbours = 6}}), InvalidInput);
  EXPECT_THROW(sde(D.topLeftCorner(2, 2), {.neighbours = {.neighbours = 1}}), InvalidInput);
  EXPECT_THROW(sde(D, {.neighbours = {.neighbours = 3}, .relative_gap = 0.0}), InvalidInput);
  EXPECT_THROW(sde(D, {.neighbours = {.neighbours = 3}, .constraint_residual = NAN}), InvalidInput);
}

}  // namespace
}  // namespace mapproof
