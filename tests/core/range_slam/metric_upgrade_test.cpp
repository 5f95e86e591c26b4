#include "core/range_slam/factors/metric_upgrade.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "core/range_slam/factors/quadric.hpp"
#include "core/range_slam/factors/squared_ranges.hpp"
#include "tests/core/range_slam/range_worlds.hpp"
#include "tests/support/samples/worlds.hpp"
#include "tests/support/slam_checks.hpp"

namespace mapproof {
namespace {

using test::conic_condition;
using test::has;
using test::points_about;
using test::procrustes_gap;
using test::ranges_between;
using test::spread_of;
using test::stacked;

MetricUpgrade upgrade_of(const Points& landmarks, const Points& path,
                         UpgradeSide side = UpgradeSide::kPoses) {
  return metric_upgrade(factorize(half_squared_ranges(ranges_between(landmarks, path)), 4), side);
}

/// Largest distance of any landmark or position after the best motion or reflection.
double gap(const MetricUpgrade& upgrade, const Points& landmarks, const Points& path) {
  return procrustes_gap(stacked(landmarks, path),
                        stacked(landmarks_of(upgrade.map.C), positions_of(upgrade.map.X)));
}

RC_GTEST_PROP(MetricUpgrade, GivesBackAnyWorldUpToAMotionOrMirror, (std::uint64_t seed)) {
  Random random(seed);
  const double size = std::exp(random.uniform(-3.0, 6.0));
  const Eigen::RowVector2d center(random.uniform(-20.0, 20.0) * size, 0.0);
  const Points landmarks = points_about(*rc::gen::inRange(4, 12), random, size, center);
  const Points path = points_about(*rc::gen::inRange(9, 300), random, size, center);
  // A world that determines the map: landmarks near no line or circle, the path near no conic.
  RC_PRE(spread_of(landmarks) < 100.0 && conic_condition(path) < 300.0);
  const MetricUpgrade upgrade = upgrade_of(landmarks, path);
  RC_ASSERT(!upgrade.map.empty());
  RC_ASSERT(gap(upgrade, landmarks, path) < 1e-6 * size);
}

TEST(MetricUpgrade, IsExactForFourAndEightLandmarks) {
  for (const Eigen::Index N : {4, 8})
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      Random random(seed);
      const Points landmarks = points_about(N, random);
      const Points path = points_about(500, random);
      EXPECT_LT(gap(upgrade_of(landmarks, path), landmarks, path), 1e-9 * 10.0) << N << " " << seed;
    }
}

TEST(MetricUpgrade, NeedsNoMoreThanEightSteps) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    const Points landmarks = points_about(8, random);
    const Points path = points_about(8, random);
    EXPECT_LT(gap(upgrade_of(landmarks, path), landmarks, path), 1e-6) << seed;
  }
}

TEST(MetricUpgrade, TakesAPathAlongAnEllipse) {
  Random random(3);
  const Points landmarks = points_about(5, random);
  Points path(100, 2);
  for (Eigen::Index t = 0; t < 100; ++t)
    path.row(t) << 9.0 * std::cos(0.1 * double(t)), 4.0 * std::sin(0.1 * double(t));
  EXPECT_LT(gap(upgrade_of(landmarks, path), landmarks, path), 1e-7);
}

TEST(MetricUpgrade, FromTheLandmarksSideIsTheSameMap) {
  Random random(4);
  for (const Eigen::Index T : {4, 30}) {
    const Points landmarks = points_about(12, random);
    const Points path = points_about(T, random);
    const MetricUpgrade upgrade = upgrade_of(landmarks, path, UpgradeSide::kLandmarks);
    ASSERT_FALSE(upgrade.map.empty());
    EXPECT_LT(gap(upgrade, landmarks, path), 1e-8);
    const Factorization factors =
        factorize(half_squared_ranges(ranges_between(landmarks, path)), 4);
    EXPECT_LT((upgrade.S * upgrade.map.X - factors.V).norm(), 1e-8 * factors.V.norm());
  }
}

TEST(MetricUpgrade, DoesNotDependOnTheOrderOfLandmarks) {
  Random random(5);
  const Points landmarks = points_about(7, random);
  const Points path = points_about(80, random);
  Eigen::MatrixXd ranges = ranges_between(landmarks, path);
  for (double& range : ranges.reshaped()) range += 0.01 * random.normal();
  const auto map_of = [](const Eigen::MatrixXd& r) {
    return metric_upgrade(factorize(half_squared_ranges(r), 4)).map;
  };
  const SpectralMap map = map_of(ranges);
  const SpectralMap turned = map_of(ranges.colwise().reverse());
  EXPECT_LT(procrustes_gap(landmarks_of(map.C), landmarks_of(turned.C).colwise().reverse()), 1e-9);
}

TEST(MetricUpgrade, ExportsTheQuadricThatItsPointsLieOn) {
  Random random(6);
  const MetricUpgrade upgrade = upgrade_of(points_about(6, random), points_about(60, random));
  for (const QuadricCloud* cloud : {&upgrade.before, &upgrade.after}) {
    ASSERT_EQ(cloud->points.rows(), 60);
    Eigen::MatrixX4d lifted(60, 4);
    lifted << cloud->points, Eigen::VectorXd::Ones(60);
    const Eigen::VectorXd values = (lifted * cloud->Q).cwiseProduct(lifted).rowwise().sum();
    EXPECT_LT(values.cwiseAbs().maxCoeff(), 1e-9 * cloud->Q.norm() * lifted.squaredNorm());
  }
  EXPECT_EQ(upgrade.monomial_values.size(), 10);
}

TEST(MetricUpgrade, OfAPathOnALineOrCircleSaysSo) {
  Random random(7);
  const Points landmarks = points_about(6, random);
  Points line = points_about(60, random);
  line.col(1) = 0.5 * line.col(0).array() + 1.0;
  Points circle(60, 2);
  for (Eigen::Index t = 0; t < 60; ++t)
    circle.row(t) << 3.0 + 5.0 * std::cos(0.1 * double(t)), 5.0 * std::sin(0.1 * double(t));
  for (const Points& path : {line, circle}) {
    const MetricUpgrade upgrade = upgrade_of(landmarks, path);
    EXPECT_TRUE(upgrade.map.empty());
    EXPECT_TRUE(has(upgrade.map.statuses, StatusCode::kRankDeficient));
    EXPECT_TRUE(has(upgrade.map.statuses, StatusCode::kDegenerateGeometry));
    // Landmarks in such positions are no better.
    EXPECT_TRUE(has(upgrade_of(path, landmarks).map.statuses, StatusCode::kTooFewObservations));
    EXPECT_TRUE(has(upgrade_of(path, points_about(40, random)).map.statuses,
                    StatusCode::kDegenerateGeometry));
  }
}

TEST(MetricUpgrade, OfFewerThanEightStepsIsRefused) {
  Random random(8);
  const MetricUpgrade upgrade = upgrade_of(points_about(8, random), points_about(7, random));
  EXPECT_TRUE(upgrade.map.empty());
  EXPECT_TRUE(has(upgrade.map.statuses, StatusCode::kTooFewObservations));
}

TEST(MetricUpgrade, OfRangesThatAreNothingButNoiseIsNoSilentMap) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Eigen::MatrixXd ranges(6, 50);
    for (double& range : ranges.reshaped()) range = random.uniform(1.0, 20.0);
    const MetricUpgrade upgrade = metric_upgrade(factorize(half_squared_ranges(ranges), 4));
    EXPECT_FALSE(upgrade.map.statuses.empty()) << seed;
    if (!upgrade.map.empty()) {
      EXPECT_TRUE(upgrade.map.C.allFinite() && upgrade.map.X.allFinite());
    }
  }
}

TEST(StateCone, HoldsLandmarksAndPosesAndIsItsOwnInverse) {
  Random random(9);
  const Points points = points_about(20, random);
  const Eigen::MatrixXd C = landmark_states(points), X = robot_states(points);
  EXPECT_LT((C * state_cone() * C.transpose()).diagonal().cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((X.transpose() * state_cone() * X).diagonal().cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_TRUE((state_cone() * state_cone()).isIdentity());
}

}  // namespace
}  // namespace mapproof
