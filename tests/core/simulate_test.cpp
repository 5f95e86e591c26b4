#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/base/angle.hpp"
#include "core/base/errors.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

constexpr double kPi = std::numbers::pi;

World paper_world(std::uint64_t seed) {
  Random random(seed);
  return scatter_landmarks({}, random);
}

TEST(Wrapped, IsAboveMinusPiAndAtMostPi) {
  EXPECT_EQ(wrapped(-kPi), kPi);
  EXPECT_EQ(wrapped(kPi), kPi);
  for (double angle = -20.0 * kPi; angle <= 20.0 * kPi; angle += kPi / 4.0) {
    EXPECT_GT(wrapped(angle), -kPi);
    EXPECT_LE(wrapped(angle), kPi);
  }
  EXPECT_EQ(wrapped(0.5), 0.5);
  EXPECT_NEAR(wrapped(0.5 - 8.0 * kPi), 0.5, 1e-14);
}

TEST(ScatterLandmarks, KeepsEveryGap) {
  const World world = paper_world(1);
  ASSERT_EQ(world.landmarks_m.rows(), 50);
  Eigen::MatrixXd D = test::distances_of(world.landmarks_m);
  D.diagonal().setConstant(HUGE_VAL);
  EXPECT_GE(D.minCoeff(), 0.048 + 0.01);
  EXPECT_GE(world.landmarks_m.minCoeff(), 0.1 + 0.024);
  EXPECT_LE(world.landmarks_m.maxCoeff(), 2.5 - 0.1 - 0.024);
}

TEST(ScatterLandmarks, RefusesWhatDoesNotFit) {
  Random random(1);
  EXPECT_THROW(scatter_landmarks({.side_m = 0.3, .landmarks = 50}, random), InvalidInput);
  EXPECT_THROW(scatter_landmarks({.side_m = 0.1, .landmarks = 4}, random), InvalidInput);
}

TEST(PlaceAnchors, TakesTheLandmarksNearestTheCorners) {
  const World world{.side_m = 2.0, .landmark_diameter_m = 0.1, .landmarks_m = test::grid(3, 3)};
  Random random(1);
  const auto along_the_walls = [&](int count) {
    return place_anchors(world, count, AnchorPlacement::kWalls, random);
  };
  EXPECT_EQ(along_the_walls(4), (std::vector<Eigen::Index>{0, 2, 6, 8}));
  EXPECT_EQ(along_the_walls(9).size(), 9U);
  EXPECT_EQ(along_the_walls(100).size(), 9U);
  EXPECT_EQ(random.next(), Random(1).next());
}

TEST(PlaceAnchors, TakesAClusterFromTheFirstCorner) {
  const World world{.side_m = 2.0, .landmark_diameter_m = 0.1, .landmarks_m = test::grid(3, 3)};
  Random random(1);
  EXPECT_EQ(place_anchors(world, 3, AnchorPlacement::kCluster, random),
            (std::vector<Eigen::Index>{0, 1, 3}));
}

TEST(PlaceAnchors, DrawsEveryLandmarkEquallyOften) {
  const World world{.side_m = 2.0, .landmark_diameter_m = 0.1, .landmarks_m = test::grid(3, 3)};
  Random random(1);
  std::array<int, 9> count{};
  for (int i = 0; i < 3000; ++i)
    for (const Eigen::Index anchor : place_anchors(world, 3, AnchorPlacement::kRandom, random))
      ++count[static_cast<std::size_t>(anchor)];
  for (const int times : count) EXPECT_NEAR(times, 1000, 110);
}

TEST(RandomWalk, KeepsItsDistanceFromWallsAndLandmarksAtEveryObservation) {
  const World world = paper_world(2);
  const WalkOptions options;
  Random random(3);
  const Path path = random_walk(world, options, 2000, random);
  EXPECT_GE(path.positions_m.minCoeff(), options.wall_margin_m);
  EXPECT_LE(path.positions_m.maxCoeff(), world.side_m - options.wall_margin_m);
  for (Eigen::Index t = 0; t < 2000; ++t)
    EXPECT_GE((world.landmarks_m.rowwise() - path.positions_m.row(t)).rowwise().norm().minCoeff(),
              options.clearance_m + 0.024);
}

TEST(RandomWalk, InTheOpenGoesOneStepAndTurnsWithinItsBounds) {
  const World open{.side_m = 1000.0, .landmark_diameter_m = 0.01, .landmarks_m = test::grid(2, 2)};
  Random random(5);
  const Path path = random_walk(open, {}, 200, random);
  double largest = 0.0;
  for (Eigen::Index t = 1; t < 200; ++t) {
    EXPECT_NEAR((path.positions_m.row(t) - path.positions_m.row(t - 1)).norm(), 0.2, 1e-9);
    const double turn = std::remainder(path.headings_rad(t) - path.headings_rad(t - 1), 2.0 * kPi);
    largest = std::max(largest, std::abs(turn));
  }
  EXPECT_LE(largest, kPi / 4.0 + 1e-12);
  EXPECT_GT(largest, 0.9 * kPi / 4.0);
}

TEST(RandomWalk, SeesTheWholeRoomInTime) {
  Random random(7);
  const Path path = random_walk(paper_world(3), {}, 2000, random);
  Eigen::Matrix4i visits = Eigen::Matrix4i::Zero();
  for (Eigen::Index t = 0; t < 2000; ++t)
    ++visits(static_cast<int>(path.positions_m(t, 0) / 0.626),
             static_cast<int>(path.positions_m(t, 1) / 0.626));
  EXPECT_GT(visits.minCoeff(), 10);
}

TEST(RandomWalk, ThrowsWhereThereIsNoFreePosition) {
  const World full{
      .side_m = 0.1, .landmark_diameter_m = 0.2, .landmarks_m = Points::Constant(1, 2, 0.05)};
  Random random(1);
  EXPECT_THROW(random_walk(full, {}, 1, random), InvalidInput);
}

Path standing_at_origin(double heading) {
  return {.positions_m = Points::Zero(1, 2), .headings_rad = Eigen::VectorXd::Constant(1, heading)};
}

World landmarks_at(const Points& positions) {
  return {.side_m = 10.0, .landmark_diameter_m = 0.048, .landmarks_m = positions};
}

TEST(Observe, SeesACylinderThatIsWiderThanFiveDegrees) {
  Points positions(2, 2);
  positions << 0.549, 0, 0, 0.552;  // 5 degrees are reached at 0.550 m
  Random random(1);
  const ObservationHistory seen =
      observe(landmarks_at(positions), standing_at_origin(0.0), {}, random);
  EXPECT_EQ(seen.values(0, 0), 1.0);
  EXPECT_EQ(seen.values(1, 0), 0.0);
}

TEST(Observe, HidesACylinderWhoseCentreIsBehindAnother) {
  Points positions(3, 2);
  positions << 0.2, 0, 0.4, 0.02, 0.4, 0.2;
  Random random(1);
  const World world = landmarks_at(positions);
  EXPECT_EQ(observe(world, standing_at_origin(0.0), {}, random).values, (Eigen::Vector3d(1, 0, 1)));
  EXPECT_EQ(observe(world, standing_at_origin(0.0), {.occlusion = false}, random).values,
            (Eigen::Vector3d(1, 1, 1)));
}

TEST(Observe, MeasuresBearingsFromTheHeadingAndRangesFromTheCentre) {
  Points positions(2, 2);
  positions << 0, 2, -3, -4;
  const World world = landmarks_at(positions);
  Random random(1);
  const Eigen::MatrixXd bearings =
      observe(world, standing_at_origin(kPi / 2), {.sensor = Sensor::kBearing}, random).values;
  EXPECT_NEAR(bearings(0, 0), 0.0, 1e-15);
  EXPECT_NEAR(std::remainder(bearings(1, 0) - (std::atan2(-4.0, -3.0) - kPi / 2), 2 * kPi), 0.0,
              1e-12);
  const Eigen::MatrixXd ranges =
      observe(world, standing_at_origin(0.0), {.sensor = Sensor::kRange}, random).values;
  EXPECT_EQ(ranges, Eigen::Vector2d(2, 5));
}

TEST(Observe, AddsTheRequestedNoise) {
  const World world = landmarks_at(test::grid(10, 10));
  Path path = standing_at_origin(0.0);
  path.positions_m = Points::Constant(100, 2, 4.5);
  path.headings_rad.setZero(100);
  Random random(11);
  const auto clean = observe(world, path, {.sensor = Sensor::kRange}, random).values;
  const auto noisy =
      observe(world, path, {.sensor = Sensor::kRange, .noise = 0.1, .dropout_share = 0.25}, random)
          .values;
  const double lost = noisy.array().isNaN().cast<double>().mean();
  EXPECT_NEAR(lost, 0.25, 0.02);
  const Eigen::ArrayXXd gaps = noisy.array().isNaN().select(0.0, noisy - clean).array();
  EXPECT_NEAR(std::sqrt(gaps.square().mean() / (1.0 - lost)), 0.1, 0.005);

  const auto flips =
      observe(world, path, {.sensor = Sensor::kVisibility, .noise = 0.1}, random).values;
  const auto ground_truth = observe(world, path, {.sensor = Sensor::kVisibility}, random).values;
  EXPECT_NEAR((flips - ground_truth).cwiseAbs().mean(), 0.1, 0.02);
}

TEST(Observe, SeesAboutFiveAndAHalfLandmarksAStepInThePapersRoom) {
  double seen = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const World world = paper_world(seed);
    Random random(100 + seed);
    const Path path = random_walk(world, {}, 500, random);
    seen += observe(world, path, {}, random).values.sum() / 500 / 10;
  }
  EXPECT_NEAR(seen, 5.4, 0.3);  // found by an independent simulator
}

}  // namespace
}  // namespace mapproof
