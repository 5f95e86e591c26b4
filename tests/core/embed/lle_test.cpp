#include "core/embed/lle.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

using test::affine_gap;
using test::distances_of;
using test::scattered;

Graph nearest(const Points& points, int neighbours) {
  return nearest_neighbours(distances_of(points), {.neighbours = neighbours});
}

TEST(Lle, RecoversAPlaneUpToAnAffineMapAsItsRegularizationVanishes) {
  const Points points = scattered(60, 1);
  const Embedding map =
      lle(distances_of(points).cwiseAbs2(), nearest(points, 8), {.regularization = 1e-10});
  EXPECT_LT(affine_gap(points, map.coordinates), 1e-4);
  EXPECT_LT(map.spectrum(1), 1e-14);
}

// Weights are the same all around, so I - W is circulant and its eigenvectors are waves.
TEST(Lle, KeepsALoopOfLandmarksOnACircle) {
  Points loop(24, 2);
  for (Eigen::Index i = 0; i < 24; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / 24.0;
    loop.row(i) << std::cos(angle), std::sin(angle);
  }
  const Embedding map = lle(distances_of(loop).cwiseAbs2(), nearest(loop, 4));
  const Eigen::ArrayXd radius = map.coordinates.rowwise().norm();
  EXPECT_LT((radius - std::sqrt(2.0 / 24.0)).abs().maxCoeff(), 1e-8);
}

TEST(Lle, SolvesALargeMapAsItDoesASmallOne) {
  const Points points = scattered(700, 3);  // above the limit of dense eigenvalues
  const Embedding map =
      lle(distances_of(points).cwiseAbs2(), nearest(points, 8), {.regularization = 1e-6});
  EXPECT_TRUE(map.statuses.empty());
  EXPECT_LT(affine_gap(points, map.coordinates), 0.1);
  EXPECT_LT(map.coordinates.colwise().sum().cwiseAbs().maxCoeff(), 1e-8);
}

TEST(Lle, ReportsThatALineHasNoMap) {
  Points line = scattered(12, 1);
  line.col(1).setZero();
  const Embedding map = lle(distances_of(line).cwiseAbs2(), nearest(line, 4));
  ASSERT_FALSE(map.statuses.empty());
  EXPECT_EQ(map.statuses.back().code, StatusCode::kRankDeficient);
}

TEST(Lle, RefusesWhatItCannotUse) {
  const Points points = scattered(10, 1);
  const Eigen::MatrixXd D = distances_of(points).cwiseAbs2();
  EXPECT_THROW(lle(D, nearest(points, 4), {.regularization = 0.0}), InvalidInput);
  EXPECT_THROW(lle(D, Graph(10)), InvalidInput);
  EXPECT_THROW(lle(D, Graph(9)), InvalidInput);
  EXPECT_THROW(lle(Eigen::MatrixXd::Constant(10, 10, HUGE_VAL), nearest(points, 4)), InvalidInput);
}

TEST(Lle, ReportsWhereNoPointsHaveTheDistances) {
  // Two of the neighbours of landmark 0 are farther from each other than over it.
  Eigen::MatrixXd squares = distances_of(test::grid(3, 4)).cwiseAbs2();
  squares(1, 4) = squares(4, 1) = 40.0;
  const Embedding map = lle(squares, nearest_neighbours(squares.cwiseSqrt(), {.neighbours = 5}));
  ASSERT_FALSE(map.statuses.empty());
  EXPECT_EQ(map.statuses.back().code, StatusCode::kNotEuclidean);
  EXPECT_TRUE(map.coordinates.allFinite());
}

}  // namespace
}  // namespace mapproof
