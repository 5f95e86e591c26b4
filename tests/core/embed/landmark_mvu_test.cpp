#include "core/embed/landmark_mvu.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/embed/sde/problem.hpp"
#include "core/embed/sde/sde.hpp"
#include "tests/support/samples/worlds.hpp"
#include "tests/support/statuses.hpp"

namespace mapproof {
namespace {

using Eigen::Index;
using test::distances_of;
using test::has;
using test::procrustes_gap;
using test::scattered;

/// The map by neighbourhoods of K.
Embedding unfolded(const Eigen::MatrixXd& D, int K, const LandmarkMvuOptions& options) {
  const NeighbourLists nearest = nearest_neighbours(D, {.neighbours = K});
  return landmark_mvu(connected_neighbour_graph(D, nearest, K).graph, nearest,
                      [&](Index i, Index j) { return D(i, j); }, options);
}

/// Points of a sheet that is rolled up in space.
Eigen::MatrixXd rolled_sheet(Index n) {
  const Points sheet = scattered(n, 5);
  const double low = sheet.col(0).minCoeff();
  const double width = sheet.col(0).maxCoeff() - low;
  Eigen::MatrixXd D(n, n);
  Eigen::MatrixX3d roll(n, 3);
  for (Index i = 0; i < n; ++i) {
    const double angle = 3.0 * (sheet(i, 0) - low) / width;
    roll.row(i) << width / 3.0 * std::cos(angle), width / 3.0 * std::sin(angle), sheet(i, 1);
  }
  for (Index j = 0; j < n; ++j) D.col(j) = (roll.rowwise() - roll.row(j)).rowwise().norm();
  return D;
}

// The squared distances of all pairs sum up to n times the variance: it is greatest where none is
// less than its bound.
TEST(LandmarkMvu, IsAPlaneIfAllPairsAreBounded) {
  const Points points = scattered(14, 8);
  const Embedding map =
      unfolded(distances_of(points), 13, {.references = 14, .relative_gap = 1e-7});
  EXPECT_TRUE(map.statuses.empty());
  EXPECT_LT(procrustes_gap(points, map.coordinates), 1e-5);
  const Points centred = points.rowwise() - points.colwise().mean();
  ASSERT_TRUE(map.certificate.has_value());
  EXPECT_NEAR(map.certificate->primal, centred.squaredNorm(), 1e-6 * centred.squaredNorm());
}

// A chain whose links are bounded has its greatest variance where all of them are kept.
TEST(LandmarkMvu, WithAllAsReferencesIsSdeOfAChain) {
  Points chain(24, 2);
  for (Index i = 0; i < 24; ++i)
    chain.row(i) << std::cos(0.2 * static_cast<double>(i)), std::sin(0.2 * static_cast<double>(i));
  const Eigen::MatrixXd D = distances_of(chain);
  const Embedding map = unfolded(D, 2, {.references = 24, .relative_gap = 1e-8});
  const Embedding exact = sde(D, {.neighbours = {.neighbours = 2}});
  EXPECT_NEAR(map.certificate->primal, exact.certificate->primal,
              1e-5 * exact.certificate->primal);
  EXPECT_LT((map.coordinates.col(0).cwiseAbs() - exact.coordinates.col(0).cwiseAbs()).norm(),
            1e-2 * exact.coordinates.norm());
}

TEST(LandmarkMvu, IsBoundedByTheCertificateOfAllLandmarks) {
  const Eigen::MatrixXd D = rolled_sheet(60);
  const Embedding exact = sde(D, {.neighbours = {.neighbours = 5}});
  const Embedding all = unfolded(D, 5, {.references = 60});
  // Distances that are bounded leave what has them kept, and more.
  EXPECT_GT(all.certificate->dual, exact.certificate->primal * (1.0 - 1e-6));
  EXPECT_LE(all.certificate->relative_gap, LandmarkMvuOptions().relative_gap);
  for (const int references : {8, 20, 40}) {
    const Embedding map = unfolded(D, 5, {.references = references});
    EXPECT_LE(map.certificate->relative_gap, LandmarkMvuOptions().relative_gap) << references;
    EXPECT_LE(map.certificate->primal, all.certificate->dual) << references;
    EXPECT_GT(map.certificate->primal, 0.3 * all.certificate->dual) << references;
  }
}

TEST(LandmarkMvu, LeavesNoPairOfANeighbourhoodTooFarApart) {
  const Eigen::MatrixXd D = rolled_sheet(90);
  const NeighbourLists nearest = nearest_neighbours(D, {.neighbours = 6});
  const Graph graph = connected_neighbour_graph(D, nearest, 6).graph;
  const Points map = unfolded(D, 6, {.references = 20}).coordinates;
  for (const auto& [i, j] : unfolding::kept_pairs(nearest, graph))
    EXPECT_LE((map.row(i) - map.row(j)).norm(), D(i, j) * (1.0 + 1e-9));
}

TEST(LandmarkMvu, UnrollsASheet) {
  const Index n = 200;
  const Points sheet = scattered(n, 5);
  const Embedding map = unfolded(rolled_sheet(n), 6, {.references = 30});
  EXPECT_LT(test::affine_gap(sheet, map.coordinates), 0.03);  // Of a sheet of 1 x 1.
}

TEST(LandmarkMvu, ScalesWithItsDistances) {
  const Eigen::MatrixXd D = rolled_sheet(50);
  const Embedding map = unfolded(D, 5, {.references = 15});
  const Embedding larger = unfolded(1000.0 * D, 5, {.references = 15});
  EXPECT_LT((1000.0 * map.coordinates - larger.coordinates).norm(),
            1e-6 * larger.coordinates.norm());
  EXPECT_NEAR(larger.certificate->primal, 1e6 * map.certificate->primal,
              1e-6 * larger.certificate->primal);
}

TEST(LandmarkMvu, IsCentredAndInItsPrincipalAxes) {
  const Points map = unfolded(rolled_sheet(80), 6, {.references = 20}).coordinates;
  EXPECT_LT(map.colwise().mean().norm(), 1e-9 * map.norm());
  EXPECT_LT(std::abs(map.col(0).dot(map.col(1))), 1e-9 * map.squaredNorm());
  EXPECT_GT(map.col(0).norm(), map.col(1).norm());
}

TEST(LandmarkMvu, ReportsALineAndAPoint) {
  Points line = Points::Zero(12, 2);
  line.col(0) = Eigen::VectorXd::LinSpaced(12, 0.0, 11.0).cwiseAbs2();
  const Embedding flat = unfolded(distances_of(line), 11, {.references = 12});
  EXPECT_TRUE(has(flat, StatusCode::kRankDeficient));
  EXPECT_TRUE(flat.coordinates.col(1).isZero(0.0));
  const Embedding point = unfolded(Eigen::MatrixXd::Zero(9, 9), 3, {.references = 5});
  EXPECT_TRUE(has(point, StatusCode::kRankDeficient));
  EXPECT_TRUE(point.coordinates.isZero(0.0));
}

TEST(LandmarkMvu, KeepsLandmarksOfOnePositionTogether) {
  Points points = scattered(40, 3);
  points.row(7) = points.row(20);
  for (const int references : {10, 40}) {
    const Points map = unfolded(distances_of(points), 5, {.references = references}).coordinates;
    EXPECT_LT((map.row(7) - map.row(20)).norm(), 1e-2 * map.norm() / std::sqrt(40.0));
  }
}

TEST(LandmarkMvu, RefusesFewerThanThreeReferences) {
  const Eigen::MatrixXd D = distances_of(scattered(9, 2));
  EXPECT_THROW(unfolded(D, 4, {.references = 2}), InvalidInput);
  EXPECT_NO_THROW(unfolded(D, 4, {.references = 3}));
}

}  // namespace
}  // namespace mapproof
