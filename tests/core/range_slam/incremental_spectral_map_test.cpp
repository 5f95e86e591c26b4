#include "core/range_slam/factors/incremental_spectral_map.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/base/errors.hpp"
#include "core/range_slam/factors/squared_ranges.hpp"
#include "core/range_slam/localise.hpp"
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

/// A world of noisy ranges, and the incremental map of it.
struct Streamed {
  Points landmarks, path;
  Eigen::MatrixXd Y;
  IncrementalSpectralMap incremental;

  Streamed(std::uint64_t seed, Eigen::Index N, Eigen::Index T, double sigma_m) : incremental(N) {
    Random random(seed);
    landmarks = points_about(N, random);
    path = points_about(T, random);
    Eigen::MatrixXd ranges = ranges_between(landmarks, path);
    if (sigma_m > 0.0)
      for (double& range : ranges.reshaped()) range += sigma_m * random.normal();
    Y = half_squared_ranges(ranges);
    for (Eigen::Index t = 0; t < T; ++t) incremental.add(Y.col(t));
  }

  KnownLandmarks first_four() const { return {{0, 1, 2, 3}, landmarks.topRows(4)}; }
};

std::vector<StatusCode> codes_of(const SpectralMap& map) {
  std::vector<StatusCode> codes;
  for (const Status& status : map.statuses) codes.push_back(status.code);
  return codes;
}

RC_GTEST_PROP(IncrementalSpectralMap, AgreesWithTheBatchUpToEightLandmarks, (std::uint64_t seed)) {
  const Streamed world(seed, *rc::gen::inRange(4, 9), *rc::gen::inRange(30, 200), 0.005);
  RC_PRE(spread_of(world.landmarks) < 30.0 && conic_condition(world.path) < 60.0);
  const MetricUpgrade batch = metric_upgrade(factorize(world.Y, 4));
  const SpectralMap map = world.incremental.map();
  RC_ASSERT(!batch.map.empty() && !map.empty());
  RC_ASSERT(codes_of(map) == codes_of(batch.map));
  RC_ASSERT(procrustes_gap(landmarks_of(batch.map.C), landmarks_of(map.C)) < 1e-4);
}

TEST(IncrementalSpectralMap, AgreesWithTheBatchOnKnownLandmarksWhateverTheirNumber) {
  for (const Eigen::Index N : {4, 6, 20}) {
    const Streamed world(1, N, 300, 0.1);
    const SpectralMap batch = map_from_known_landmarks(factorize(world.Y, 4), world.first_four());
    const SpectralMap map = world.incremental.map(world.first_four());
    EXPECT_LT((map.C - batch.C).norm(), 1e-7 * batch.C.norm()) << N;
    EXPECT_NEAR(map.range_scale, batch.range_scale, 1e-9) << N;
  }
}

TEST(IncrementalSpectralMap, OfManyLandmarksIsExactWithoutNoiseAndCloseWithIt) {
  const Streamed exact(2, 30, 500, 0.0);
  EXPECT_LT(procrustes_gap(exact.landmarks, landmarks_of(exact.incremental.map().C)), 1e-6);
  const Streamed noisy(2, 30, 500, 0.1);
  const MetricUpgrade batch = metric_upgrade(factorize(noisy.Y, 4));
  const double batch_gap = procrustes_gap(noisy.landmarks, landmarks_of(batch.map.C));
  EXPECT_LT(procrustes_gap(noisy.landmarks, landmarks_of(noisy.incremental.map().C)),
            1.2 * batch_gap);
}

TEST(IncrementalSpectralMap, IsNoDifferentForHavingBeenAskedBefore) {
  const Streamed world(3, 6, 100, 0.1);
  IncrementalSpectralMap asked(6);
  for (Eigen::Index t = 0; t < 100; ++t) {
    asked.add(world.Y.col(t));
    if (t > 20 && t % 7 == 0) asked.map();
  }
  EXPECT_EQ(asked.map().C, world.incremental.map().C);
}

TEST(IncrementalSpectralMap, PlacesNewStepsOnTheMapSoFar) {
  const Streamed world(4, 6, 200, 0.0);
  Random random(5);
  const Points next = points_about(10, random);
  const SpectralMap map = world.incremental.map(world.first_four());
  const Points found =
      localise(landmarks_of(map.C), half_squared_ranges(ranges_between(world.landmarks, next)));
  EXPECT_LT((found - next).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(IncrementalSpectralMap, HasTheStatusesOfTheBatch) {
  // On a line, nearly on one below the noise, and in general position with noise.
  for (const double width_m : {0.0, 1e-3, 10.0}) {
    Random random(7);
    const Points landmarks = points_about(6, random);
    Points path = points_about(80, random);
    path.col(1) *= width_m / 10.0;
    Eigen::MatrixXd ranges = ranges_between(landmarks, path);
    if (width_m > 0.0)
      for (double& range : ranges.reshaped()) range += 0.05 * random.normal();
    const Eigen::MatrixXd Y = half_squared_ranges(ranges);
    IncrementalSpectralMap incremental(6);
    for (Eigen::Index t = 0; t < 80; ++t) incremental.add(Y.col(t));
    const Factorization factors = factorize(Y, 4);
    const bool is_flat = width_m < 1.0;
    EXPECT_EQ(codes_of(incremental.map()), codes_of(metric_upgrade(factors).map)) << width_m;
    EXPECT_EQ(has(incremental.map().statuses, StatusCode::kRankDeficient), is_flat) << width_m;
    const KnownLandmarks known{{0, 1, 2, 3}, landmarks.topRows(4)};
    EXPECT_EQ(codes_of(incremental.map(known)), codes_of(map_from_known_landmarks(factors, known)))
        << width_m;
  }
}

TEST(IncrementalSpectralMap, NeedsNoMoreThanEightStepsEither) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Streamed world(seed, 8, 8, 0.0);
    ASSERT_FALSE(world.incremental.map().empty()) << seed;
    EXPECT_LT(procrustes_gap(world.landmarks, landmarks_of(world.incremental.map().C)), 1e-3)
        << seed;
    const Streamed seven(seed, 8, 7, 0.0);
    EXPECT_EQ(codes_of(seven.incremental.map()),
              (std::vector<StatusCode>{StatusCode::kTooFewObservations}));
  }
}

TEST(IncrementalSpectralMap, OfFewStepsOrALineSaysSo) {
  EXPECT_TRUE(has(IncrementalSpectralMap(5).map().statuses, StatusCode::kTooFewObservations));
  const Streamed few(6, 5, 3, 0.0);
  EXPECT_TRUE(has(few.incremental.map(few.first_four()).statuses, StatusCode::kTooFewObservations));
  Random random(7);
  Points line = points_about(80, random);
  line.col(1).setZero();
  const Eigen::MatrixXd Y = half_squared_ranges(ranges_between(points_about(5, random), line));
  IncrementalSpectralMap incremental(5);
  for (Eigen::Index t = 0; t < 80; ++t) incremental.add(Y.col(t));
  EXPECT_TRUE(incremental.map().empty());
  EXPECT_FALSE(incremental.map().statuses.empty());
}

TEST(IncrementalSpectralMap, RefusesColumnsThatDoNotFit) {
  EXPECT_THROW(IncrementalSpectralMap(0), InvalidInput);
  IncrementalSpectralMap incremental(4);
  EXPECT_THROW(incremental.add(Eigen::VectorXd::Ones(3)), InvalidInput);
  EXPECT_THROW(incremental.add(Eigen::VectorXd::Constant(4, HUGE_VAL)), InvalidInput);
}

}  // namespace
}  // namespace mapproof
