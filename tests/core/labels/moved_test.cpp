#include "core/labels/moved.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/labels/place_shift.hpp"
#include "noisy_looks.hpp"
#include "tests/support/looks.hpp"

namespace mapproof::test {
namespace {

/// Looks in which one landmark stands elsewhere from a step on.
SightingLog looks_with_move(int looks, int landmark, const Eigen::RowVector2d& by_m, int from) {
  Points places = noisy_landmarks();
  SightingLog log = looks_at(places, looks, 5, 11);
  places.row(landmark) += by_m;
  const SightingLog later = looks_at(places, looks, 5, 11);
  std::erase_if(log.sightings, [&](const Sighting& one) { return one.step >= from; });
  for (const Sighting& one : later.sightings)
    if (one.step >= from) log.sightings.push_back(one);
  Random random(5);
  for (Sighting& one : log.sightings) {
    one.range_m *= 1.0 + 0.02 * random.normal();
    one.bearing_rad += 0.0175 * random.normal();
  }
  return log;
}

TEST(FindMoved, NamesTheLandmarkAndTheTime) {
  const SightingLog log = looks_with_move(800, 7, {0.3, -0.4}, 500);
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
  const MovedCheck check = find_moved(looks_with_move(800, 3, {-0.6, 0.2}, 300));
  ASSERT_EQ(check.split.names.size(), 16U);
  EXPECT_EQ(check.split.names.back(), check.split.names[3] + " (moved)");
  int early = 0;
  for (const Sighting& one : check.split.sightings)
    if (one.landmark == 15) early += one.step < 285 ? 1 : 0;
  EXPECT_EQ(early, 0);
}

TEST(FindMoved, NamesFewerThanItsLevelWhereNothingMoves) {
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    alarms +=
        find_moved(noisy_looks(300, seed), {.permutations = 399, .least_move = 0.0}).moved.empty()
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

TEST(ShiftTest, IsUniformWithoutAChange) {
  Random random(9);
  int below = 0;
  for (std::uint64_t k = 0; k < 200; ++k) {
    std::vector<ShiftSlice> slices(20);
    for (ShiftSlice& slice : slices) {
      slice.H.setIdentity();
      slice.g = {random.normal(), random.normal()};
    }
    below += shift_test(slices, {199, k}).p <= 0.2 ? 1 : 0;
  }
  EXPECT_NEAR(below, 40, 3 * std::sqrt(200 * 0.2 * 0.8));
}

TEST(ShiftTest, FindsWhereASecondPlaceBegins) {
  std::vector<ShiftSlice> slices(20);
  for (std::size_t k = 0; k < slices.size(); ++k) {
    slices[k].H.setIdentity();
    slices[k].g = k < 13 ? Eigen::Vector2d(0.0, 0.0) : Eigen::Vector2d(0.5, 0.1);
  }
  EXPECT_EQ(likeliest_change(slices), 13U);
  EXPECT_LE(shift_test(slices, {1999, 1}).p, 0.001);
}

}  // namespace
}  // namespace mapproof::test
