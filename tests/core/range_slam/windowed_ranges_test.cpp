#include "core/range_slam/factors/windowed_ranges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/range_slam/factors/spread_rows.hpp"
#include "core/range_slam/factors/squared_ranges.hpp"
#include "tests/core/range_slam/drives.hpp"
#include "tests/core/range_slam/range_worlds.hpp"

namespace mapproof {
namespace {

using test::Drive;
using test::drive;

std::vector<LandmarkRanges> measurements_of(const Drive& drive) {
  return ranges_by_landmark(drive.log.ranges, 6, drive.odometry);
}

Eigen::MatrixXd true_half_squares(const Drive& drive) {
  return half_squared_ranges(
      test::ranges_between(*drive.log.true_landmarks, drive.log.ground_truth->positions_m));
}

TEST(WindowedRanges, AreExactWhereOdometryAndRangesAre) {
  const Drive exact = drive({.range_scale = 1.07}, 1);
  const Eigen::MatrixXd ground_truth = true_half_squares(exact);
  for (const double length_s : {15.0, 40.0, 500.0}) {
    const WindowedRanges ranges =
        windowed_ranges(measurements_of(exact), exact.odometry, exact.odometry.time_s,
                        {.length_s = length_s, .range_scale = 1.07});
    ASSERT_EQ(ranges.columns.size(), 2001U) << length_s;
    // The ridge of the regression is 1e-9.
    EXPECT_LT((ranges.Y - ground_truth).cwiseAbs().maxCoeff(), 1e-3 * ground_truth.maxCoeff())
        << length_s;
  }
}

TEST(WindowedRanges, ShrugOffOneReadingInTenThatIsFarOff) {
  Drive spoilt = drive({.range_sigma_m = 0.05}, 2);
  for (std::size_t i = 0; i < spoilt.log.ranges.size(); i += 10)
    spoilt.log.ranges[i].range_m += 8.0;
  const auto worst = [](const Drive& d) {
    const WindowedRanges ranges =
        windowed_ranges(measurements_of(d), d.odometry, d.odometry.time_s, {.length_s = 60.0});
    return (ranges.Y - true_half_squares(d)).cwiseAbs().mean();
  };
  EXPECT_LT(worst(spoilt), 5.0 * worst(drive({.range_sigma_m = 0.05}, 2)));
}

TEST(WindowedRanges, LeaveOutTimesAtWhichALandmarkIsNotObserved) {
  Drive gap = drive({}, 3);
  std::erase_if(gap.log.ranges, [](const RangeMeasurement& measured) {
    return measured.landmark == 2 && measured.time_s > 80.0 && measured.time_s < 150.0;
  });
  const WindowedRanges ranges =
      windowed_ranges(measurements_of(gap), gap.odometry, gap.odometry.time_s, {.length_s = 10.0});
  EXPECT_LT(ranges.columns.size(), 1500U);
  EXPECT_GT(ranges.columns.size(), 1200U);
  EXPECT_TRUE(ranges.Y.allFinite());
}

TEST(WindowedRanges, OfARobotThatStandsStillAreItsRanges) {
  Drive still = drive({}, 4);
  still.odometry.positions_m.setZero();
  for (RangeMeasurement& measured : still.log.ranges)
    measured.range_m = 3.0 + double(measured.landmark);
  const WindowedRanges ranges = windowed_ranges(measurements_of(still), still.odometry,
                                                still.odometry.time_s, {.length_s = 30.0});
  ASSERT_EQ(ranges.columns.size(), 2001U);
  for (Eigen::Index n = 0; n < 6; ++n)
    EXPECT_NEAR(ranges.Y(n, 1000), 0.5 * std::pow(3.0 + double(n), 2), 1e-6);
}

TEST(RangeScale, ComesFromOdometryAlone) {
  const Drive scaled = drive({.range_sigma_m = 0.1, .range_scale = 1.07}, 5);
  for (const double length_s : {20.0, 50.0, 200.0})
    EXPECT_NEAR(range_scale_of(measurements_of(scaled), 0.0, 200.0, length_s), 1.07, 0.01)
        << length_s;
}

TEST(RangeScale, RefusesWindowsWithoutALength) {
  const std::vector<LandmarkRanges> measurements = measurements_of(drive({}, 5));
  for (const double length_s : {0.0, -1.0, std::nan(""), HUGE_VAL, 1e-9})
    EXPECT_THROW(range_scale_of(measurements, 0.0, 200.0, length_s), InvalidInput) << length_s;
  EXPECT_THROW(range_scale_of(measurements, std::nan(""), 200.0, 10.0), InvalidInput);
}

TEST(WindowedRanges, RefuseMoreThanMemoryHolds) {
  EXPECT_EQ(windowed_size_problem(50, 1'000'000), "");
  EXPECT_EQ(windowed_size_problem(5000, 1'000'000),
            "ranges to 5000 landmarks at 1000000 times are more than 5e+07: give fewer poses or "
            "landmarks");
}

TEST(SpreadRows, AreEvenAndHoldBothEnds) {
  EXPECT_EQ(spread_rows(11, 3), (std::vector<Eigen::Index>{0, 5, 10}));
  EXPECT_EQ(spread_rows(2, 5), (std::vector<Eigen::Index>{0, 1}));
  EXPECT_EQ(spread_rows(7, 1), (std::vector<Eigen::Index>{0}));
  EXPECT_TRUE(spread_rows(7, 0).empty());
  EXPECT_TRUE(spread_rows(0, 7).empty());
  EXPECT_THROW(spread_rows(7, -1), InvalidInput);
}

TEST(WindowChoice, IsLongWhereOdometryIsGoodAndShortWhereItDrifts) {
  const auto chosen_s = [](double gyro_drift) {
    const Drive d = drive({.range_sigma_m = 0.3, .gyro_drift = gyro_drift}, 6);
    return choose_window(measurements_of(d), d.odometry, d.odometry.time_s).options.length_s;
  };
  EXPECT_GT(chosen_s(0.0), 90.0);
  EXPECT_LT(chosen_s(0.03), 0.5 * chosen_s(0.0));
}

TEST(WindowChoice, IsSummedUpForRecords) {
  const Drive d = drive({.range_sigma_m = 0.3}, 6);
  const WindowSearch search = choose_window(measurements_of(d), d.odometry, d.odometry.time_s);
  const WindowCurve curve = summary(search);
  ASSERT_EQ(curve.lengths_s.size(), curve.held_out_m.size());
  EXPECT_DOUBLE_EQ(curve.lengths_s[0], 200.0);
  EXPECT_TRUE(std::ranges::find(curve.lengths_s, curve.chosen_s) != curve.lengths_s.end());
}

TEST(WindowChoice, OfFewMeasurementsSaysThatItCoversTooLittle) {
  Drive sparse = drive({}, 7);
  sparse.log.ranges.resize(10);
  EXPECT_FALSE(
      choose_window(measurements_of(sparse), sparse.odometry, sparse.odometry.time_s).all_covered);
}

TEST(RangesByLandmark, RefuseDisorderAndStrangers) {
  const Drive d = drive({}, 8);
  const auto refused = [&](const RangeMeasurement& measured) {
    std::vector<RangeMeasurement> ranges = d.log.ranges;
    ranges.push_back(measured);
    EXPECT_THROW(ranges_by_landmark(ranges, 6, d.odometry), InvalidInput);
  };
  refused({.time_s = 1.0, .landmark = 0, .range_m = 1.0});
  refused({.time_s = 1e3, .landmark = 6, .range_m = 1.0});
  refused({.time_s = 1e3, .landmark = 0, .range_m = -1.0});
  refused({.time_s = 1e3, .landmark = 0, .range_m = std::nan("")});
  refused({.time_s = std::nan(""), .landmark = 0, .range_m = 1.0});
}

TEST(RangesByLandmark, LeaveOutWhatIsBeyondTheOdometry) {
  Drive d = drive({}, 9);
  const Eigen::Index before = measurements_of(d)[0].size();
  d.log.ranges.push_back({.time_s = 1e3, .landmark = 0, .range_m = 1.0});
  EXPECT_EQ(measurements_of(d)[0].size(), before);
}

}  // namespace
}  // namespace mapproof
