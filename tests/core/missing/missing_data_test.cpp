#include "core/simulate/missing_entries.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/simulate/sensors.hpp"
#include "tests/support/samples/incomplete.hpp"

namespace mapproof {
namespace {

ObservationHistory bearings_of(const test::WalkedRoom& room) {
  Random random(1);
  return observe(room.world, room.path, {.sensor = Sensor::kBearing}, random);
}

TEST(MissingEntries, RemoveTheRequestedShareAndLeaveTheRest) {
  const test::WalkedRoom room = test::walked_room(1, 60, 20);
  const ObservationHistory history = bearings_of(room);
  Random random(2);
  const Losses losses = random_losses(20, 60, random);
  for (const double share : {0.0, 0.25, 0.7}) {
    const ObservationHistory incomplete = with_missing(history, losses, share);
    const auto missing = incomplete.values.array().isNaN();
    EXPECT_EQ(missing.count(), std::lround(share * 1200));
    EXPECT_TRUE((missing || incomplete.values.array() == history.values.array()).all());
  }
}

TEST(MissingEntries, OfLimitedRangeAreTheMostDistantEntries) {
  const test::WalkedRoom room = test::walked_room(2, 60, 20);
  const Losses distances = range_losses(room.world, room.path);
  const ObservationHistory incomplete = with_missing(bearings_of(room), distances, 0.4);
  double nearest_lost = HUGE_VAL;
  double furthest_kept = 0.0;
  for (Eigen::Index k = 0; k < distances.size(); ++k) {
    double& bound = std::isnan(incomplete.values.reshaped()(k)) ? nearest_lost : furthest_kept;
    bound = std::isnan(incomplete.values.reshaped()(k)) ? std::min(bound, distances.reshaped()(k))
                                                        : std::max(bound, distances.reshaped()(k));
  }
  EXPECT_LE(furthest_kept, nearest_lost);
}

TEST(MissingEntries, OfOcclusionAreThoseThatTheVisibilitySensorFindsHidden) {
  const test::WalkedRoom room = test::walked_room(3, 40, 30);
  const Losses losses = occlusion_losses(room.world, room.path);
  const double radius = room.world.landmark_diameter_m / 2.0;
  const SensorOptions far_sighted{.sensor = Sensor::kVisibility, .visual_angle_rad = 1e-4};
  int hidden = 0;
  for (Eigen::Index t = 0; t < 40; ++t) {
    const std::vector<View> views =
        views_from(room.world, room.path.positions_m.row(t), far_sighted);
    for (Eigen::Index i = 0; i < 30; ++i) {
      const bool is_hidden = views[static_cast<std::size_t>(i)] == View::kHidden;
      EXPECT_EQ(losses(i, t) > -radius, is_hidden);
      hidden += is_hidden ? 1 : 0;
    }
  }
  EXPECT_GT(hidden, 50);
}

TEST(MissingEntries, RefuseSharesAndSizesThatCannotBe) {
  const test::WalkedRoom room = test::walked_room(1, 20, 10);
  const ObservationHistory history = bearings_of(room);
  const Losses losses = range_losses(room.world, room.path);
  for (const double share : {-0.1, 1.0, std::nan("")})
    EXPECT_THROW(with_missing(history, losses, share), InvalidInput);
  EXPECT_THROW(with_missing(history, losses.leftCols(5), 0.1), InvalidInput);
}

}  // namespace
}  // namespace mapproof
