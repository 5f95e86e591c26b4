#include "core/choice/map_quality.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

/// 30 points in space, and a map that flattens them.
struct Flattened {
  Eigen::MatrixXd distances{30, 30};
  Points map{30, 2};

  Flattened() {
    Eigen::MatrixXd X(30, 3);
    for (int i = 0; i < 30; ++i)
      X.row(i) << std::sin(1.3 * (i + 1)), std::cos(2.1 * (i + 1)), std::sin(0.7 * (i + 1) + 1.0);
    for (int j = 0; j < 30; ++j) distances.col(j) = (X.rowwise() - X.row(j)).rowwise().norm();
    map << X.col(0), 0.3 * X.col(1);
  }
};

TEST(NeighbourhoodsKept, AreThoseOfScikitLearn) {
  // sklearn.manifold.trustworthiness(X, map, k) and, the sides swapped, (map, X, k).
  const Flattened data;
  const double expected[][3] = {{3, 0.8417777777777777, 0.8755555555555555},
                                {5, 0.8457575757575757, 0.8527272727272728},
                                {10, 0.8002298850574713, 0.8142528735632184}};
  for (const auto& [k, trustworthiness, continuity] : expected) {
    const NeighbourhoodsKept kept =
        neighbourhoods_kept(data.distances, data.map, static_cast<int>(k));
    EXPECT_NEAR(kept.trustworthiness, trustworthiness, 1e-12);
    EXPECT_NEAR(kept.continuity, continuity, 1e-12);
  }
}

TEST(NeighbourhoodsKept, AreAllOfAPerfectMapAndDependOnNeitherScaleNorOrder) {
  const Points points = test::scattered(20, 5);
  const NeighbourhoodsKept kept = neighbourhoods_kept(test::distances_of(points), -3.0 * points, 4);
  EXPECT_DOUBLE_EQ(kept.trustworthiness, 1.0);
  EXPECT_DOUBLE_EQ(kept.continuity, 1.0);

  const Flattened data;
  const Eigen::MatrixXd turned = data.distances.rowwise().reverse().colwise().reverse();
  const Points turned_map = data.map.colwise().reverse();
  EXPECT_NEAR(neighbourhoods_kept(turned, turned_map, 5).continuity,
              neighbourhoods_kept(data.distances, data.map, 5).continuity, 1e-12);
}

TEST(NeighbourhoodsKept, AcceptTiesAndMissingDistancesInAnyOrder) {
  Eigen::MatrixXd distances = Eigen::MatrixXd::Constant(9, 9, std::sqrt(2.0));
  distances.diagonal().setZero();
  distances(0, 1) = distances(1, 0) = HUGE_VAL;
  const NeighbourhoodsKept kept = neighbourhoods_kept(distances, test::scattered(9, 1), 2);
  EXPECT_GE(kept.trustworthiness, 0.0);
  EXPECT_LE(kept.trustworthiness, 1.0);
  EXPECT_THROW(neighbourhoods_kept(distances, test::scattered(9, 1), 5), InvalidInput);
  EXPECT_THROW(neighbourhoods_kept(distances, test::scattered(9, 1), 0), InvalidInput);
}

TEST(ResidualVariance, IsOneLessTheSquaredCorrelation) {
  // By numpy.corrcoef over the pairs.
  const Flattened data;
  EXPECT_NEAR(residual_variance(data.distances, data.map), 0.602147443708188, 1e-12);
}

TEST(NormalisedStress, IsThatOfTheBestScale) {
  // By numpy, with s = sum D d / sum d^2.
  const Flattened data;
  EXPECT_NEAR(normalised_stress(data.distances, data.map), 0.15516984937372463, 1e-12);
}

TEST(MapQuality, IsPerfectForTheGroundTruthAtAnyScaleAndWorstForAPoint) {
  const Points points = test::scattered(12, 2);
  const Eigen::MatrixXd D = test::distances_of(points);
  EXPECT_NEAR(normalised_stress(D, 7.0 * points), 0.0, 1e-12);
  EXPECT_NEAR(residual_variance(D, 7.0 * points), 0.0, 1e-12);
  EXPECT_EQ(normalised_stress(D, Points::Zero(12, 2)), 1.0);
  EXPECT_EQ(residual_variance(D, Points::Zero(12, 2)), 1.0);
}

TEST(MapQuality, LeavesPairsWithoutADistanceOut) {
  const Points points = test::scattered(12, 2);
  Eigen::MatrixXd D = test::distances_of(points);
  D(3, 4) = D(4, 3) = HUGE_VAL;
  EXPECT_NEAR(normalised_stress(D, points), 0.0, 1e-12);
  EXPECT_NEAR(residual_variance(D, points), 0.0, 1e-12);
}

TEST(AnchorsLeftOut, AreMetByAnAffineImageAndMissedByHowFarOneWasMoved) {
  const Points ground_truth = test::scattered(10, 3);
  Eigen::Matrix2d linear;
  linear << 2.0, 0.3, -0.4, 1.1;
  const std::vector<Eigen::Index> anchors = {0, 2, 5, 7, 9};
  const Points map = ground_truth * linear;
  EXPECT_NEAR(anchors_left_out(map, ground_truth, anchors, AffineFit::kLeastSquares), 0.0, 1e-12);

  // A square with one corner moved by 1: each of the four is put 1 off by the other three.
  Points corners(4, 2), moved(4, 2);
  corners << 0, 0, 4, 0, 4, 4, 0, 4;
  moved = corners;
  moved(2, 0) += 1.0;
  EXPECT_NEAR(anchors_left_out(corners, moved, {0, 1, 2, 3}, AffineFit::kLeastSquares), 1.0, 1e-12);
}

TEST(AnchorsLeftOut, NeedFourThatTheMapHas) {
  Points map = test::scattered(6, 1);
  map.row(1).setConstant(NAN);
  EXPECT_TRUE(std::isnan(
      anchors_left_out(map, test::scattered(6, 1), {0, 1, 2, 3}, AffineFit::kLeastSquares)));
}

}  // namespace
}  // namespace mapproof
