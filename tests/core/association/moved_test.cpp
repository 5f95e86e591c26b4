#include "core/association/moved.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "tests/support/samples/drawn_points.hpp"
#include "noisy_scans.hpp"
#include "tests/support/samples/scans.hpp"

namespace mapproof::test {
namespace {

TEST(FindMoved, FindsTheLandmarkAndTheTime) {
  const DetectionLog log = scans_with_move(800, 7, {0.3, -0.4}, 500);
  const MovedCheck check = find_moved(log);
  ASSERT_EQ(check.moved.size(), 1U);
  EXPECT_EQ(check.moved.front().landmark, 7);
  EXPECT_NEAR(check.moved.front().step, 500, 15);
  EXPECT_LE(check.moved.front().earliest_step, 500);
  EXPECT_GE(check.moved.front().latest_step, 495);
  EXPECT_NEAR(check.moved.front().distance_m, 0.5, 0.05);
  EXPECT_LT(check.loss_after_m, check.loss_before_m);
}

TEST(FindMoved, SplitsTheLogAtTheMove) {
  const MovedCheck check = find_moved(scans_with_move(800, 3, {-0.6, 0.2}, 300));
  ASSERT_EQ(check.split.names.size(), 16U);
  EXPECT_EQ(check.split.names.back(), check.split.names[3] + " (moved)");
  int early = 0;
  for (const Detection& one : check.split.detections)
    if (one.landmark == 15) early += one.step < 285 ? 1 : 0;
  EXPECT_EQ(early, 0);
}

TEST(FindMoved, ReportsFewerThanItsLevelWhereNothingMoves) {
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    alarms +=
        find_moved(noisy_scans(300, seed), {.permutations = 399, .least_move = 0.0}).moved.empty()
            ? 0
            : 1;
  // 5 % of 20 is one; five or more come by chance in 3 of 1000.
  EXPECT_LT(alarms, 5);
}

TEST(FindMoved, RefusesOptionsOutOfBounds) {
  EXPECT_THROW(find_moved({}, {.level = 0.0}), InvalidInput);
  EXPECT_THROW(find_moved({}, {.permutations = 3}), InvalidInput);
  EXPECT_THROW(find_moved({}, {.slices = 2}), InvalidInput);
  EXPECT_TRUE(find_moved({}).moved.empty());
}

/// Slices whose errors follow x' = rho x + normal noise, for several landmarks that stand still.
std::vector<PositionChange> hanging_slices(double rho, Random& random) {
  std::vector<PositionChange> landmarks(9);
  for (PositionChange& change : landmarks) {
    Eigen::Vector2d x = normal_point(random).transpose();
    x /= std::sqrt(1.0 - rho * rho);
    for (int k = 0; k < 30; ++k) {
      change.asked.push_back({Eigen::Matrix2d::Identity(), x});
      x = rho * x + normal_point(random).transpose();
    }
    change.residual = change.asked;
  }
  return landmarks;
}

TEST(BestGain, IsThatOfTwoMeans) {
  // Asked for at 0 by three slices and at 3 by two: one position costs 3 * 2 / 5 * 9 / 2 more.
  std::vector<ShiftSlice> slices(5, {Eigen::Matrix2d::Identity(), {0.0, 0.0}});
  slices[3].g.x() = slices[4].g.x() = 3.0;
  EXPECT_NEAR(best_gain(slices), 5.4, 1e-6);
}

TEST(ChanceOf, IsUniformWithoutAMove) {
  Random random(9);
  int below = 0;
  for (std::uint64_t k = 0; k < 40; ++k)
    for (const PositionChange& change : hanging_slices(0.0, random))
      below += chance_of(change, {199, k}) <= 0.2 ? 1 : 0;
  EXPECT_NEAR(below, 72, 3 * std::sqrt(360 * 0.2 * 0.8));
}

TEST(ChanceOf, IsSmallForAFarMoveWhateverTheInflation) {
  Random random(10);
  PositionChange change = hanging_slices(0.0, random)[0];
  for (std::size_t k = 13; k < 30; ++k) change.asked[k].g.x() += 100.0;
  EXPECT_DOUBLE_EQ(chance_of(change, {1999, 1, 4.0}), 1.0 / 2000.0);
}

TEST(Inflation, GrowsWithCorrelatedErrors) {
  double before = 0.0;
  for (const double rho : {0.0, 0.3, 0.6}) {
    Random random(17);
    double mean = 0.0;
    for (std::uint64_t k = 0; k < 50; ++k) mean += inflation(hanging_slices(rho, random), k) / 50.0;
    EXPECT_GT(mean, before + 0.1);
    // Sums of correlated errors vary by (1 + rho) / (1 - rho) of what independent ones do.
    EXPECT_LT(mean, 1.3 * (1.0 + rho) / (1.0 - rho));
    before = mean;
  }
}

TEST(Inflation, IsNotThatOfOneLandmarkThatMoved) {
  Random random(18);
  std::vector<PositionChange> landmarks = hanging_slices(0.0, random);
  const double still = inflation(landmarks, 1);
  for (std::size_t k = 15; k < 30; ++k) landmarks[4].asked[k].g.x() += 100.0;
  EXPECT_LT(inflation(landmarks, 1), 1.3 * still);
}

}  // namespace
}  // namespace mapproof::test
