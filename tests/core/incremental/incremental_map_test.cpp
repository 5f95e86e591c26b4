#include "core/incremental/incremental_map.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/align/aligned_to.hpp"
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

/// Some entries not observed, in stretches, and the last landmark at first not at all.
ObservationHistory with_missing(ObservationHistory history, std::uint64_t seed) {
  Random random(seed);
  const Eigen::Index last = history.landmarks() - 1;
  for (Eigen::Index i = 0; i <= last; ++i) {
    bool is_gone = false;
    for (Eigen::Index t = 0; t < history.steps(); ++t) {
      if (random.uniform() < 0.1) is_gone = random.uniform() < 0.3;
      if (is_gone || (i == last && t < 40)) history.values(i, t) = NAN;
    }
  }
  return history;
}

class IncrementalBy : public ::testing::TestWithParam<MethodSetting> {};

void expect_maps_of_the_whole(const ObservationHistory& history, const MethodSetting& setting,
                              std::uint64_t seed) {
  IncrementalMap map(history.sensor, {.setting = setting, .embedder = {}});
  map.grow(history.landmarks());
  double greatest = 0.0;
  int compared = 0;
  for (Eigen::Index t = 0; t < history.steps(); ++t) {
    map.add(step_of(history, t));
    if (t % 10 != 9) continue;
    const Points update = map.update().embedding.coordinates;
    const Points whole = HistoryEmbedder(history, t + 1).embed(setting).coordinates;
    ASSERT_EQ(update.array().isNaN().count(), whole.array().isNaN().count()) << seed << ' ' << t;
    if (!whole.allFinite()) continue;
    greatest = std::max(greatest, relative_gap(update, whole));
    ++compared;
  }
  EXPECT_GE(compared, 20) << name(history.sensor) << ", seed " << seed;
  EXPECT_LT(greatest, kIncrementalWithin) << name(history.sensor) << ", seed " << seed;
}

// Visibility among them, whose stress has several minima: by weights of neighbours, too.
TEST_P(IncrementalBy, EveryUpdateIsTheMapOfTheWholeHistoryWithinTheStatedBound) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    for (const Sensor sensor : {Sensor::kBearing, Sensor::kVisibility, Sensor::kRange}) {
      const ObservationHistory history = walked(sensor, seed, 300);
      expect_maps_of_the_whole(history, GetParam(), seed);
      expect_maps_of_the_whole(with_missing(history, seed), GetParam(), seed);
    }
}

INSTANTIATE_TEST_SUITE_P(Incremental, IncrementalBy,
                         ::testing::Values(MethodSetting{Method::kLpca, std::nullopt},
                                           MethodSetting{Method::kSmacof, std::nullopt},
                                           MethodSetting{Method::kSmacofKnn, 6.0},
                                           MethodSetting{Method::kIsomap, 6.0},
                                           MethodSetting{Method::kKpcaGaussian, 0.5},
                                           MethodSetting{Method::kKpcaPolynomial, 2.0},
                                           MethodSetting{Method::kLaplacianEigenmap, 6.0},
                                           MethodSetting{Method::kLle, 8.0},
                                           MethodSetting{Method::kHessianLle, 8.0}),
                         [](const auto& tested) {
                           std::string word{mapproof::info(tested.param.method).name};
                           std::erase(word, '-');
                           return word;
                         });

TEST(IncrementalMap, HoldsLandmarksFromTheirFirstDetectionOn) {
  IncrementalMap map(Sensor::kBearing,
                     {.setting = {Method::kSmacof, std::nullopt}, .embedder = {}});
  map.grow(4);
  const ObservationHistory history = walked(Sensor::kBearing, 2, 60);
  for (Eigen::Index t = 0; t < 30; ++t) {
    auto step = step_of(history, t);
    step.resize(3);
    map.add(step);
  }
  IncrementalUpdate update = map.update();
  EXPECT_TRUE(update.embedding.coordinates.row(3).array().isNaN().all());
  EXPECT_TRUE(update.embedding.coordinates.topRows(3).allFinite());
  map.grow(5);
  for (Eigen::Index t = 30; t < 60; ++t) {
    auto step = step_of(history, t);
    step.resize(5);
    map.add(step);
  }
  update = map.update();
  ObservationHistory listed = with_rows(history, {0, 1, 2, 3, 4});
  listed.values.bottomLeftCorner(2, 30).setConstant(NAN);
  HistoryEmbedder whole(listed, 60);
  EXPECT_LT(relative_gap(update.embedding.coordinates,
                         whole.embed({Method::kSmacof, std::nullopt}).coordinates),
            kIncrementalWithin);
}

TEST(IncrementalMap, FailsWithoutObservations) {
  IncrementalMap map(Sensor::kRange, {.setting = {Method::kIsomap, std::nullopt}, .embedder = {}});
  EXPECT_EQ(map.update().embedding.statuses[0].code, StatusCode::kFailed);
  map.grow(2);
  map.add({});
  const IncrementalUpdate update = map.update();
  ASSERT_EQ(update.embedding.coordinates.rows(), 2);
  EXPECT_TRUE(update.embedding.coordinates.array().isNaN().all());
  ASSERT_FALSE(update.embedding.statuses.empty());
  EXPECT_EQ(update.embedding.statuses[0].code, StatusCode::kFailed);
}

}  // namespace
}  // namespace mapproof
