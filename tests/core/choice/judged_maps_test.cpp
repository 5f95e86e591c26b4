#include "core/choice/judged_maps.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"

namespace mapproof {
namespace {

struct Walked {
  World world;
  ObservationHistory history;
};

Walked walked(Sensor sensor, double dropout_share = 0.0) {
  Random random(4);
  Walked made;
  made.world = scatter_landmarks({.side_m = 1.5, .landmarks = 20}, random);
  const Path path = random_walk(made.world, {}, 600, random);
  made.history =
      observe(made.world, path, {.sensor = sensor, .dropout_share = dropout_share}, random);
  return made;
}

std::vector<MethodSetting> some_settings() {
  return {{Method::kLpca, std::nullopt},
          {Method::kSmacof, std::nullopt},
          {Method::kIsomap, 5.0},
          {Method::kHessianLle, 4.0}};
}

TEST(MapJudge, HasEveryCriterionForSuccessfulMapsAndNoneForOthers) {
  const Walked made = walked(Sensor::kBearing);
  const MapJudge judge(made.history, 600,
                       {.settings = some_settings(), .embedder = {}, .replicates = 3});
  const auto maps = judge.in({made.world.landmarks_m, {0, 6, 12, 19}});
  ASSERT_EQ(maps.size(), 4U);
  EXPECT_FALSE(maps[3].mapped);  // Hessian LLE needs 6 neighbours.
  for (const JudgedMap& map : maps)
    for (const double value : map.values) EXPECT_EQ(std::isnan(value), !map.mapped);
  EXPECT_EQ(ranked(maps, Criterion::kCombined).size(), 3U);
}

TEST(MapJudge, HasNoAnchorCriterionWithoutAnchors) {
  const Walked made = walked(Sensor::kVisibility);
  const MapJudge judge(made.history, 600,
                       {.settings = some_settings(), .embedder = {}, .replicates = 0});
  const auto maps = judge.in({Points::Zero(20, 2), {}});
  EXPECT_TRUE(std::isnan(value_of(maps[0].values, Criterion::kAnchors)));
  EXPECT_TRUE(std::isnan(value_of(maps[0].values, Criterion::kStability)));
  EXPECT_FALSE(std::isnan(value_of(maps[0].values, Criterion::kCombined)));
}

TEST(MapJudge, IsNotMovedByTheOrderOfTheSettings) {
  const Walked made = walked(Sensor::kBearing, 0.2);
  auto settings = some_settings();
  const auto maps =
      MapJudge(made.history, 600, {.settings = settings, .embedder = {}, .replicates = 2})
          .in({made.world.landmarks_m, {0, 6, 12, 19}});
  std::ranges::reverse(settings);
  const auto turned =
      MapJudge(made.history, 600, {.settings = settings, .embedder = {}, .replicates = 2})
          .in({made.world.landmarks_m, {0, 6, 12, 19}});
  for (std::size_t m = 0; m < maps.size(); ++m)
    for (const CriterionInfo& criterion : all_criteria()) {
      if (criterion.criterion == Criterion::kCombined) continue;  // Ties go by the order.
      const double a = value_of(maps[m].values, criterion.criterion);
      const double b = value_of(turned[maps.size() - 1 - m].values, criterion.criterion);
      EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << criterion.name;
    }
}

TEST(MapJudge, AcceptsTooFewOrUnseenLandmarks) {
  ObservationHistory nothing{Sensor::kBearing, {"a", "b", "c", "d"}, {}};
  nothing.values.setConstant(4, 30, NAN);
  const ChoiceOptions options{.settings = some_settings(), .embedder = {}, .replicates = 2};
  for (const JudgedMap& map : MapJudge(nothing, 30, options).in({Points::Zero(4, 2), {}}))
    EXPECT_FALSE(map.mapped);
}

TEST(UsualCandidates, FitTheLandmarksThereAre) {
  for (const int landmarks : {5, 8, 20}) {
    Random random(1);
    const World world = scatter_landmarks({.side_m = 1.5, .landmarks = landmarks}, random);
    const Path path = random_walk(world, {}, 100, random);
    const ObservationHistory history = observe(world, path, {.sensor = Sensor::kBearing}, random);
    for (const MethodSetting& setting : usual_candidates(HistoryEmbedder(history, 100), landmarks))
      if (on_graph(setting.method)) {
        EXPECT_LT(*setting.parameter, landmarks);
      }
  }
}

TEST(Ranked, PutsTheBestFirstInEitherDirectionOfACriterion) {
  std::vector<JudgedMap> maps(3);
  for (std::size_t m = 0; m < 3; ++m) {
    maps[m].mapped = true;
    value_of(maps[m].values, Criterion::kStress) = 3.0 - double(m);
    value_of(maps[m].values, Criterion::kContinuity) = 3.0 - double(m);
  }
  value_of(maps[2].values, Criterion::kContinuity) = NAN;
  EXPECT_EQ(ranked(maps, Criterion::kStress), (std::vector<std::size_t>{2, 1, 0}));
  EXPECT_EQ(ranked(maps, Criterion::kContinuity), (std::vector<std::size_t>{0, 1, 2}));
}

}  // namespace
}  // namespace mapproof
