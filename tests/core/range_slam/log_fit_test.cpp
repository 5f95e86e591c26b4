#include "core/range_slam/fit/log_fit.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/align/rigid.hpp"
#include "core/base/random.hpp"
#include "core/experiment/slam_run.hpp"
#include "core/range_slam/fit/chain_system.hpp"
#include "core/results/quantity.hpp"
#include "core/simulate/range_world.hpp"
#include "tests/support/plaza.hpp"

namespace mapproof {
namespace {

RangeDriveOptions usual_drive() { return {.landmarks = 5, .steps = 1500}; }

RangeLog drive_with(const DriveFaults& faults, std::uint64_t seed = 3) {
  Random random(seed);
  return simulate_drive(usual_drive(), faults, random);
}

LogFitOptions quick_options(bool only_tests = true) {
  LogFitOptions options;
  options.test_keys = options.final_keys = 120;
  options.only_tests = only_tests;
  return options;
}

const FitCause* cause_in(const Fit& fit, FitCode code) {
  const auto found = std::ranges::find(fit.causes, code, &FitCause::code);
  return found == fit.causes.end() ? nullptr : &*found;
}

double value_in(const FitCause& cause, const std::string& id) {
  const auto found = std::ranges::find(cause.values, id, &FitValue::id);
  return found == cause.values.end() ? NAN : found->value;
}

TEST(ChainSystem, SolvesAndInvertsAsTheDenseMatrixDoes) {
  constexpr Eigen::Index kPoses = 4, kShared = 3;
  constexpr Eigen::Index kSize = 3 * kPoses + kShared;
  Random random(1);
  const auto drawn = [&](Eigen::Index rows, Eigen::Index columns) {
    Eigen::MatrixXd M(rows, columns);
    for (double& value : M.reshaped()) value = random.normal();
    return M;
  };
  ChainSystem system(kPoses, kShared);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(kSize, kSize);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(kSize);
  const auto add_dense = [&](const Eigen::MatrixXd& J, const Eigen::VectorXd& r) {
    H += J.transpose() * J;
    g -= J.transpose() * r;
  };
  for (Eigen::Index i = -1; i + 1 < kPoses; ++i) {
    const Eigen::Matrix3d first = drawn(3, 3), second = drawn(3, 3);
    const Eigen::Vector3d r = drawn(3, 1);
    system.add_motion(i, first, second, r);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, kSize);
    if (i >= 0) J.middleCols(3 * i, 3) = first;
    J.middleCols(3 * i + 3, 3) = second;
    add_dense(J, r);
    for (Eigen::Index column = 0; column < kShared; ++column) {
      const Eigen::RowVector3d a = drawn(1, 3), b = drawn(1, 3);
      const double slope = random.normal(), residual = random.normal();
      system.add_range(i, a, b, {{column, slope}}, residual);
      Eigen::MatrixXd row = Eigen::MatrixXd::Zero(1, kSize);
      if (i >= 0) row.middleCols(3 * i, 3) = a;
      row.middleCols(3 * i + 3, 3) = b;
      row(0, 3 * kPoses + column) = slope;
      add_dense(row, Eigen::VectorXd::Constant(1, residual));
    }
  }
  const Eigen::MatrixXd inverse = H.inverse();
  const Eigen::VectorXd x = inverse * g;
  const auto solution = system.solve();
  ASSERT_TRUE(solution);
  EXPECT_LT((solution->shared - x.tail(kShared)).norm(), 1e-9);
  EXPECT_LT((solution->poses.reshaped() - x.head(3 * kPoses)).norm(), 1e-9);
  EXPECT_NEAR(solution->log_determinant,
              std::log(H.topLeftCorner(3 * kPoses, 3 * kPoses).determinant()), 1e-8);
  const auto covariance = system.covariance();
  ASSERT_TRUE(covariance);
  EXPECT_LT((covariance->shared - inverse.bottomRightCorner(kShared, kShared)).norm(), 1e-9);
  for (Eigen::Index i = 0; i < kPoses; ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_LT((covariance->poses[at] - inverse.block(3 * i, 3 * i, 3, 3)).norm(), 1e-9);
    EXPECT_LT((covariance->shared_pose[at] - inverse.block(3 * kPoses, 3 * i, kShared, 3)).norm(),
              1e-9);
    if (i + 1 < kPoses) {
      EXPECT_LT((covariance->next[at] - inverse.block(3 * i, 3 * i + 3, 3, 3)).norm(), 1e-9);
    }
  }
}

TEST(LogFit, OfASoundLogFitsAndFindsMapAndNoise) {
  const RangeLog log = drive_with({});
  const LogFit fit = fit_log(log, {}, quick_options(false));
  EXPECT_EQ(fit.fit.verdict, FitVerdict::kFits);
  EXPECT_TRUE(fit.fit.causes.empty());
  EXPECT_NEAR(fit.noise.range_m, 0.5, 0.05);
  ASSERT_FALSE(fit.fit.numbers.empty());
  for (const FitNumber& number : fit.fit.numbers)
    EXPECT_NE(find_quantity(number.quantity), nullptr) << number.quantity << " has no label";
  const Points true_landmarks_m = Points(fit_similarity(
      *log.true_landmarks, fit.estimate.landmarks_m, Alignment::kRigid)(*log.true_landmarks));
  EXPECT_LT((true_landmarks_m - fit.estimate.landmarks_m).rowwise().norm().mean(), 0.25);
  ASSERT_EQ(fit.estimate.landmark_cov_m2.size(), 5u);
  const auto limit = std::ranges::find(fit.fit.tests, FitCode::kCommonOffset, &FitTest::code);
  ASSERT_NE(limit, fit.fit.tests.end());
  ASSERT_TRUE(limit->limit.has_value());
  EXPECT_GT(limit->limit->value, 0.0);
}

TEST(LogFit, NamesACommonOffsetWithItsSize) {
  const Fit fit = fit_log(drive_with({.common_offset_m = 3.0}), {}, quick_options()).fit;
  const FitCause* cause = cause_in(fit, FitCode::kCommonOffset);
  ASSERT_NE(cause, nullptr);
  EXPECT_NEAR(value_in(*cause, "offset_m"), 3.0, 0.6);
  EXPECT_EQ(fit.verdict, FitVerdict::kDoesNotFit);
}

TEST(LogFit, NamesTheLandmarkWhoseRangesAreTooLong) {
  const Fit fit = fit_log(drive_with({.landmark_offset_m = 5.0}), {}, quick_options()).fit;
  const FitCause* cause = cause_in(fit, FitCode::kLandmarkOffset);
  ASSERT_NE(cause, nullptr);
  EXPECT_EQ(cause->landmarks, std::vector<std::string>{"0"});
}

TEST(LogFit, ReportsAnOffsetOfFourStandardDeviations) {
  const RangeDriveOptions noisy{.landmarks = 4, .steps = 1500, .range_sigma_m = 1.4};
  for (const double offset_m : {0.0, 5.0}) {
    Random random(11);
    const RangeLog log = simulate_drive(noisy, {.landmark_offset_m = offset_m}, random);
    const Fit fit = fit_log(log, {}, quick_options()).fit;
    const FitCause* cause = cause_in(fit, FitCode::kLandmarkOffset);
    ASSERT_EQ(cause != nullptr, offset_m > 0.0);
    if (cause == nullptr) continue;
    EXPECT_EQ(cause->landmarks, std::vector<std::string>{"0"});
    EXPECT_LT(cause->statistic, 17.0);
  }
}

TEST(LogFit, NamesALateClock) {
  const Fit fit = fit_log(drive_with({.late_s = 5.0}), {}, quick_options()).fit;
  const FitCause* cause = cause_in(fit, FitCode::kTimeOffset);
  ASSERT_NE(cause, nullptr);
  EXPECT_NEAR(value_in(*cause, "offset_s"), 5.0, 0.3);
}

TEST(LogFit, NamesAClockThatIsFarOffThoughRangesAloneFitAPath) {
  const Fit fit = fit_log(drive_with({.late_s = 15.0}), {}, quick_options()).fit;
  const FitCause* cause = cause_in(fit, FitCode::kTimeOffset);
  ASSERT_NE(cause, nullptr);
  EXPECT_NEAR(value_in(*cause, "offset_s"), 15.0, 0.3);
  const auto error = std::ranges::find(fit.tests, FitCode::kOdometryResiduals, &FitTest::code);
  ASSERT_NE(error, fit.tests.end());
  EXPECT_TRUE(error->exceeds());
}

TEST(LogFit, ReportsOdometryOfAnotherDrive) {
  RangeLog log = drive_with({});
  for (std::size_t i = 0; i < log.odometry.size(); ++i)
    log.odometry[i].heading_change_rad = (i / 40) % 2 == 0 ? 0.05 : -0.05;
  const Fit fit = fit_log(log, {}, quick_options()).fit;
  EXPECT_NE(fit.verdict, FitVerdict::kFits);
}

TEST(LogFit, NamesAJumpOfTheClock) {
  const Fit fit = fit_log(drive_with({.jump_s = 20.0}), {}, quick_options()).fit;
  EXPECT_NE(cause_in(fit, FitCode::kClockJump), nullptr);
}

TEST(LogFit, FindsTheSizeOfAJumpInARecordedDrive) {
  std::optional<RangeLog> log = test::plaza("plaza2");
  if (!log) GTEST_SKIP() << test::kNoPlaza;
  const double middle_s = 0.5 * (log->ranges.front().time_s + log->ranges.back().time_s);
  for (RangeMeasurement& range : log->ranges)
    if (range.time_s >= middle_s) range.time_s += 5.0;
  const Fit fit = fit_log(*log, {}, {.only_tests = true}).fit;
  const FitCause* cause = cause_in(fit, FitCode::kClockJump);
  ASSERT_NE(cause, nullptr);
  EXPECT_NEAR(value_in(*cause, "offset_s"), 5.0, 0.2);
}

TEST(LogFit, NamesAMovedLandmarkAndWhen) {
  const Fit fit = fit_log(drive_with({.moved_m = 10.0}), {}, quick_options()).fit;
  const FitCause* cause = cause_in(fit, FitCode::kLandmarkMoved);
  ASSERT_NE(cause, nullptr);
  EXPECT_EQ(cause->landmarks, std::vector<std::string>{"0"});
  EXPECT_NEAR(value_in(*cause, "distance_m"), 10.0, 1.0);
  EXPECT_NEAR(value_in(*cause, "from_s"), 150.0, 15.0);
}

TEST(LogFit, NamesExchangedIds) {
  const LogFit fit = fit_log(drive_with({.exchanged_share = 1.0}), {}, quick_options());
  const FitCause* cause = cause_in(fit.fit, FitCode::kIdsExchanged);
  ASSERT_NE(cause, nullptr);
  EXPECT_EQ(cause->landmarks, (std::vector<std::string>{"0", "1"}));
  ASSERT_TRUE(fit.repaired);
  EXPECT_LT(fit.repaired_cost, fit.cost);
}

TEST(LogFit, NamesTheScaleOfOdometryThatFourAnchorsFix) {
  RangeDriveOptions drive = usual_drive();
  drive.forward_sigma_m = 0.005;
  drive.range_sigma_m = 0.1;
  Random random(3);
  RangeLog log = simulate_drive(drive, {}, random);
  LogFitOptions options = quick_options();
  options.known =
      KnownLandmarks{.rows = {0, 1, 2, 3}, .positions_m = log.true_landmarks->topRows(4)};
  EXPECT_EQ(cause_in(fit_log(log, {}, options).fit, FitCode::kKnownScale), nullptr);
  for (Motion& motion : log.odometry) motion.distance_m *= 1.02;
  const Fit fit = fit_log(log, {}, options).fit;
  const FitCause* cause = cause_in(fit, FitCode::kKnownScale);
  ASSERT_NE(cause, nullptr);
  EXPECT_NEAR(value_in(*cause, "share_percent"), 2.0, 0.5);
  EXPECT_EQ(fit.verdict, FitVerdict::kDoesNotFit);
}

TEST(LogFit, NamesAGapInOdometryByItsStamps) {
  const Fit fit = fit_log(drive_with({.gap_s = 30.0}), {}, quick_options()).fit;
  const FitCause* cause = cause_in(fit, FitCode::kOdometryGap);
  ASSERT_NE(cause, nullptr);
  EXPECT_NEAR(value_in(*cause, "to_s") - value_in(*cause, "from_s"), 30.0, 0.5);
  EXPECT_NE(fit.verdict, FitVerdict::kFits);
}

TEST(LogFit, DoubtsAFrozenStretchOfOdometry) {
  const Fit fit = fit_log(drive_with({.frozen_s = 60.0}), {}, quick_options()).fit;
  EXPECT_EQ(fit.verdict, FitVerdict::kDoesNotFit);
}

TEST(LogFit, ComparesGivenPositionsWithTheMap) {
  const RangeLog log = drive_with({});
  LogFitOptions options = quick_options();
  options.known = KnownLandmarks{.rows = {0, 1, 2, 3, 4}, .positions_m = *log.true_landmarks};
  EXPECT_EQ(fit_log(log, {}, options).fit.verdict, FitVerdict::kFits);
  options.known->positions_m(2, 0) += 10.0;
  const Fit off = fit_log(log, {}, options).fit;
  ASSERT_NE(cause_in(off, FitCode::kKnownLandmarkOff), nullptr);
  EXPECT_EQ(cause_in(off, FitCode::kKnownLandmarkOff)->landmarks, std::vector<std::string>{"2"});
  options.known->positions_m = *log.true_landmarks;
  options.known->positions_m.row(1).swap(options.known->positions_m.row(3));
  const Fit exchanged = fit_log(log, {}, options).fit;
  ASSERT_NE(cause_in(exchanged, FitCode::kKnownLandmarksExchanged), nullptr);
  EXPECT_EQ(cause_in(exchanged, FitCode::kKnownLandmarksExchanged)->landmarks,
            (std::vector<std::string>{"1", "3"}));
}

TEST(LogFit, ListsALandmarkHeardTwiceWithoutAPosition) {
  RangeLog log = drive_with({});
  int heard = 0;
  std::erase_if(log.ranges,
                [&](const RangeMeasurement& range) { return range.landmark == 4 && ++heard > 2; });
  const LogFit fit = fit_log(log, {}, quick_options(false));
  EXPECT_TRUE(fit.estimate.landmarks_m.row(4).array().isNaN().all());
  EXPECT_TRUE(fit.estimate.landmarks_m.topRows(4).allFinite());
  EXPECT_EQ(fit.estimate.statuses.front().code, StatusCode::kLandmarkUnseen);
}

TEST(LogFit, CannotBeTestedWithoutOdometryOrRedundancy) {
  RangeLog log = drive_with({});
  RangeLog few = log;
  few.ranges.resize(20);
  const Fit without = fit_log(few, {}, quick_options()).fit;
  EXPECT_EQ(without.verdict, FitVerdict::kNotTestable);
  EXPECT_FALSE(without.why.empty());
  log.odometry.clear();
  const Fit bare = fit_log(log, {}, quick_options()).fit;
  EXPECT_EQ(bare.verdict, FitVerdict::kNotTestable);
  EXPECT_EQ(bare.why, std::vector<FitMissing>{FitMissing::kOdometry});
}

TEST(LogUnit, GivesTheSameLogWhateverTheUnit) {
  const RangeLog log = drive_with({});
  const RangeLog scaled = in_unit(log, 40.0);
  EXPECT_NEAR(unit_of(scaled), 40.0 * unit_of(log), 1e-9 * unit_of(scaled));
  const RangeLog a = in_unit(log, 1.0 / unit_of(log));
  const RangeLog b = in_unit(scaled, 1.0 / unit_of(scaled));
  const LogFit fit_a = fit_log(a, {}, quick_options(false));
  const LogFit fit_b = fit_log(b, {}, quick_options(false));
  EXPECT_LT((fit_a.estimate.landmarks_m - fit_b.estimate.landmarks_m).norm(), 1e-4);
  EXPECT_EQ(fit_a.fit.verdict, fit_b.fit.verdict);
}

}  // namespace
}  // namespace mapproof
