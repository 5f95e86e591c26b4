#include "core/range_slam/online.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/base/errors.hpp"
#include "core/range_slam/localise.hpp"
#include "core/range_slam/squared_ranges.hpp"
#include "tests/core/range_slam/range_worlds.hpp"
#include "tests/support/worlds.hpp"

namespace mapproof {
namespace {

using test::has;
using test::points_about;
using test::procrustes_gap;
using test::ranges_between;

/// A world of noisy ranges, and the online map of it.
struct Streamed {
  Points landmarks, path;
  Eigen::MatrixXd Y;
  OnlineSpectralMap online;

  Streamed(std::uint64_t seed, Eigen::Index N, Eigen::Index T, double sigma_m) : online(N) {
    Random random(seed);
    landmarks = points_about(N, random);
    path = points_about(T, random);
    Eigen::MatrixXd ranges = ranges_between(landmarks, path);
    if (sigma_m > 0.0)
      for (double& range : ranges.reshaped()) range += sigma_m * random.normal();
    Y = half_squared_ranges(ranges);
    for (Eigen::Index t = 0; t < T; ++t) online.add(Y.col(t));
  }

  KnownLandmarks first_four() const { return {{0, 1, 2, 3}, landmarks.topRows(4)}; }
};

RC_GTEST_PROP(OnlineSpectralMap, AgreesWithTheBatchUpToEightLandmarks, (std::uint64_t seed)) {
  const Streamed world(seed, *rc::gen::inRange(4, 9), *rc::gen::inRange(30, 200), 0.05);
  const Factorization factors = factorize(world.Y, 4);
  const MetricUpgrade batch = metric_upgrade(factors);
  RC_PRE(!batch.map.empty() && batch.map.statuses.empty() && *batch.map.condition < 100.0 &&
         factors.condition < 1e4);
  const SpectralMap map = world.online.map();
  RC_ASSERT(!map.empty());
  RC_ASSERT(procrustes_gap(landmarks_of(batch.map.C), landmarks_of(map.C)) < 1e-4);
}

TEST(OnlineSpectralMap, AgreesWithTheBatchOnKnownLandmarksWhateverTheirNumber) {
  for (const Eigen::Index N : {4, 6, 20}) {
    const Streamed world(1, N, 300, 0.1);
    const SpectralMap batch = map_from_known_landmarks(factorize(world.Y, 4), world.first_four());
    const SpectralMap map = world.online.map(world.first_four());
    EXPECT_LT((map.C - batch.C).norm(), 1e-7 * batch.C.norm()) << N;
    EXPECT_NEAR(map.range_scale, batch.range_scale, 1e-9) << N;
  }
}

TEST(OnlineSpectralMap, OfManyLandmarksIsExactWithoutNoiseAndCloseWithIt) {
  const Streamed exact(2, 30, 500, 0.0);
  EXPECT_LT(procrustes_gap(exact.landmarks, landmarks_of(exact.online.map().C)), 1e-6);
  const Streamed noisy(2, 30, 500, 0.1);
  const MetricUpgrade batch = metric_upgrade(factorize(noisy.Y, 4));
  const double batch_gap = procrustes_gap(noisy.landmarks, landmarks_of(batch.map.C));
  EXPECT_LT(procrustes_gap(noisy.landmarks, landmarks_of(noisy.online.map().C)), 1.2 * batch_gap);
}

TEST(OnlineSpectralMap, IsNoDifferentForHavingBeenAskedBefore) {
  const Streamed world(3, 6, 100, 0.1);
  OnlineSpectralMap asked(6);
  for (Eigen::Index t = 0; t < 100; ++t) {
    asked.add(world.Y.col(t));
    if (t > 20 && t % 7 == 0) asked.map();
  }
  EXPECT_EQ(asked.map().C, world.online.map().C);
}

TEST(OnlineSpectralMap, PlacesNewStepsOnTheMapSoFar) {
  const Streamed world(4, 6, 200, 0.0);
  Random random(5);
  const Points next = points_about(10, random);
  const SpectralMap map = world.online.map(world.first_four());
  const Points found =
      localise(landmarks_of(map.C), half_squared_ranges(ranges_between(world.landmarks, next)));
  EXPECT_LT((found - next).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(OnlineSpectralMap, OfFewStepsOrALineSaysSo) {
  EXPECT_TRUE(has(OnlineSpectralMap(5).map().statuses, StatusCode::kTooFewObservations));
  const Streamed few(6, 5, 3, 0.0);
  EXPECT_TRUE(has(few.online.map(few.first_four()).statuses, StatusCode::kTooFewObservations));
  Random random(7);
  Points line = points_about(80, random);
  line.col(1).setZero();
  const Eigen::MatrixXd Y = half_squared_ranges(ranges_between(points_about(5, random), line));
  OnlineSpectralMap online(5);
  for (Eigen::Index t = 0; t < 80; ++t) online.add(Y.col(t));
  EXPECT_TRUE(online.map().empty());
  EXPECT_FALSE(online.map().statuses.empty());
}

TEST(OnlineSpectralMap, RefusesColumnsThatDoNotFit) {
  EXPECT_THROW(OnlineSpectralMap(0), InvalidInput);
  OnlineSpectralMap online(4);
  EXPECT_THROW(online.add(Eigen::VectorXd::Ones(3)), InvalidInput);
  EXPECT_THROW(online.add(Eigen::VectorXd::Constant(4, HUGE_VAL)), InvalidInput);
}

}  // namespace
}  // namespace mapproof
