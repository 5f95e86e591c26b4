#include <gtest/gtest.h>
#include <Eigen/LU>

#include <array>
#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/experiment/slam_worlds.hpp"
#include "core/range_slam/factors/metric_upgrade.hpp"
#include "core/range_slam/refinement/bootstrap.hpp"
#include "core/simulate/range_world.hpp"
#include "tests/core/range_slam/range_worlds.hpp"

namespace mapproof {
namespace {

using test::points_about;
using test::ranges_between;

TEST(CanonicalAngles, OfPlanesThatShareALineAreZeroAndTheAngleBetweenThem) {
  for (const double angle : {1e-9, 0.3, 1.2, std::numbers::pi / 2.0}) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(3, 2), B(3, 2);
    B << 2.0, 1.0, 0.0, std::cos(angle), 0.0, std::sin(angle);  // not orthonormal
    const Eigen::VectorXd angles = canonical_angles(A, B);
    EXPECT_NEAR(angles(0), 0.0, 1e-14);
    EXPECT_NEAR(angles(1), angle, 1e-14) << angle;
  }
}

TEST(CanonicalAngles, RefuseWhatSpansNoSubspace) {
  EXPECT_THROW(canonical_angles(Eigen::MatrixXd::Ones(3, 2), Eigen::MatrixXd::Identity(3, 2)),
               InvalidInput);
  EXPECT_THROW(canonical_angles(Eigen::MatrixXd::Ones(3, 1), Eigen::MatrixXd::Ones(2, 1)),
               InvalidInput);
}

TEST(SubspaceErrorBound, FallsAsTheRootOfTheSteps) {
  const double ratio =
      subspace_error_bound(6, 400, 1.0, 2.0) / subspace_error_bound(6, 1600, 1.0, 2.0);
  EXPECT_NEAR(ratio, 2.0 * std::sqrt(std::log(400.0) / std::log(1600.0)), 1e-12);
  EXPECT_THROW(subspace_error_bound(6, 400, 1.0, 0.0), InvalidInput);
}

TrueRanges world_of(const RangeWorldOptions& options, std::uint64_t seed) {
  const RangeWorld world = simulate_range_world(options, seed);
  return {.landmarks_m = world.landmarks_m,
          .positions_m = world.positions_m,
          .ranges_m = world.ranges_m,
          .noise = {.sigma_m = options.noise_m, .share = options.noise_share}};
}

TEST(RangeWorld, HasTheNoiseAskedForAndStaysInside) {
  const RangeWorldOptions options{
      .landmarks = 4, .steps = 20000, .noise_share = 0.02, .noise_correlation = 0.6};
  const RangeWorld world = simulate_range_world(options, 1);
  EXPECT_LE(world.positions_m.cwiseAbs().maxCoeff(), 10.0);
  EXPECT_LE(world.landmarks_m.cwiseAbs().maxCoeff(), 10.0);
  const Eigen::ArrayXXd exact = ranges_between(world.landmarks_m, world.positions_m);
  const Eigen::ArrayXXd share = world.ranges_m.array() / exact - 1.0;
  EXPECT_NEAR(std::sqrt(share.square().mean()), 0.02, 3e-4);
  const auto T = share.cols();
  EXPECT_NEAR((share.leftCols(T - 1) * share.rightCols(T - 1)).mean() / share.square().mean(), 0.6,
              0.02);
  for (Eigen::Index t = 0; t + 1 < T; ++t)
    ASSERT_NEAR((world.positions_m.row(t + 1) - world.positions_m.row(t)).norm(), 1.0, 1e-12);
}

TEST(RangeWorld, RefusesWhatItCannotWalk) {
  EXPECT_THROW(simulate_range_world({.step_m = 11.0}, 1), InvalidInput);
  EXPECT_THROW(simulate_range_world({.noise_correlation = 1.0}, 1), InvalidInput);
  EXPECT_THROW(simulate_range_world({.landmarks = 0}, 1), InvalidInput);
}

TEST(ModelErrors, AreZeroWithoutNoise) {
  const std::array<Eigen::Index, 2> steps{50, 300};
  const auto errors = model_errors(world_of({.noise_share = 0.0}, 2), steps);
  ASSERT_EQ(errors.size(), 2U);
  for (const ModelError& error : errors) {
    EXPECT_LT(error.observation, 1e-7);
    EXPECT_LT(error.landmarks_m, 1e-7);
    EXPECT_LT(error.positions_m, 1e-7);
    EXPECT_LT(error.sine, 1e-9);
  }
}

/// Median over worlds of the observation model's error after so many steps.
std::vector<double> median_errors(const RangeWorldOptions& options,
                                  std::span<const Eigen::Index> steps,
                                  const ModelErrorOptions& model = {}) {
  std::vector<std::vector<double>> all(steps.size());
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const auto errors = model_errors(world_of(options, seed), steps, model);
    for (std::size_t i = 0; i < errors.size(); ++i)
      if (errors.size() == steps.size()) all[i].push_back(errors[i].observation);
  }
  std::vector<double> medians;
  for (std::vector<double>& values : all) {
    std::ranges::sort(values);
    medians.push_back(values[values.size() / 2]);
  }
  return medians;
}

TEST(ModelErrors, FallWithTheRootOfTheSteps) {
  const std::array<Eigen::Index, 2> steps{500, 8000};
  const auto medians = median_errors({.steps = 8000}, steps);
  const double slope = std::log(medians[1] / medians[0]) / std::log(16.0);
  EXPECT_LT(slope, -0.35);
  EXPECT_GT(slope, -0.75);
}

TEST(ModelErrors, StopFallingWhereNoiseStaysInTheGramMatrix) {
  const std::array<Eigen::Index, 1> steps{8000};
  const RangeWorldOptions options{.steps = 8000};
  EXPECT_GT(median_errors(options, steps, {.subtract_variances = false})[0],
            2.0 * median_errors(options, steps)[0]);
}

TEST(ModelErrors, AreGreaterWhereNoiseIsCorrelated) {
  const std::array<Eigen::Index, 1> steps{2000};
  EXPECT_GT(median_errors({.steps = 2000, .noise_correlation = 0.9}, steps)[0],
            1.5 * median_errors({.steps = 2000}, steps)[0]);
}

TEST(LandmarkBootstrap, HasTheSpreadOfMapsOfFreshRanges) {
  Random random(3);
  Points landmarks(5, 2);
  landmarks << -8.0, -7.0, 9.0, -6.0, 7.0, 8.0, 0.0, 1.0, -6.0, 9.0;
  const Points path = points_about(300, random);
  const auto noisy = [&] {
    Eigen::MatrixXd ranges = ranges_between(landmarks, path);
    for (double& range : ranges.reshaped()) range += 0.1 * random.normal();
    return half_squared_ranges(ranges, {.sigma_m = 0.1});
  };
  const KnownLandmarks known{{0, 1, 2, 3}, landmarks.topRows(4)};
  double square = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Points map = landmarks_of(map_from_known_landmarks(factorize(noisy(), 4), known).C);
    square += (map.row(4) - landmarks.row(4)).squaredNorm() / 200.0;
  }
  const Eigen::MatrixXd Y = noisy();
  const Points map = landmarks_of(map_from_known_landmarks(factorize(Y, 4), known).C);
  const LandmarkBootstrap found = bootstrap_landmarks(Y, map, known, {.replicates = 300});
  EXPECT_EQ(found.maps, 300);
  EXPECT_NEAR(std::sqrt(found.covariances_m2[4].trace() / square), 1.0, 0.25);
  EXPECT_LT(found.covariances_m2[0].trace(), 1e-12);  // known
}

TEST(LandmarkBootstrap, OfAnUnknownMapIsPositiveAndRepeats) {
  Random random(4);
  const Points landmarks = points_about(6, random), path = points_about(200, random);
  Eigen::MatrixXd ranges = ranges_between(landmarks, path);
  for (double& range : ranges.reshaped()) range += 0.1 * random.normal();
  const Eigen::MatrixXd Y = half_squared_ranges(ranges);
  const Points map = landmarks_of(metric_upgrade(factorize(Y, 4)).map.C);
  const BootstrapOptions options{.replicates = 50, .block = 10, .seed = 7};
  const LandmarkBootstrap found = bootstrap_landmarks(Y, map, std::nullopt, options);
  const LandmarkBootstrap again = bootstrap_landmarks(Y, map, std::nullopt, options);
  ASSERT_EQ(found.covariances_m2.size(), 6U);
  for (std::size_t n = 0; n < 6; ++n) {
    EXPECT_GT(found.covariances_m2[n].determinant(), 0.0);
    EXPECT_LT(std::sqrt(found.covariances_m2[n].trace()), 1.0);
    EXPECT_EQ(found.covariances_m2[n], again.covariances_m2[n]);
  }
}

}  // namespace
}  // namespace mapproof
