#include "core/follow/followed_map.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/align/laid_on.hpp"
#include "core/base/random.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"

namespace mapproof {
namespace {

ObservationHistory walked(Sensor sensor, std::uint64_t seed, int steps) {
  Random random(seed);
  const World world = scatter_landmarks({.side_m = 1.8, .landmarks = 25}, random);
  const Path path = random_walk(world, {}, steps, random);
  return observe(world, path, {.sensor = sensor}, random);
}

std::vector<StepEntry> step_of(const ObservationHistory& history, Eigen::Index t) {
  std::vector<StepEntry> step;
  for (Eigen::Index i = 0; i < history.landmarks(); ++i)
    if (!std::isnan(history.values(i, t))) step.push_back({i, history.values(i, t)});
  return step;
}

class FollowedBy : public ::testing::TestWithParam<MethodSetting> {};

TEST_P(FollowedBy, EveryUpdateIsTheMapOfTheWholeHistory) {
  for (const Sensor sensor : {Sensor::kBearing, Sensor::kVisibility}) {
    const ObservationHistory history = walked(sensor, 3, 400);
    FollowedMap map(sensor, {.setting = GetParam(), .embedder = {}, .whole_every = 50});
    map.grow(history.landmarks());
    for (Eigen::Index t = 0; t < history.steps(); ++t) {
      map.add(step_of(history, t));
      if (t % 20 != 19 || t < 100) continue;
      HistoryEmbedder whole(history, t + 1);
      const FollowedUpdate update = map.update();
      EXPECT_LT(relative_gap(update.embedding.coordinates, whole.embed(GetParam()).coordinates),
                update.whole ? 1e-6 : kFollowedWithin)
          << t;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Follow, FollowedBy,
                         ::testing::Values(MethodSetting{Method::kLpca, std::nullopt},
                                           MethodSetting{Method::kSmacof, std::nullopt},
                                           MethodSetting{Method::kIsomap, 6.0}),
                         [](const auto& info) {
                           return std::string(mapproof::info(info.param.method).name);
                         });

TEST(FollowedMap, GoesOnFromItsLastMapInFewerIterations) {
  const ObservationHistory history = walked(Sensor::kBearing, 5, 600);
  FollowedMap map(Sensor::kBearing,
                  {.setting = {Method::kSmacof, std::nullopt}, .embedder = {}, .whole_every = 4});
  map.grow(history.landmarks());
  int warm = 0, whole = 0, warm_iterations = 0, whole_iterations = 0;
  for (Eigen::Index t = 0; t < history.steps(); ++t) {
    map.add(step_of(history, t));
    if (t % 20 != 19 || t < 200) continue;
    const FollowedUpdate update = map.update();
    (update.whole ? whole : warm) += 1;
    (update.whole ? whole_iterations : warm_iterations) += update.embedding.iterations;
    if (update.gap) {
      EXPECT_LT(*update.gap, kFollowedWithin);
    }
  }
  EXPECT_EQ(whole, 7);  // Updates 0, 1, 3, 7, 11, 15 and 19.
  EXPECT_EQ(warm, 13);
  EXPECT_LT(warm_iterations * whole, whole_iterations * warm);
}

TEST(FollowedMap, HoldsLandmarksFromWhenTheyAreSeen) {
  FollowedMap map(Sensor::kBearing, {.setting = {Method::kSmacof, std::nullopt}, .embedder = {}});
  map.grow(4);
  const ObservationHistory history = walked(Sensor::kBearing, 2, 60);
  for (Eigen::Index t = 0; t < 30; ++t) {
    auto step = step_of(history, t);
    step.resize(3);
    map.add(step);
  }
  FollowedUpdate update = map.update();
  EXPECT_TRUE(update.embedding.coordinates.row(3).array().isNaN().all());
  EXPECT_TRUE(update.embedding.coordinates.topRows(3).allFinite());
  map.grow(5);
  for (Eigen::Index t = 30; t < 60; ++t) {
    auto step = step_of(history, t);
    step.resize(5);
    map.add(step);
  }
  update = map.update();
  EXPECT_TRUE(update.whole);
  EXPECT_TRUE(update.embedding.coordinates.allFinite());
}

TEST(FollowedMap, SaysThatNothingCameOfNothing) {
  FollowedMap map(Sensor::kRange, {.setting = {Method::kIsomap, std::nullopt}, .embedder = {}});
  EXPECT_EQ(map.update().embedding.statuses[0].code, StatusCode::kFailed);
  map.grow(2);
  map.add({});
  EXPECT_EQ(map.update().embedding.coordinates.rows(), 2);
}

}  // namespace
}  // namespace mapproof
