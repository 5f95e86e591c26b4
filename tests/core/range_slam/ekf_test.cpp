#include "core/range_slam/ekf.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/range_slam/dead_reckoning.hpp"
#include "tests/core/range_slam/slam_worlds.hpp"
#include "tests/support/plaza.hpp"
#include "tests/support/slam_checks.hpp"

namespace mapproof {
namespace {

using test::all_known;
using test::mean_error_m;
using test::slam_world;
using test::turned_world;

/// One step of 2 m straight at a landmark 10 m ahead, then a measurement of 7.5 m instead of 8.
RangeLog one_step() {
  RangeLog log;
  log.landmarks = {"ahead"};
  log.odometry = {{.time_s = 1.0, .distance_m = 2.0}};
  log.ranges = {{.time_s = 1.0, .landmark = 0, .range_m = 7.5}};
  return log;
}

TEST(Ekf, WeighsOneReadingAgainstOneStepByTheirVariances) {
  EkfOptions options{.odometry = {.forward_m = 0.3, .sideways_m = 0.2, .heading_change_rad = 0.1},
                     .range_sigma_m = 0.4,
                     .covariances = 2};
  options.known = KnownLandmarks{.rows = {0}, .positions_m = (Points(1, 2) << 10, 0).finished()};
  const SlamEstimate estimate = ekf_slam(one_step(), options);
  const double gain = 0.09 / (0.09 + 0.16);
  ASSERT_EQ(estimate.path.size(), 2);
  EXPECT_NEAR(estimate.path.positions_m(1, 0), 2.0 + gain * 0.5, 1e-12);
  EXPECT_NEAR(estimate.path.positions_m(1, 1), 0.0, 1e-12);
  ASSERT_EQ(estimate.position_cov_m2.size(), 2U);
  EXPECT_NEAR(estimate.position_cov_m2[1](0, 0), 0.09 * (1.0 - gain), 1e-12);
  EXPECT_NEAR(estimate.position_cov_m2[1](1, 1), 0.04, 1e-12);
  EXPECT_EQ(estimate.position_cov_m2[0], Eigen::Matrix2d::Zero());
}

TEST(Ekf, AReadingWithinAStepCountsAtItsTime) {
  RangeLog log = one_step();
  log.ranges[0] = {.time_s = 0.5, .landmark = 0, .range_m = 9.0};  // As it is half way.
  EkfOptions options;
  options.known = KnownLandmarks{.rows = {0}, .positions_m = (Points(1, 2) << 10, 0).finished()};
  EXPECT_NEAR(ekf_slam(log, options).path.positions_m(1, 0), 2.0, 1e-12);
}

TEST(Ekf, ARangeBeyondTheGateChangesNothing) {
  RangeLog log = slam_world(3, {.range_sigma_m = 0.1});
  EkfOptions options{.range_sigma_m = 0.1};
  options.known = all_known(log);
  RangeLog without = log;
  without.ranges.erase(without.ranges.begin() + 20);
  log.ranges[20].range_m += 50.0;
  EXPECT_EQ(ekf_slam(log, options).path.positions_m, ekf_slam(without, options).path.positions_m);
}

TEST(Ekf, FindsTheWorldAndTheScaleWithoutNoise) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const RangeLog log = slam_world(seed, {.steps = 400, .range_scale = 1.05});
    const SlamEstimate estimate =
        ekf_slam(log, {.range_sigma_m = 0.05, .range_scale = 1.02, .scale_sigma = 0.1});
    EXPECT_TRUE(estimate.statuses.empty());
    EXPECT_NEAR(estimate.range_scale, 1.05, 0.01);
    EXPECT_LT(mean_error_m(log, estimate, Alignment::kRigid), 0.1);
    EXPECT_LT((estimate.landmarks_m - *log.true_landmarks).rowwise().norm().maxCoeff(), 0.3);
  }
}

TEST(Ekf, IsBetterThanDeadReckoning) {
  const RangeLog log = slam_world(5, {.steps = 400,
                                      .range_sigma_m = 0.2,
                                      .distance_sigma_m = 0.02,
                                      .heading_change_sigma_rad = 0.02});
  EkfOptions options{.odometry = {.heading_change_rad = 0.02}, .range_sigma_m = 0.2};
  options.known = all_known(log);
  SlamEstimate reckoned;
  reckoned.path = dead_reckoned(log);
  reckoned.landmarks_m = *log.true_landmarks;
  EXPECT_LT(mean_error_m(log, ekf_slam(log, options), Alignment::kNone),
            0.2 * mean_error_m(log, reckoned, Alignment::kNone));
}

/// The squared error in sigmas of two numbers is 2 on average.
TEST(Ekf, ErrorsAreAsLargeAsItsCovariancesSay) {
  double squared = 0.0;
  constexpr int kDraws = 200;
  for (int draw = 0; draw < kDraws; ++draw) {
    const RangeLog log = slam_world(
        500 + static_cast<std::uint64_t>(draw),
        {.range_sigma_m = 0.2, .distance_sigma_m = 0.02, .heading_change_sigma_rad = 0.005});
    EkfOptions options{.range_sigma_m = 0.2, .gate = 1e9, .covariances = 2};
    options.known = all_known(log);
    const SlamEstimate estimate = ekf_slam(log, options);
    const Eigen::Index last = log.ground_truth->size() - 1;
    ASSERT_EQ(estimate.position_cov_rows.back(), last);
    const Eigen::Vector2d error =
        (estimate.path.positions_m.row(last) - log.ground_truth->positions_m.row(last)).transpose();
    squared += error.dot(estimate.position_cov_m2.back().inverse() * error);
  }
  EXPECT_NEAR(squared / kDraws, 2.0, 0.4);
}

TEST(Ekf, GivesCovariancesOnlyIfAskedFor) {
  const RangeLog log = slam_world(1, {.range_sigma_m = 0.1});
  EkfOptions options{.known = all_known(log)};
  EXPECT_TRUE(ekf_slam(log, options).landmark_cov_m2.empty());
  EXPECT_TRUE(ekf_slam(log, options).position_cov_m2.empty());
  options.covariances = 3;
  EXPECT_EQ(ekf_slam(log, options).landmark_cov_m2.size(), 4U);
  EXPECT_EQ(ekf_slam(log, options).position_cov_rows, (std::vector<Eigen::Index>{0, 30, 60}));
}

/// A robot that slides sideways, or drives backwards, along what is otherwise the same path.
TEST(Ekf, TakesMotionsSidewaysAndBackwards) {
  for (const double direction : {-std::numbers::pi / 2.0, std::numbers::pi}) {
    const RangeLog log = turned_world(direction);
    const SlamEstimate found = ekf_slam(log, {.known = all_known(log)});
    EXPECT_LT(mean_error_m(log, found, Alignment::kNone), 1e-6) << direction;
    EXPECT_LT((found.path.heading_rad - log.ground_truth->heading_rad).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(Ekf, HardDataEndInAStatus) {
  RangeLog log = slam_world(1);
  EXPECT_EQ(ekf_slam(log, {.initial_way_m = 1e6}).statuses.at(0).code, StatusCode::kLandmarkUnseen);
  EkfOptions options;
  options.known = all_known(log);
  options.known->positions_m.array() += 30.0;
  const SlamEstimate lost = ekf_slam(log, options);
  ASSERT_FALSE(lost.statuses.empty());
  EXPECT_EQ(lost.statuses[0].code, StatusCode::kNotConverged);
  for (RangeMeasurement& measured : log.ranges) measured.range_m = 1e6;
  EXPECT_TRUE(ekf_slam(log).path.positions_m.allFinite());
  log.ranges.clear();
  EXPECT_EQ(ekf_slam(log).path.positions_m, dead_reckoned(log).positions_m);
}

TEST(Ekf, BrokenBoundsAreRefused) {
  RangeLog log = slam_world(1);
  EXPECT_THROW(ekf_slam(log, {.gate = 0.0}), InvalidInput);
  EXPECT_THROW(ekf_slam(log, {.range_scale = -1.0}), InvalidInput);
  EkfOptions options;
  options.known = KnownLandmarks{.rows = {7}, .positions_m = Points::Zero(1, 2)};
  EXPECT_THROW(ekf_slam(log, options), InvalidInput);
  std::swap(log.ranges[0], log.ranges[9]);
  EXPECT_THROW(ekf_slam(log), InvalidInput);
  log.landmarks.resize(501);
  EXPECT_THROW(ekf_slam(log), InvalidInput);
  log = slam_world(1);
  log.odometry[3].heading_change_rad = std::nan("");
  EXPECT_THROW(ekf_slam(log), InvalidInput);
}

class PlazaFilter : public ::testing::TestWithParam<const char*> {};

TEST_P(PlazaFilter, IsWithinAMetreWithTheScaleAndLostWithoutIt) {
  const std::optional<RangeLog> found = test::plaza(GetParam());
  if (!found) GTEST_SKIP() << test::kNoPlaza;
  const RangeLog& log = *found;
  EkfOptions options{.scale_sigma = 0.1};
  EXPECT_LT(mean_error_m(log, ekf_slam(log, options), Alignment::kRigid), 0.6);
  options.known = all_known(log);
  EXPECT_LT(mean_error_m(log, ekf_slam(log, options), Alignment::kNone), 0.4);
  options.scale_sigma = 0.0;
  EXPECT_GT(mean_error_m(log, ekf_slam(log, options), Alignment::kNone), 5.0);
}

INSTANTIATE_TEST_SUITE_P(Both, PlazaFilter, ::testing::Values("plaza1", "plaza2"));

}  // namespace
}  // namespace mapproof
