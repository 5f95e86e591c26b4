#include "core/mixed/mixed_map.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/choice/mixed_quality.hpp"
#include "core/simulate/sensors.hpp"
#include "tests/support/samples/incomplete.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

/// Ranges without noise and bearings of 40 degrees of it, of one walk.
struct TwoSensors {
  test::WalkedRoom room = test::walked_room(4, 600, 25);
  std::vector<ObservationHistory> histories;

  TwoSensors() {
    Random random(5);
    histories.push_back(
        observe(room.world, room.path,
                {.sensor = Sensor::kBearing, .noise = 40.0 * std::numbers::pi / 180}, random));
    histories.push_back(observe(room.world, room.path, {.sensor = Sensor::kRange}, random));
  }
};

TEST(MixedMap, IsThatOfTheSensorWithoutNoiseWhateverTheMethodThatItBeginsFrom) {
  const TwoSensors seen;
  for (const MethodSetting& setting :
       {MethodSetting{Method::kIsomap, 6.0}, MethodSetting{Method::kSmacofKnn, 6.0}}) {
    const MixedMap map = mixed_map(seen.histories, 0, setting);
    const double size = std::sqrt(seen.room.world.landmarks_m.cwiseAbs2().sum() / 25.0);
    EXPECT_LT(test::affine_gap(seen.room.world.landmarks_m, map.joint.coordinates), 0.05 * size);
    EXPECT_GT(map.sensors[1].reliability, map.sensors[0].reliability);
    EXPECT_GT(map.sensors[1].share, map.sensors[0].share);
    EXPECT_NEAR(map.sensors[0].weight + map.sensors[1].weight, 1.0, 1e-12);
  }
}

TEST(MixedMap, DoesNotDependOnTheOrderOfTheSensors) {
  const TwoSensors seen;
  const MethodSetting setting{Method::kSmacofKnn, 6.0};
  const Points once = mixed_map(seen.histories, 0, setting).joint.coordinates;
  const Points again =
      mixed_map({seen.histories[1], seen.histories[0]}, 0, setting).joint.coordinates;
  EXPECT_LT(test::procrustes_gap(once, again), 1e-6);
}

TEST(MixedMap, MapsALandmarkThatOneSensorAloneKnows) {
  TwoSensors seen;
  seen.histories[1].values.row(7).setConstant(std::nan(""));
  const MixedMap map = mixed_map(seen.histories, 0, {Method::kSmacofKnn, 6.0});
  EXPECT_TRUE(map.joint.coordinates.allFinite());
  EXPECT_TRUE(map.sensors[1].own.coordinates.row(7).array().isNaN().all());
  EXPECT_FALSE(std::isfinite(map.sensors[1].distances(7, 3)));
}

TEST(MixedMap, LeavesOutAndReportsWhatNoSensorSaw) {
  TwoSensors seen;
  for (ObservationHistory& history : seen.histories)
    history.values.row(2).setConstant(std::nan(""));
  const MixedMap map = mixed_map(seen.histories, 300, {Method::kIsomap, std::nullopt});
  EXPECT_TRUE(map.joint.coordinates.row(2).array().isNaN().all());
  EXPECT_EQ(map.joint.coordinates.array().isFinite().count(), 48);
  EXPECT_EQ(map.joint.statuses.back().code, StatusCode::kLandmarkUnseen);
}

TEST(MixedMap, FailsAsDataWhereNothingWasSeen) {
  TwoSensors seen;
  for (ObservationHistory& history : seen.histories) history.values.setConstant(std::nan(""));
  const MixedMap map = mixed_map(seen.histories, 0, {Method::kIsomap, std::nullopt});
  EXPECT_TRUE(map.joint.coordinates.array().isNaN().all());
  EXPECT_EQ(map.joint.statuses.front().code, StatusCode::kFailed);
}

TEST(MixedMap, RefusesASensorTwiceAndOtherLandmarks) {
  TwoSensors seen;
  const MethodSetting setting{Method::kIsomap, 6.0};
  EXPECT_THROW(mixed_map({seen.histories[0], seen.histories[0]}, 0, setting), InvalidInput);
  EXPECT_THROW(mixed_map(seen.histories, 601, setting), InvalidInput);
  EXPECT_THROW(mixed_map({}, 0, setting), InvalidInput);
  seen.histories[1].names[3] = "another";
  EXPECT_THROW(mixed_map(seen.histories, 0, setting), InvalidInput);
}

TEST(OrderMisfit, IsLeastForTheMapWhoseDistancesTheSensorsBend) {
  const Points ground_truth = test::scattered(25, 6);
  const Eigen::MatrixXd D = test::distances_of(ground_truth);
  const std::vector<Eigen::MatrixXd> bent = {D.cwiseSqrt(), D.array().square()};
  EXPECT_NEAR(order_misfit(bent, ground_truth), 0.5 * std::log(1e-4), 1e-9);
  EXPECT_GT(order_misfit(bent, test::scattered(25, 7)), 0.5 * std::log(1e-2));
}

TEST(MixedContinuity, IsTheWeightedMeanOfTheSensors) {
  const Points map = test::scattered(25, 6);
  const Eigen::MatrixXd right = test::distances_of(map);
  const Eigen::MatrixXd other = test::distances_of(test::scattered(25, 8));
  EXPECT_EQ(mixed_continuity({right}, {1.0}, map), 1.0);
  const double alone = mixed_continuity({other}, {1.0}, map);
  EXPECT_LT(alone, 0.9);
  EXPECT_NEAR(mixed_continuity({right, other}, {0.25, 0.75}, map), 0.25 + 0.75 * alone, 1e-12);
  EXPECT_TRUE(std::isnan(mixed_continuity({right}, {0.0}, map)));
}

}  // namespace
}  // namespace mapproof
