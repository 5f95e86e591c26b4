#include "core/range_slam/refinement/refine.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "core/align/rigid.hpp"
#include "core/base/errors.hpp"
#include "core/range_slam/refinement/refine_starts.hpp"
#include "tests/core/range_slam/slam_worlds.hpp"
#include "tests/support/slam_checks.hpp"

namespace mapproof {
namespace {

using test::ground_truth_as_start;
using test::has;
using test::mean_error_m;
using test::noisy_world;
using test::slam_world;
using test::turned_world;

/// Errors over many draws of the noise are as large as the covariances say.
TEST(Refine, CovariancesAreThoseOfManyDraws) {
  double squared = 0.0;
  constexpr int kDraws = 150;
  for (int draw = 0; draw < kDraws; ++draw) {
    const RangeLog log = slam_world(
        100 + static_cast<std::uint64_t>(draw),
        {.range_sigma_m = 0.05, .distance_sigma_m = 0.02, .heading_change_sigma_rad = 0.005});
    const RefineOptions options{.range_sigma_m = 0.05, .huber = 100.0, .covariances = 1};
    const SlamEstimate refined = refine(log, ground_truth_as_start(log), options);
    const Similarity motion =
        fit_similarity(refined.landmarks_m, *log.true_landmarks, Alignment::kRigid);
    const Eigen::RowVector2d error =
        motion(refined.landmarks_m).row(1) - log.true_landmarks->row(1);
    // Turned into the frame of the estimate, whose covariance it is.
    const Eigen::Vector2d own = motion.rotation.transpose() * error.transpose();
    squared += own.dot(refined.landmark_cov_m2[1].inverse() * own);
  }
  EXPECT_NEAR(squared / (2.0 * kDraws), 1.0, 0.2);
}

TEST(Refine, FindsTheWorldAndTheScaleWithoutNoise) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const RangeLog log = slam_world(seed, {.range_scale = 1.07});
    const SlamEstimate refined = refine(log, dead_reckoning_start(log));
    EXPECT_LT(mean_error_m(log, refined, Alignment::kNone), 1e-6);
    EXPECT_NEAR(refined.range_scale, 1.07, 1e-6);
    EXPECT_LT((refined.landmarks_m - *log.true_landmarks).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_TRUE(refined.statuses.empty());
  }
}

TEST(Refine, IsBetterThanDeadReckoningAndTheSameFromEveryStart) {
  const RangeLog log = slam_world(5, {.steps = 300,
                                      .range_sigma_m = 0.2,
                                      .distance_sigma_m = 0.02,
                                      .heading_change_sigma_rad = 0.02});
  const RefineOptions options{.odometry = {.heading_change_rad = 0.02}, .range_sigma_m = 0.2};
  const SlamEstimate start = dead_reckoning_start(log);
  const SlamEstimate refined = refine(log, start, options);
  EXPECT_LT(mean_error_m(log, refined, Alignment::kRigid), 0.15);
  EXPECT_LT(mean_error_m(log, refined, Alignment::kRigid),
            0.3 * mean_error_m(log, start, Alignment::kRigid));
  const SlamEstimate from_ground_truth = refine(log, ground_truth_as_start(log), options);
  EXPECT_NEAR(*refined.cost, *from_ground_truth.cost, 1e-4 * *refined.cost);
  SlamEstimate without_headings = ground_truth_as_start(log);
  without_headings.path.heading_rad.resize(0);
  EXPECT_NEAR(*refine(log, without_headings, options).cost, *refined.cost, 1e-4 * *refined.cost);
  SlamEstimate sparse = ground_truth_as_start(log);
  const std::vector<Eigen::Index> rows = {20, 90, 160, 280};
  sparse.path = {.time_s = log.ground_truth->time_s(rows),
                 .positions_m = log.ground_truth->positions_m(rows, Eigen::all),
                 .heading_rad = {}};
  EXPECT_NEAR(*refine(log, sparse, options).cost, *refined.cost, 1e-4 * *refined.cost);
}

TEST(Refine, AFewPosesAreNearlyAsGoodAsAll) {
  const RangeLog log = noisy_world(7, 300);
  RefineOptions options{.range_sigma_m = 0.2};
  const SlamEstimate all = refine(log, dead_reckoning_start(log), options);
  options.spacing_m = 3.0;
  const SlamEstimate few = refine(log, dead_reckoning_start(log), options);
  EXPECT_EQ(few.path.size(), all.path.size());
  EXPECT_LT((few.path.positions_m - all.path.positions_m).rowwise().norm().maxCoeff(), 0.1);
}

TEST(Refine, KnownLandmarksTieTheFrame) {
  RangeLog log = noisy_world(8);
  log.start = {.time_s = 0.0, .x_m = 70.0, .y_m = 0.0, .heading_rad = 2.0};  // Of another frame.
  RefineOptions options{.range_sigma_m = 0.2, .covariances = 3};
  options.known =
      KnownLandmarks{.rows = {0, 2}, .positions_m = (*log.true_landmarks)({0, 2}, Eigen::all)};
  const SlamEstimate refined = refine(log, dead_reckoning_start(log), options);
  EXPECT_LT(mean_error_m(log, refined, Alignment::kNone), 0.5);
  EXPECT_EQ(refined.landmarks_m.row(2), log.true_landmarks->row(2));
  EXPECT_EQ(refined.landmark_cov_m2[0], Eigen::Matrix2d::Zero());
  EXPECT_GT(refined.landmark_cov_m2[1].trace(), 0.0);
}

/// One known landmark, or two in one position, leave the world free to rotate: reported, and the
/// first pose is held in their stead.
TEST(Refine, KnownLandmarksThatDoNotTieTheFrameAreSaidNotTo) {
  const RangeLog log = noisy_world(8);
  RefineOptions options{.range_sigma_m = 0.2, .covariances = 2};
  const SlamEstimate without = refine(log, ground_truth_as_start(log), options);
  const Points& ground_truth = *log.true_landmarks;
  options.known = KnownLandmarks{.rows = {0, 2}, .positions_m = ground_truth({0, 0}, Eigen::all)};
  const SlamEstimate in_one_position = refine(log, ground_truth_as_start(log), options);
  EXPECT_TRUE(has(in_one_position.statuses, StatusCode::kUndetermined));
  EXPECT_EQ(in_one_position.path.positions_m, without.path.positions_m);
  EXPECT_EQ(in_one_position.landmarks_m, without.landmarks_m);
  EXPECT_EQ(in_one_position.landmark_cov_m2, without.landmark_cov_m2);

  RangeLog half_heard = log;
  std::erase_if(half_heard.ranges,
                [](const RangeMeasurement& measured) { return measured.landmark == 2; });
  options.known = KnownLandmarks{.rows = {0, 2}, .positions_m = ground_truth({0, 2}, Eigen::all)};
  const SlamEstimate one = refine(half_heard, ground_truth_as_start(half_heard), options);
  EXPECT_TRUE(has(one.statuses, StatusCode::kUndetermined));
  EXPECT_EQ(one.path.positions_m.row(0), log.ground_truth->positions_m.row(0));
  EXPECT_TRUE(one.landmarks_m({0, 1, 3}, Eigen::all).allFinite());
}

TEST(Refine, CovariancesRelativeToTheFirstPoseAreSaidToBe) {
  const RangeLog log = slam_world(3, {.landmarks = 1, .range_sigma_m = 0.1});
  const SlamEstimate refined =
      refine(log, ground_truth_as_start(log), {.estimate_scale = false, .covariances = 3});
  ASSERT_EQ(refined.position_cov_m2.size(), 3U);
  EXPECT_EQ(refined.position_cov_m2[0], Eigen::Matrix2d::Zero());
  EXPECT_TRUE(has(refined.statuses, StatusCode::kUndetermined));
}

TEST(Refine, TakesMotionsSidewaysAndBackwards) {
  for (const double direction : {-std::numbers::pi / 2.0, std::numbers::pi}) {
    const RangeLog log = turned_world(direction);
    const SlamEstimate refined = refine(log, dead_reckoning_start(log));
    EXPECT_LT(mean_error_m(log, refined, Alignment::kNone), 1e-6) << direction;
  }
}

TEST(Refine, OffsetsOfALandmarkAreFound) {
  RangeLog log = slam_world(3);
  for (RangeMeasurement& measured : log.ranges)
    if (measured.landmark == 1) measured.range_m += 0.4;
  const RefineOptions options{
      .range_sigma_m = 0.01, .estimate_scale = false, .offset_sigma_m = 1.0};
  const SlamEstimate refined = refine(log, ground_truth_as_start(log), options);
  ASSERT_EQ(refined.range_offsets_m.size(), 4);
  EXPECT_NEAR(refined.range_offsets_m(1), 0.4, 0.02);
  EXPECT_NEAR(refined.range_offsets_m(2), 0.0, 0.02);
}

TEST(Refine, GivesTheSameBitsEveryTime) {
  const RangeLog log = noisy_world(4);
  const SlamEstimate first = refine(log, random_start(log, 3), {.covariances = 5});
  const SlamEstimate second = refine(log, random_start(log, 3), {.covariances = 5});
  EXPECT_EQ(first.path.positions_m, second.path.positions_m);
  EXPECT_EQ(first.landmarks_m, second.landmarks_m);
  EXPECT_EQ(first.landmark_cov_m2, second.landmark_cov_m2);
}

TEST(Refine, SaysNothingOnAnyStream) {
  const RangeLog log = noisy_world(4);
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  refine(log, random_start(log, 1), {.most_iterations = 1});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(Refine, HardDataEndInAStatus) {
  RangeLog log = noisy_world(6);
  EXPECT_TRUE(has(refine(log, random_start(log, 2), {.most_iterations = 1}).statuses,
                  StatusCode::kNotConverged));

  RangeLog unheard = log;
  unheard.landmarks.push_back("silent");
  unheard.true_landmarks.reset();
  const SlamEstimate without = refine(unheard, dead_reckoning_start(unheard), {.covariances = 2});
  EXPECT_TRUE(has(without.statuses, StatusCode::kLandmarkUnseen));
  EXPECT_TRUE(std::isnan(without.landmarks_m(4, 0)));
  EXPECT_TRUE(without.landmarks_m.topRows(4).allFinite());

  RangeLog once = log;
  once.ranges.resize(1);
  SlamEstimate start = ground_truth_as_start(once);
  const SlamEstimate loose = refine(once, start, {.covariances = 2});
  EXPECT_TRUE(has(loose.statuses, StatusCode::kUndetermined));
  EXPECT_TRUE(loose.landmark_cov_m2.empty());
  EXPECT_TRUE(loose.path.positions_m.allFinite());

  RangeLog huge = log;
  for (RangeMeasurement& measured : huge.ranges) measured.range_m = 1e6;
  EXPECT_TRUE(refine(huge, dead_reckoning_start(huge)).path.positions_m.allFinite());

  RangeLog still = log;
  for (Motion& motion : still.odometry) motion = {.time_s = motion.time_s};
  EXPECT_TRUE(refine(still, dead_reckoning_start(still)).path.positions_m.allFinite());
}

/// Covariances of more than 1e7 blocks: refused before anything is solved.
TEST(Refine, RefusesCovariancesOfTooMuchBeforeItSolves) {
  RangeLog log = noisy_world(1);
  log.landmarks.resize(500);
  double time_s = log.odometry.back().time_s;
  while (log.odometry.size() < 20'100)
    log.odometry.push_back({.time_s = time_s += 1.0, .distance_m = 0.1});
  SlamEstimate start = dead_reckoning_start(log);
  RefineOptions options{.coarse_spacing_m = 1.0, .covariances = 1};
  EXPECT_THROW(refine(log, start, options), InvalidInput);
}

TEST(Refine, APathThatIsNoneIsRefusedAsAStart) {
  const RangeLog log = noisy_world(1);
  const auto refused = [&](auto&& spoil) {
    SlamEstimate start = ground_truth_as_start(log);
    spoil(start.path);
    EXPECT_THROW(refine(log, start), InvalidInput);
  };
  refused([](Trajectory& path) { path.positions_m.conservativeResize(5, 2); });
  refused([](Trajectory& path) { path.heading_rad.conservativeResize(5); });
  refused([](Trajectory& path) { path.heading_rad(3) = std::nan(""); });
  refused([](Trajectory& path) { path.time_s(3) = std::nan(""); });
  refused([](Trajectory& path) { path.time_s(3) = path.time_s(2); });
  refused([](Trajectory& path) { path.time_s.reverseInPlace(); });
  refused([](Trajectory& path) { path.positions_m.setConstant(std::nan("")); });
}

TEST(Refine, BrokenBoundsAreRefused) {
  const RangeLog log = noisy_world(1);
  const SlamEstimate start = dead_reckoning_start(log);
  EXPECT_THROW(refine(log, start, {.range_sigma_m = 0.0}), InvalidInput);
  EXPECT_THROW(refine(log, start, {.spacing_m = -1.0}), InvalidInput);
  EXPECT_THROW(refine(log, start, {.huber = std::nan("")}), InvalidInput);
  EXPECT_THROW(refine(log, start, {.most_iterations = 0}), InvalidInput);
  EXPECT_THROW(refine(log, {}, {}), InvalidInput);
  RangeLog none = log;
  none.ranges.clear();
  EXPECT_THROW(refine(none, start), InvalidInput);
  none = log;
  none.odometry.clear();
  EXPECT_THROW(refine(none, start), InvalidInput);
  RangeLog crowded = log;
  crowded.landmarks.resize(501);
  SlamEstimate many = start;
  many.landmarks_m = Points::Zero(501, 2);
  EXPECT_THROW(refine(crowded, many, {.covariances = 1}), InvalidInput);
  EXPECT_NE(RefineOptions{.covariances = 1}.problem(501), "");
  EXPECT_EQ(RefineOptions{.covariances = 1}.problem(500), "");
  RefineOptions options;
  options.known = KnownLandmarks{.rows = {1, 1}, .positions_m = Points::Identity(2, 2)};
  EXPECT_THROW(refine(log, start, options), InvalidInput);
  options.known = KnownLandmarks{.rows = {0}, .positions_m = Points::Zero(1, 2)};
  EXPECT_THROW(refine(log, start, options), InvalidInput);
}

}  // namespace
}  // namespace mapproof
