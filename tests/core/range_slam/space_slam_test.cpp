#include "core/range_slam/factors/synchronous_slam.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numeric>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "core/align/rigid.hpp"
#include "core/base/errors.hpp"
#include "core/experiment/slam_worlds.hpp"
#include "core/range_slam/factors/metric_upgrade.hpp"
#include "core/range_slam/factors/quadric.hpp"
#include "core/simulate/range_world.hpp"
#include "tests/support/slam_checks.hpp"

namespace mapproof {
namespace {

using test::has;

SpacePoints space_points(Eigen::Index n, Random& random, double reach = 10.0,
                         const Eigen::RowVector3d& center = Eigen::RowVector3d::Zero()) {
  SpacePoints points(n, 3);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < 3; ++k) points(i, k) = center(k) + random.uniform(-reach, reach);
  return points;
}

Eigen::MatrixXd ranges_of(const SpacePoints& landmarks, const SpacePoints& path) {
  Random random(1);
  return simulated_ranges(landmarks, path, {}, random);
}

KnownSpaceLandmarks first_known(const SpacePoints& landmarks, Eigen::Index count) {
  KnownSpaceLandmarks known{.rows = std::vector<Eigen::Index>(static_cast<std::size_t>(count)),
                            .positions_m = landmarks.topRows(count)};
  std::iota(known.rows.begin(), known.rows.end(), Eigen::Index{0});
  return known;
}

/// Largest distance of a landmark or position from its true one, as it came or after the best
/// motion or reflection; infinite without a map.
double gap(const SpaceEstimate& estimate, const SpacePoints& landmarks, const SpacePoints& path,
           bool aligned) {
  if (estimate.empty()) return HUGE_VAL;
  SpacePoints ground_truth(landmarks.rows() + path.rows(), 3), found(ground_truth.rows(), 3);
  ground_truth << landmarks, path;
  found << estimate.landmarks_m, estimate.positions_m;
  if (aligned) found = fit_space_motion(found, ground_truth, true)(found);
  return (found - ground_truth).rowwise().norm().maxCoeff();
}

Eigen::MatrixXd as_columns(const SpacePoints& points) {
  const SpacePoints offsets = points.rowwise() - points.colwise().mean();
  const SpacePoints p = offsets * std::sqrt(double(offsets.rows()) / offsets.squaredNorm());
  Eigen::MatrixXd columns(p.rows(), 5);
  columns << Eigen::VectorXd::Ones(p.rows()), p, p.rowwise().squaredNorm();
  return columns;
}

double condition_of(const Eigen::MatrixXd& columns) {
  const Eigen::VectorXd s =
      Eigen::JacobiSVD<Eigen::MatrixXd>(columns.colwise().normalized()).singularValues();
  return s(0) / s(s.size() - 1);
}

/// How near points are to a plane or sphere.
double flatness(const SpacePoints& points) { return condition_of(as_columns(points)); }

/// How near they are to a surface of those that more quadrics than one cut from the paraboloid: the
/// condition of the products of [1, x, y, z, r^2], less the square of r that depends on others.
double quadric_condition(const SpacePoints& points) {
  const Eigen::MatrixXd v = as_columns(points);
  Eigen::MatrixXd products(v.rows(), 14);
  Eigen::Index column = 0;
  for (Eigen::Index i = 0; i < 5; ++i)
    for (Eigen::Index j = i; j < 5; ++j)
      if (i != 0 || j != 4) products.col(column++) = v.col(i).cwiseProduct(v.col(j));
  return condition_of(products);
}

RC_GTEST_PROP(SpaceSlam, GivesBackAnyWorldInSpaceUpToAMotionOrMirror, (std::uint64_t seed)) {
  Random random(seed);
  const double size = std::exp(random.uniform(-3.0, 6.0));
  const Eigen::RowVector3d center(random.uniform(-2.0, 2.0) * size, 0.0, size);
  const SpacePoints landmarks = space_points(*rc::gen::inRange(6, 20), random, size, center);
  const SpacePoints path = space_points(*rc::gen::inRange(60, 300), random, size, center);
  RC_PRE(flatness(landmarks) < 30.0 && quadric_condition(path) < 60.0);
  const SpaceEstimate estimate = space_slam(ranges_of(landmarks, path), std::nullopt);
  RC_ASSERT(estimate.statuses.empty());
  RC_ASSERT(gap(estimate, landmarks, path, true) < 1e-9 * size);
}

RC_GTEST_PROP(SpaceSlam, WithFiveKnownLandmarksGivesBackTheWorldItself, (std::uint64_t seed)) {
  Random random(seed);
  const double size = std::exp(random.uniform(-3.0, 6.0));
  const SpacePoints landmarks = space_points(*rc::gen::inRange(5, 20), random, size);
  const SpacePoints path = space_points(*rc::gen::inRange(20, 200), random, size);
  const SpacePoints first = landmarks.topRows(5);
  RC_PRE(flatness(first) < 100.0 && flatness(path) < 100.0);
  const SpaceEstimate estimate = space_slam(ranges_of(landmarks, path), first_known(landmarks, 5));
  RC_ASSERT(estimate.statuses.empty());
  RC_ASSERT(std::abs(estimate.range_scale - 1.0) < 1e-9);
  RC_ASSERT(gap(estimate, landmarks, path, false) < 1e-9 * size);
}

TEST(SpaceSlam, FindsTheCommonScaleOfRangesFromKnownLandmarks) {
  Random random(3);
  const SpacePoints landmarks = space_points(9, random), path = space_points(80, random);
  const SpaceEstimate estimate =
      space_slam(1.07 * ranges_of(landmarks, path), first_known(landmarks, 6));
  EXPECT_NEAR(estimate.range_scale, 1.07, 1e-9);
  EXPECT_LT(gap(estimate, landmarks, path, false), 1e-8);
}

TEST(SpaceSlam, NeedsNoMoreThanThirteenSteps) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    const SpacePoints landmarks = space_points(9, random), path = space_points(13, random);
    const SpaceEstimate estimate = space_slam(ranges_of(landmarks, path), std::nullopt);
    EXPECT_LT(gap(estimate, landmarks, path, true), 1e-4) << seed;
  }
}

TEST(SpaceSlam, TakesAFlightAlongAnEllipsoid) {
  Random random(5);
  const SpacePoints landmarks = space_points(8, random);
  SpacePoints path = space_points(120, random);
  path.rowwise().normalize();
  path *= Eigen::Vector3d(9.0, 6.0, 3.0).asDiagonal();
  EXPECT_LT(gap(space_slam(ranges_of(landmarks, path), std::nullopt), landmarks, path, true), 1e-6);
}

TEST(SpaceSlam, RangesInSpaceHaveRankFive) {
  Random random(6);
  const SpacePoints landmarks = space_points(12, random), path = space_points(60, random);
  const SpaceEstimate estimate = space_slam(ranges_of(landmarks, path), std::nullopt);
  EXPECT_GT(estimate.singular_values(4), 1.0);
  EXPECT_LT(estimate.singular_values(5), 1e-9);
}

TEST(SpaceSlam, ErrsAboutAsMuchAsTheNoiseAndSaysNothing) {
  RangeFlightOptions options{.noise = {.sigma_m = 0.05}};
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const RangeFlight flight = simulate_range_flight(options, seed);
    const SpaceEstimate estimate =
        space_slam(flight.ranges_m, std::nullopt, {.sigma_m = 0.05, .share = 0.0});
    EXPECT_TRUE(estimate.statuses.empty()) << seed;
    EXPECT_LT(gap(estimate, flight.landmarks_m, flight.positions_m, true), 2.0) << seed;
  }
}

/// A plane that is none of the axes', and a sphere.
std::vector<SpacePoints> flat_sets(Eigen::Index n, Random& random) {
  SpacePoints plane = space_points(n, random), sphere = space_points(n, random);
  plane.col(2) = 0.4 * plane.col(0) - 0.2 * plane.col(1) + Eigen::VectorXd::Constant(n, 3.0);
  sphere.rowwise().normalize();
  sphere = (7.0 * sphere).rowwise() + Eigen::RowVector3d(1.0, 2.0, 3.0);
  return {plane, sphere};
}

TEST(SpaceSlam, OfLandmarksOrAFlightInAPlaneOrOnASphereSaysSoAndGivesNoMap) {
  Random random(7);
  const SpacePoints some = space_points(40, random);
  for (const SpacePoints& flat : flat_sets(40, random))
    for (const double noise_m : {0.0, 1e-3, 0.1})
      for (const bool landmarks_are_flat : {false, true}) {
        const SpacePoints& landmarks = landmarks_are_flat ? flat : some;
        const SpacePoints& path = landmarks_are_flat ? some : flat;
        const Eigen::MatrixXd ranges =
            simulated_ranges(landmarks, path, {.sigma_m = noise_m}, random);
        for (const auto& known :
             {std::optional<KnownSpaceLandmarks>(), std::optional(first_known(landmarks, 9))}) {
          const SpaceEstimate estimate =
              space_slam(ranges, known, {.sigma_m = noise_m, .share = 0.0});
          EXPECT_TRUE(estimate.empty()) << noise_m << landmarks_are_flat << known.has_value();
          EXPECT_TRUE(estimate.landmarks_m.array().isNaN().all());
          EXPECT_TRUE(has(estimate.statuses, StatusCode::kDegenerateGeometry));
        }
      }
}

TEST(SpaceSlam, OfKnownLandmarksOnASphereSaysSo) {
  Random random(8);
  for (const SpacePoints& flat : flat_sets(6, random)) {
    SpacePoints landmarks = space_points(12, random);
    landmarks.topRows(6) = flat;
    const SpaceEstimate estimate =
        space_slam(ranges_of(landmarks, space_points(60, random)), first_known(landmarks, 6));
    EXPECT_TRUE(estimate.empty());
    EXPECT_TRUE(has(estimate.statuses, StatusCode::kDegenerateGeometry));
  }
}

TEST(SpaceSlam, RefusesWhatIsTooLittleOrNoWorld) {
  Random random(9);
  const SpacePoints landmarks = space_points(8, random), path = space_points(40, random);
  const Eigen::MatrixXd ranges = ranges_of(landmarks, path);
  EXPECT_TRUE(
      has(space_slam(ranges.topRows(4), std::nullopt).statuses, StatusCode::kTooFewObservations));
  EXPECT_TRUE(
      has(space_slam(ranges.leftCols(12), std::nullopt).statuses, StatusCode::kTooFewObservations));
  EXPECT_TRUE(
      has(space_slam(ranges, first_known(landmarks, 4)).statuses, StatusCode::kTooFewObservations));
  KnownSpaceLandmarks twice = first_known(landmarks, 6);
  twice.rows[5] = 0;
  EXPECT_THROW(space_slam(ranges, twice), InvalidInput);
  Eigen::MatrixXd incomplete = ranges;
  incomplete(0, 0) = NAN;
  EXPECT_THROW(space_slam(incomplete, std::nullopt), InvalidInput);
}

TEST(SpaceSlam, OfRangesThatAreNothingButNoiseIsNoSilentMap) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Eigen::MatrixXd ranges(9, 60);
    for (double& range : ranges.reshaped()) range = random.uniform(1.0, 20.0);
    EXPECT_FALSE(space_slam(ranges, std::nullopt).statuses.empty()) << seed;
  }
}

TEST(MetricUpgradeInSpace, ExportsTheQuadricThatItsPointsLieOn) {
  Random random(10);
  const Eigen::MatrixXd Y =
      half_squared_ranges(ranges_of(space_points(8, random), space_points(90, random)));
  const MetricUpgrade upgrade = metric_upgrade(factorize(Y, 5));
  for (const QuadricCloud* cloud : {&upgrade.before, &upgrade.after}) {
    ASSERT_EQ(cloud->points.cols(), 4);
    Eigen::MatrixXd lifted(90, 5);
    lifted << cloud->points, Eigen::VectorXd::Ones(90);
    const Eigen::VectorXd values = (lifted * cloud->Q).cwiseProduct(lifted).rowwise().sum();
    EXPECT_LT(values.cwiseAbs().maxCoeff(), 1e-9 * cloud->Q.norm() * lifted.squaredNorm());
  }
  EXPECT_LT((upgrade.S * upgrade.map.X - factorize(Y, 5).V).norm(), 1e-8 * Y.norm());
}

TEST(RigidSpace, GivesBackAMotionAndAMirror) {
  Random random(11);
  for (const bool mirrored : {false, true}) {
    const SpacePoints from = space_points(7, random);
    Eigen::Matrix3d R = Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, 2, -1).normalized()).matrix();
    if (mirrored) R.col(1) *= -1.0;
    const SpacePoints to = (from * R.transpose()).rowwise() + Eigen::RowVector3d(3, -1, 5);
    EXPECT_LT((fit_space_motion(from, to, true)(from) - to).norm(), 1e-12);
    const SpaceMotion motion = fit_space_motion(from, to, false);
    EXPECT_NEAR(motion.rotation.determinant(), 1.0, 1e-12);
    EXPECT_EQ((motion(from) - to).norm() < 1e-12, !mirrored);
  }
  EXPECT_THROW(fit_space_motion(SpacePoints(0, 3), SpacePoints(0, 3), true), InvalidInput);
}

SlamExperiment small_flight() {
  SlamExperiment experiment;
  experiment.name = "flight";
  experiment.seed = 3;
  experiment.space = SpaceFlightOptions{.landmarks = 10, .steps = 150, .noise = {}};
  experiment.space->noise.share = 0.005;
  return experiment;
}

TEST(SpaceRun, HasARecordWithKnownLandmarksAndOneWithNoneInTheFrameOfTheGroundTruth) {
  const SpaceRun run = make_space_run(small_flight());
  EXPECT_EQ(run.known.size(), 6U);
  ASSERT_EQ(run.records.size(), 2U);
  EXPECT_TRUE(run.records[0].knows_landmarks);
  EXPECT_EQ(run.records[0].alignment, Alignment::kNone);
  EXPECT_EQ(run.records[1].alignment, Alignment::kRigidWithReflection);
  for (const SpaceRecord& record : run.records) {
    EXPECT_TRUE(record.estimate.statuses.empty());
    EXPECT_LT(*record.landmarks_error_m, 0.5);
    EXPECT_LT(*record.positions_error_m, 0.5);
    EXPECT_NEAR((record.estimate.positions_m - run.positions_m).rowwise().norm().mean(),
                *record.positions_error_m, 1e-12);
  }
  EXPECT_EQ(make_space_run(small_flight()).records[1].estimate.landmarks_m,
            run.records[1].estimate.landmarks_m);
}

TEST(SpaceRun, OfAFlightThatIsNearlyFlatHasNoMapAndSaysWhy) {
  SlamExperiment experiment = small_flight();
  experiment.space->height_m = 0.05;
  experiment.space->step_m = 0.02;
  for (const SpaceRecord& record : make_space_run(experiment).records) {
    EXPECT_TRUE(record.estimate.empty());
    EXPECT_FALSE(record.positions_error_m);
    EXPECT_TRUE(has(record.estimate.statuses, StatusCode::kDegenerateGeometry));
  }
  experiment.space.reset();
  EXPECT_THROW(make_space_run(experiment), InvalidInput);
}

TEST(SlamRun, KeepsTheStatesOfItsMetricUpgradeOnTheirQuadrics) {
  SlamExperiment experiment = small_flight();
  experiment.example = SlamExample{.figure = "fig-1a", .steps = 500, .noise = {}};
  experiment.example->noise.id = "simulation";
  std::vector<SlamTiming> timings;
  const SlamRun run = make_example(experiment, timings);
  ASSERT_TRUE(run.upgrade);
  EXPECT_EQ(run.upgrade->steps.size(), 300U);
  EXPECT_EQ(run.upgrade->steps.back(), 499);
  for (const QuadricPoints& cloud : {run.upgrade->before, run.upgrade->after}) {
    ASSERT_EQ(cloud.points.rows(), 300);
    Eigen::MatrixX4d lifted(300, 4);
    lifted << cloud.points, Eigen::VectorXd::Ones(300);
    const Eigen::VectorXd values = (lifted * cloud.Q).cwiseProduct(lifted).rowwise().sum();
    EXPECT_LT(values.cwiseAbs().maxCoeff(), 1e-9 * cloud.Q.norm() * lifted.squaredNorm());
    EXPECT_EQ(cloud.Q, cloud.Q.transpose());
  }
}

TEST(RangeFlight, StaysInItsBoxInStepsOfOneLengthAndIsOfItsSeed) {
  const RangeFlightOptions options{.steps = 300, .height_m = 5.0};
  const RangeFlight flight = simulate_range_flight(options, 4);
  EXPECT_LE(flight.positions_m.leftCols(2).cwiseAbs().maxCoeff(), options.half_width_m);
  EXPECT_GE(flight.positions_m.col(2).minCoeff(), 0.0);
  EXPECT_LE(flight.positions_m.col(2).maxCoeff(), 5.0);
  const SpacePoints legs = flight.positions_m.bottomRows(299) - flight.positions_m.topRows(299);
  EXPECT_LT((legs.rowwise().norm().array() - options.step_m).abs().maxCoeff(), 1e-12);
  EXPECT_EQ(flight.positions_m, simulate_range_flight(options, 4).positions_m);
  EXPECT_NE(flight.positions_m, simulate_range_flight(options, 5).positions_m);
  EXPECT_NEAR(flight.ranges_m(3, 7), (flight.landmarks_m.row(3) - flight.positions_m.row(7)).norm(),
              1e-12);
}

TEST(RangeFlight, RefusesWhatIsNoWorld) {
  const auto refused = [](auto change) {
    RangeFlightOptions options;
    change(options);
    EXPECT_THROW(simulate_range_flight(options, 1), InvalidInput);
  };
  refused([](RangeFlightOptions& o) { o.landmarks = 0; });
  refused([](RangeFlightOptions& o) { o.height_m = 0.0; });
  refused([](RangeFlightOptions& o) { o.step_m = 5.0; });
  refused([](RangeFlightOptions& o) { o.half_width_m = NAN; });
  refused([](RangeFlightOptions& o) { o.heading_change_sigma_rad = NAN; });
  refused([](RangeFlightOptions& o) { o.noise.sigma_m = -1.0; });
  refused([](RangeFlightOptions& o) { o.noise.correlation = 1.0; });
}

}  // namespace
}  // namespace mapproof
