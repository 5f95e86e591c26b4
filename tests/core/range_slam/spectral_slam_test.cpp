#include "core/range_slam/factors/spectral_slam.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/range_slam/factors/squared_ranges.hpp"
#include "core/range_slam/localise.hpp"
#include "tests/core/range_slam/drives.hpp"
#include "tests/core/range_slam/range_worlds.hpp"
#include "tests/support/samples/worlds.hpp"
#include "tests/support/slam_checks.hpp"

namespace mapproof {
namespace {

using test::all_known;
using test::drive;
using test::has;
using test::points_about;
using test::ranges_between;
using test::stacked;

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
  const Points& ground_truth = d.log.ground_truth->positions_m;
  const Points mirrored = 1.2 * ground_truth * Eigen::RowVector2d(1.0, -1.0).asDiagonal();
  const OdometryFit as_is = fit_to_odometry(ground_truth, d.odometry.positions_m, 100);
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

/// Half squares and motions along a polyline between random points.
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
      test::procrustes_gap(stacked(*d.log.true_landmarks, d.log.ground_truth->positions_m),
                           stacked(found.estimate.landmarks_m, found.estimate.path.positions_m)),
      1.0);
  EXPECT_NEAR(found.estimate.range_scale, 1.05, 0.01);
  EXPECT_TRUE(found.estimate.statuses.empty());
}

/// Ranges 7 % long and a window that does not know it: odometry puts all of it right together.
TEST(SpectralSlam, PutsScaleOfRangesMapAndSquaresRightTogether) {
  const test::Drive d = drive({.range_scale = 1.07}, 3);
  const SpectralSlam found =
      spectral_slam(d.log, d.odometry, {.window = WindowOptions{.length_s = 20.0}});
  ASSERT_EQ(found.estimate.path.size(), d.odometry.size());
  EXPECT_NEAR(found.estimate.range_scale, 1.07, 0.01);
  EXPECT_LT(
      test::procrustes_gap(stacked(*d.log.true_landmarks, d.log.ground_truth->positions_m),
                           stacked(found.estimate.landmarks_m, found.estimate.path.positions_m)),
      1.0);
  const Points again = localise(found.estimate.landmarks_m, found.Y);
  EXPECT_LT((again - found.estimate.path.positions_m).rowwise().norm().mean(), 0.5);
}

TEST(SpectralSlam, GivenTheWindowThatItChoseDoesTheSame) {
  const test::Drive d = drive({.range_sigma_m = 0.1, .range_scale = 1.05}, 3);
  const SpectralSlam chosen = spectral_slam(d.log, d.odometry);
  const SpectralSlam given = spectral_slam(d.log, d.odometry, {.window = chosen.window.options});
  EXPECT_FALSE(chosen.window.candidates.empty());
  EXPECT_TRUE(given.window.candidates.empty());
  EXPECT_EQ(given.estimate.path.positions_m, chosen.estimate.path.positions_m);
  EXPECT_EQ(given.estimate.range_scale, chosen.estimate.range_scale);
}

/// Six straight legs of 400 s and 40 m each, with a range to each of six landmarks every second.
test::Drive zigzag() {
  constexpr Eigen::Index kLeg = 400;
  Random random(2);
  test::Drive drive;
  const Points landmarks = points_about(6, random, 25.0);
  Trajectory& path = drive.odometry;
  path = {.time_s = Eigen::VectorXd::LinSpaced(6 * kLeg, 0.0, double(6 * kLeg - 1)),
          .positions_m = Points::Zero(6 * kLeg, 2),
          .heading_rad = {}};
  for (Eigen::Index t = 0; t < path.size(); ++t) {
    const double heading = 1.9 * double(t / kLeg);
    if (t > 0)
      path.positions_m.row(t) = path.positions_m.row(t - 1) +
                                0.1 * Eigen::RowVector2d(std::cos(heading), std::sin(heading));
    for (Eigen::Index n = 0; n < 6; ++n)
      drive.log.ranges.push_back({.time_s = path.time_s(t),
                                  .landmark = n,
                                  .range_m = (landmarks.row(n) - path.positions_m.row(t)).norm()});
  }
  drive.log.landmarks = {"a", "b", "c", "d", "e", "f"};
  drive.log.true_landmarks = landmarks;
  return drive;
}

/// Straight pieces are their own mirror images, and few windows hold a corner.
TEST(SpectralSlam, OfPiecesThatTellNoMirrorSaysSo) {
  const test::Drive d = zigzag();
  const auto found = [&](double length_s) {
    return spectral_slam(d.log, d.odometry, {.window = WindowOptions{.length_s = length_s}})
        .estimate;
  };
  const SlamEstimate uncertain = found(10.0);
  ASSERT_EQ(uncertain.path.size(), d.odometry.size());
  EXPECT_LT(test::procrustes_gap(*d.log.true_landmarks, uncertain.landmarks_m), 0.5);
  EXPECT_TRUE(has(uncertain.statuses, StatusCode::kUndetermined));
  EXPECT_FALSE(has(found(400.0).statuses, StatusCode::kUndetermined));
}

TEST(SpectralSlam, NamesTheLandmarkThatIsObservedAtTheFewestPoses) {
  test::Drive d = drive({}, 5);
  d.log.landmarks[2] = "door";
  std::erase_if(d.log.ranges, [](const RangeMeasurement& measured) {
    return measured.landmark == 2 && measured.time_s > 150.0;
  });
  const WindowOptions window{.length_s = 20.0};
  const SpectralSlam some = spectral_slam(d.log, d.odometry, {.window = window});
  EXPECT_FALSE(has(some.estimate.statuses, StatusCode::kTooFewObservations));
  ASSERT_TRUE(has(some.estimate.statuses, StatusCode::kUndetermined));
  EXPECT_EQ(some.estimate.statuses[0].names, std::vector<std::string>{"door"});
  std::erase_if(d.log.ranges,
                [](const RangeMeasurement& measured) { return measured.landmark == 2; });
  const SpectralSlam none = spectral_slam(d.log, d.odometry, {.window = window});
  ASSERT_TRUE(has(none.estimate.statuses, StatusCode::kTooFewObservations));
  EXPECT_EQ(none.estimate.statuses[0].names, std::vector<std::string>{"door"});
  EXPECT_EQ(none.estimate.statuses[0].values.back(), 0.0);
}

TEST(SpectralSlam, RefusesMoreRangesThanMemoryHolds) {
  RangeLog crowded;
  crowded.landmarks.resize(5000);
  const Eigen::Index poses = 1'000'000;
  const Trajectory odometry{.time_s = Eigen::VectorXd::LinSpaced(poses, 0.0, 1e6),
                            .positions_m = Points::Zero(poses, 2),
                            .heading_rad = {}};
  EXPECT_THROW(spectral_slam(crowded, odometry, {.window = WindowOptions{.length_s = 1e5}}),
               InvalidInput);
}

TEST(SpectralSlam, WithKnownLandmarksIsInTheirFrameWithHeadings) {
  const test::Drive d = drive({.range_sigma_m = 0.1, .gyro_drift = 0.002}, 4);
  for (const bool with_heading : {false, true}) {
    const SpectralSlam found =
        spectral_slam(d.log, d.odometry, {.known = all_known(d.log), .with_heading = with_heading});
    const Points error = found.estimate.path.positions_m - d.log.ground_truth->positions_m;
    EXPECT_LT(error.rowwise().norm().mean(), 0.3) << with_heading;
    if (with_heading) {
      EXPECT_LT((found.estimate.path.heading_rad - d.log.ground_truth->heading_rad)
                    .array()
                    .sin()
                    .abs()
                    .mean(),
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
    // 167 ranges of 0.2 m cannot determine it much better, nor worse than one of them.
    EXPECT_GT(sigma_m, 0.2 / std::sqrt(167.0) / 4.0);
    EXPECT_LT(sigma_m, 0.2);
    EXPECT_LT(error_m, 10.0 * sigma_m);
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
  for (RangeMeasurement& measured : d.log.ranges)
    measured.range_m = 3.0 + double(measured.landmark);
  const SpectralSlam found = spectral_slam(d.log, d.odometry);
  EXPECT_FALSE(found.estimate.statuses.empty());
  EXPECT_TRUE(found.estimate.path.positions_m.allFinite());
  EXPECT_TRUE(std::isfinite(found.estimate.condition.value_or(0.0)));
}

}  // namespace
}  // namespace mapproof
