#include "core/range_slam/spectral_slam.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/range_slam/heading.hpp"
#include "core/range_slam/localise.hpp"
#include "core/range_slam/odometry_fit.hpp"
#include "core/range_slam/squared_ranges.hpp"
#include "tests/core/range_slam/drives.hpp"
#include "tests/core/range_slam/plaza.hpp"
#include "tests/core/range_slam/range_worlds.hpp"
#include "tests/support/worlds.hpp"

namespace mapproof {
namespace {

using test::drive;
using test::has;
using test::points_about;
using test::ranges_between;
using test::stacked;

KnownLandmarks all_known(const RangeLog& log) {
  KnownLandmarks known{.rows = {}, .positions_m = *log.true_landmarks};
  for (Eigen::Index n = 0; n < known.positions_m.rows(); ++n) known.rows.push_back(n);
  return known;
}

TEST(Localise, FindsPositionsFromAMap) {
  Random random(1);
  const Points landmarks = points_about(3, random, 10.0, {300.0, -50.0});
  const Points path = points_about(40, random, 10.0, {300.0, -50.0});
  const Eigen::MatrixXd Y = half_squared_ranges(ranges_between(landmarks, path));
  EXPECT_LT((localise(landmarks, Y) - path).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_THROW(localise(Points::Ones(3, 2), Y), InvalidInput);
  EXPECT_THROW(localise(landmarks, Y.topRows(2)), InvalidInput);
}

TEST(OdometryFit, TellsScaleAndMirrorInSpiteOfDrift) {
  const test::Drive d = drive({.gyro_drift = 0.01}, 1);
  const Points& truth = d.log.truth->positions_m;
  const Points mirrored = 1.2 * truth * Eigen::RowVector2d(1.0, -1.0).asDiagonal();
  const OdometryFit as_is = fit_to_odometry(truth, d.odometry.positions_m, 100);
  const OdometryFit other = fit_to_odometry(mirrored, d.odometry.positions_m, 100);
  EXPECT_FALSE(as_is.mirrored);
  EXPECT_TRUE(other.mirrored);
  EXPECT_NEAR(as_is.scale, 1.0, 0.01);
  EXPECT_NEAR(other.scale, 1.2, 0.01);
}

TEST(OdometryFit, OfARobotThatStandsStillTellsNothing) {
  const OdometryFit fit = fit_to_odometry(Points::Zero(20, 2), Points::Zero(20, 2), 5);
  EXPECT_EQ(fit.scale, 1.0);
  EXPECT_EQ(fit.agreement, 0.0);
}

/// Half squares and motions along a random polyline of legs of about a metre.
struct Legs {
  Points landmarks, path;
  Eigen::VectorXd moved_m, heading_rad;
  Eigen::MatrixXd Y;

  explicit Legs(std::uint64_t seed, Eigen::Index N, Eigen::Index T) {
    Random random(seed);
    landmarks = points_about(N, random);
    path = points_about(T, random);
    const Points legs = path.bottomRows(T - 1) - path.topRows(T - 1);
    moved_m = legs.rowwise().norm();
    heading_rad.resize(T - 1);
    for (Eigen::Index t = 0; t + 1 < T; ++t) heading_rad(t) = std::atan2(legs(t, 1), legs(t, 0));
    Y = half_squared_ranges(ranges_between(landmarks, path));
  }
};

TEST(MapWithHeading, GivesHeadingsBackFromKnownLandmarks) {
  const Legs legs(1, 6, 80);
  const HeadingMap found =
      map_with_heading(heading_columns(legs.Y, legs.moved_m, 0.01),
                       KnownLandmarks{{0, 2, 3, 5}, legs.landmarks({0, 2, 3, 5}, Eigen::all)});
  ASSERT_EQ(found.heading_rad.size(), 79);
  EXPECT_LT((found.heading_rad - legs.heading_rad).array().sin().abs().maxCoeff(), 1e-8);
  EXPECT_LT((landmarks_of(found.map.C) - legs.landmarks).norm(), 1e-8);
  EXPECT_LT(found.singular_values(7), 1e-12 * found.singular_values(0));  // rank 7
  EXPECT_GT(found.singular_values(6), 1e-6 * found.singular_values(0));
}

TEST(MapWithHeading, GivesHeadingsInTheFrameOfAnUnknownMap) {
  for (const Eigen::Index N : {4, 7}) {
    const Legs legs(2, N, 80);
    const HeadingMap found =
        map_with_heading(heading_columns(legs.Y, legs.moved_m, 0.01), std::nullopt);
    ASSERT_FALSE(found.map.empty());
    const Points path = positions_of(found.map.X);
    EXPECT_LT(test::procrustes_gap(legs.path.topRows(79), path), 1e-7);
    for (Eigen::Index t = 0; t + 1 < 79; ++t) {
      const Eigen::RowVector2d leg = path.row(t + 1) - path.row(t);
      EXPECT_NEAR(std::sin(found.heading_rad(t) - std::atan2(leg(1), leg(0))), 0.0, 1e-6);
    }
  }
}

TEST(MapWithHeading, LeavesOutStepsThatHardlyMove) {
  Legs legs(3, 5, 60);
  legs.path.row(31) = legs.path.row(30);
  legs.moved_m(30) = 0.0;
  const HeadingColumns columns = heading_columns(legs.Y, legs.moved_m, 0.01);
  EXPECT_TRUE(std::ranges::find(columns.steps, 30) == columns.steps.end());
  EXPECT_TRUE(columns.Y.allFinite());
}

TEST(SpectralSlam, MapsADriveOfSingleNoisyRanges) {
  const test::Drive d = drive({.range_sigma_m = 0.1, .range_scale = 1.05, .gyro_drift = 0.002}, 3);
  const SpectralSlam found = spectral_slam(d.log, d.odometry);
  ASSERT_EQ(found.estimate.path.size(), d.odometry.size());
  EXPECT_LT(
      test::procrustes_gap(stacked(*d.log.true_landmarks, d.log.truth->positions_m),
                           stacked(found.estimate.landmarks_m, found.estimate.path.positions_m)),
      1.0);
  EXPECT_NEAR(found.estimate.range_scale, 1.05, 0.01);
  EXPECT_TRUE(found.estimate.statuses.empty());
}

TEST(SpectralSlam, WithKnownLandmarksIsInTheirFrameWithHeadings) {
  const test::Drive d = drive({.range_sigma_m = 0.1, .gyro_drift = 0.002}, 4);
  for (const bool with_heading : {false, true}) {
    const SpectralSlam found =
        spectral_slam(d.log, d.odometry, {.known = all_known(d.log), .with_heading = with_heading});
    const Points error = found.estimate.path.positions_m - d.log.truth->positions_m;
    EXPECT_LT(error.rowwise().norm().mean(), 0.3) << with_heading;
    if (with_heading) {
      EXPECT_LT(
          (found.estimate.path.heading_rad - d.log.truth->heading_rad).array().sin().abs().mean(),
          0.1);
    }
  }
}

TEST(SpectralSlam, GivesCovariancesThatCoverTheErrorsOfItsLandmarks) {
  const test::Drive d = drive({.range_sigma_m = 0.2}, 7);
  const KnownLandmarks four{{0, 1, 2, 3}, d.log.true_landmarks->topRows(4)};
  const SlamEstimate estimate =
      spectral_slam(d.log, d.odometry, {.known = four, .replicates = 100}).estimate;
  ASSERT_EQ(estimate.landmark_cov_m2.size(), 6U);
  for (const Eigen::Index n : {4, 5}) {
    const double sigma_m = std::sqrt(estimate.landmark_cov_m2[std::size_t(n)].trace());
    const double error_m = (estimate.landmarks_m.row(n) - d.log.true_landmarks->row(n)).norm();
    EXPECT_GT(sigma_m, 0.0);
    EXPECT_LT(error_m, 6.0 * sigma_m + 0.2);
  }
}

TEST(SpectralSlam, OfTooLittleSaysSo) {
  test::Drive d = drive({}, 5);
  d.log.ranges.resize(12);
  const SpectralSlam found = spectral_slam(d.log, d.odometry);
  EXPECT_EQ(found.estimate.path.size(), 0);
  EXPECT_TRUE(found.estimate.landmarks_m.array().isNaN().all());
  EXPECT_TRUE(has(found.estimate.statuses, StatusCode::kTooFewObservations));
}

TEST(SpectralSlam, OfARobotThatStandsStillSaysSo) {
  test::Drive d = drive({}, 6);
  d.odometry.positions_m.setZero();
  for (RangeReading& reading : d.log.ranges) reading.range_m = 3.0 + double(reading.landmark);
  const SpectralSlam found = spectral_slam(d.log, d.odometry);
  EXPECT_FALSE(found.estimate.statuses.empty());
  EXPECT_TRUE(found.estimate.path.positions_m.allFinite());
  EXPECT_TRUE(std::isfinite(found.estimate.condition.value_or(0.0)));
}

struct PlazaTarget {
  const char* name;
  double free_m;   ///< No landmark known, best rigid motion.
  double known_m;  ///< Four known, as it is.
};

class PlazaSlam : public ::testing::TestWithParam<PlazaTarget> {};

TEST_P(PlazaSlam, ReachesItsErrorsWithWindowsChosenWithoutTruth) {
  const std::optional<test::Plaza> plaza = test::plaza(GetParam().name);
  if (!plaza) GTEST_SKIP() << "MAPPROOF_PLAZA does not name the folder of the Plaza data";
  const SpectralSlam free = spectral_slam(plaza->log, plaza->odometry);
  EXPECT_EQ(free.estimate.path.size(), plaza->odometry.size());
  EXPECT_LT(test::mean_error_m(*plaza, free.estimate, Alignment::kRigid), GetParam().free_m);
  EXPECT_NEAR(free.estimate.range_scale, 1.07, 0.02);
  for (const bool with_heading : {false, true}) {
    const SpectralSlam known =
        spectral_slam(plaza->log, plaza->odometry,
                      {.known = all_known(plaza->log), .with_heading = with_heading});
    EXPECT_LT(test::mean_error_m(*plaza, known.estimate, Alignment::kNone), GetParam().known_m);
    if (with_heading) {
      // Modulo pi: the true headings of Plaza 2 are turned about.
      const Eigen::ArrayXd off = known.estimate.path.heading_rad - plaza->log.truth->heading_rad;
      EXPECT_LT(off.sin().abs().mean(), 0.06);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, PlazaSlam,
                         ::testing::Values(PlazaTarget{"plaza1", 0.70, 0.89},
                                           PlazaTarget{"plaza2", 0.30, 0.36}),
                         [](const auto& set) { return std::string(set.param.name); });

}  // namespace
}  // namespace mapproof
