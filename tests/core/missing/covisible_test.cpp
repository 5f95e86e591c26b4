#include "core/missing/covisible.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/experiment/scored_map.hpp"
#include "core/simulate/missing_entries.hpp"
#include "core/simulate/sensors.hpp"
#include "tests/support/samples/incomplete.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

ObservationHistory near_bearings(const test::WalkedRoom& room, double share) {
  Random random(5);
  return with_missing(observe(room.world, room.path, {.sensor = Sensor::kBearing}, random),
                      range_losses(room.world, room.path), share);
}

TEST(Covisible, PairsAreNearOnes) {
  const test::WalkedRoom room = test::walked_room(1, 1000);
  const Proximities pairs = covisible_proximities(near_bearings(room, 0.8), 1000, {});
  const Eigen::MatrixXd distances = test::distances_of(room.world.landmarks_m);
  double of_pairs = 0.0;
  int count = 0;
  for (Eigen::Index i = 0; i < 50; ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      if (std::isfinite(pairs.squared_distances(i, j))) {
        of_pairs += distances(i, j);
        ++count;
      }
  EXPECT_GE(count, 200);  // K = 8 of 50 landmarks
  EXPECT_LT(of_pairs / count, 0.5 * distances.sum() / (50.0 * 49.0));
}

TEST(Covisible, PairsMakeAMapOfASensorThatSeesNoFurtherThanAQuarterOfTheRoom) {
  double moe = 0.0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const test::WalkedRoom room = test::walked_room(seed, 2000);
    const Embedding map =
        relative_stress_map(covisible_proximities(near_bearings(room, 0.89), 2000, {}));
    moe += scored_map(map, room.world.landmarks_m, room.anchors, AffineFit::kLeastSquares)
               .score.value()
               .moe_unmirrored_percent;
  }
  EXPECT_LT(moe / 3.0, 3.0);
}

TEST(Covisible, RelativeStressOfACompleteGraphFindsThePointsAgain) {
  const Points points = test::scattered(20, 3);
  Proximities data;
  data.squared_distances = test::distances_of(points).cwiseAbs2();
  data.inner_products = Eigen::MatrixXd::Zero(20, 20);
  EXPECT_LT(test::procrustes_gap(points, relative_stress_map(data).coordinates), 1e-6);
}

TEST(Covisible, FailsWhereThePairsDoNotConnect) {
  Proximities data;
  data.squared_distances = Eigen::MatrixXd::Constant(6, 6, HUGE_VAL);
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j < 6; ++j)
      if (i / 3 == j / 3) data.squared_distances(i, j) = i == j ? 0.0 : 1.0;
  const Embedding map = relative_stress_map(data);
  EXPECT_TRUE(map.coordinates.array().isNaN().all());
  ASSERT_EQ(map.statuses.size(), 1U);
  EXPECT_EQ(map.statuses.front().code, StatusCode::kFailed);
}

TEST(Covisible, RefusesVisibilityAndPairsOfNothing) {
  const test::WalkedRoom room = test::walked_room(1, 20, 10);
  ObservationHistory history = near_bearings(room, 0.5);
  EXPECT_THROW(covisible_proximities(history, 20, {.neighbours = 0}), InvalidInput);
  EXPECT_THROW(covisible_proximities(history, 20, {.least_common = 0}), InvalidInput);
  history.sensor = Sensor::kVisibility;
  EXPECT_THROW(covisible_proximities(history, 20, {}), InvalidInput);
}

}  // namespace
}  // namespace mapproof
