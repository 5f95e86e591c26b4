#include <map>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/experiment/run.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

using test::small_experiment;

TEST(SimulateRun, HoldsEverySensorMethodParameterAndStepInOrder) {
  const RunResult result = simulate_run(small_experiment(), {1, 2});
  std::size_t expected = 0;
  for (const SensorStudy& study : small_experiment().sensors)
    expected += settings_of(study).size() * study.checkpoints.size();
  EXPECT_EQ(result.run.records.size(), expected);
  EXPECT_EQ(result.maps.size(), expected);
  EXPECT_EQ(result.timings.size(), expected);
  EXPECT_EQ(result.maps.front().id, "layout-1-pose-2/visibility/lpca/100");
}

TEST(SimulateRun, SharesTheLayoutAmongPosesAndNothingElse) {
  const Experiment experiment = small_experiment();
  const RunResult a = simulate_run(experiment, {1, 1});
  const RunResult b = simulate_run(experiment, {1, 2});
  const RunResult c = simulate_run(experiment, {2, 1});
  EXPECT_EQ(a.run.world.landmarks_m, b.run.world.landmarks_m);
  EXPECT_NE(a.run.world.landmarks_m, c.run.world.landmarks_m);
  EXPECT_NE(a.maps.back().estimate, b.maps.back().estimate);
}

TEST(SimulateRun, GivesAMethodTheSameMapWhateverOtherMethodsRun) {
  Experiment alone = small_experiment();
  alone.sensors.erase(alone.sensors.begin());
  std::erase_if(alone.sensors[0].methods,
                [](const MethodGrid& grid) { return grid.method != Method::kIsomap; });
  const RunResult few = simulate_run(alone, {2, 2});
  const RunResult all = simulate_run(small_experiment(), {2, 2});
  std::map<std::string, Points> maps;
  for (const MapRecord& map : all.maps) maps[map.id] = map.estimate;
  ASSERT_FALSE(few.maps.empty());
  for (const MapRecord& map : few.maps) EXPECT_EQ(map.estimate, maps.at(map.id)) << map.id;
}

TEST(SimulateRun, RefusesASensorWithoutCheckpoints) {
  Experiment experiment = small_experiment();
  experiment.sensors.back().checkpoints.clear();
  EXPECT_THROW(simulate_run(experiment, {1, 1}), InvalidInput);
}

TEST(SimulateRun, ReportsLandmarksThatWereNeverSeen) {
  Experiment experiment = small_experiment();
  experiment.world.side_m = 6.0;
  for (SensorStudy& study : experiment.sensors) study.checkpoints = {5};
  const RunResult result = simulate_run(experiment, {1, 1});
  const RunRecord& record = result.run.records.front();
  EXPECT_FALSE(record.statuses.empty());
  EXPECT_FALSE(record.score);
}

Variation noise_variation() {
  return {.id = "noise",
          .sensor = Sensor::kBearing,
          .factor = Factor::kNoise,
          .levels = {0.0, 0.05, 0.6},
          .step = 200,
          .placement = std::nullopt,
          .settings = {{Method::kLpca, std::nullopt}, {Method::kIsomap, 6.0}}};
}

TEST(Variations, HoldEveryLevelAndSettingInOrder) {
  Experiment experiment = small_experiment();
  experiment.variations = {noise_variation()};
  const RunResult result = simulate_run(experiment, {1, 1});
  const std::vector<VariationRecord>& records = result.run.variations;
  ASSERT_EQ(records.size(), 6U);
  EXPECT_EQ(records[2].level, 0.05);
  EXPECT_EQ(records[3].setting, (MethodSetting{Method::kIsomap, 6.0}));
}

TEST(Variations, AgreeWithTheStudyWhereNothingVaries) {
  Experiment experiment = small_experiment();
  experiment.variations = {noise_variation()};
  const RunResult result = simulate_run(experiment, {2, 1});
  const auto same = [&](const VariationRecord& varied) {
    for (const RunRecord& record : result.run.records)
      if (record.sensor == Sensor::kBearing && record.step == 200 &&
          record.setting == varied.setting)
        return record.score->mpe_m == varied.score->mpe_m;
    return false;
  };
  EXPECT_TRUE(same(result.run.variations[0]));
  EXPECT_TRUE(same(result.run.variations[1]));
  EXPECT_FALSE(same(result.run.variations[2]));
}

TEST(Variations, DoNotDependOnWhatTheStudyMapped) {
  Experiment all = small_experiment();
  all.variations = {noise_variation()};
  Experiment few = all;
  for (SensorStudy& study : few.sensors)
    std::erase_if(study.methods,
                  [](const MethodGrid& grid) { return grid.method != Method::kSmacof; });
  const std::vector<VariationRecord> expected = simulate_run(few, {1, 1}).run.variations;
  const std::vector<VariationRecord> records = simulate_run(all, {1, 1}).run.variations;
  ASSERT_EQ(records.size(), expected.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    EXPECT_EQ(records[i].setting, expected[i].setting);
    EXPECT_EQ(records[i].score->mpe_m, expected[i].score->mpe_m) << i;
    EXPECT_EQ(records[i].score->moe_percent, expected[i].score->moe_percent) << i;
  }
}

TEST(Variations, OfNoiseMakeWorseMaps) {
  Experiment experiment = small_experiment();
  experiment.variations = {noise_variation()};
  double low = 0.0;
  double high = 0.0;
  for (const RunId& id : runs_of(experiment)) {
    const RunResult result = simulate_run(experiment, id);
    low += result.run.variations[0].score->moe_percent;
    high += result.run.variations[4].score->moe_percent;
  }
  EXPECT_LT(low, high);
}

TEST(Variations, OfAnchorsScoreOneEmbeddingOverOtherAnchors) {
  Experiment experiment = small_experiment();
  Variation variation = noise_variation();
  variation.factor = Factor::kAnchors;
  variation.levels = {4, 8};
  variation.placement = AnchorPlacement::kWalls;
  experiment.variations = {variation};
  const RunResult result = simulate_run(experiment, {1, 1});
  const std::vector<VariationRecord>& records = result.run.variations;
  ASSERT_EQ(records.size(), 4U);
  EXPECT_NE(records[0].score->mpe_m, records[2].score->mpe_m);
  EXPECT_EQ(records[0].score->moe_unmirrored_percent, records[2].score->moe_unmirrored_percent);
}

TEST(Variations, OfAMissingSensorAreRefused) {
  Experiment experiment = small_experiment();
  experiment.variations = {noise_variation()};
  experiment.variations[0].sensor = Sensor::kRange;
  EXPECT_THROW(simulate_run(experiment, {1, 1}), InvalidInput);
}

TEST(RunDetails, ShowAScanThatTheHistoryHolds) {
  const RunResult result = simulate_run(small_experiment(), {1, 1});
  ASSERT_EQ(result.details.sensors.size(), 2U);
  const SensorDetails& visibility = result.details.sensors[0];
  ASSERT_EQ(visibility.views.size(), 12U);
  for (std::size_t i = 0; i < visibility.views.size(); ++i)
    EXPECT_EQ(visibility.values(static_cast<Eigen::Index>(i)) == 1.0,
              visibility.views[i] == View::kVisible);
  EXPECT_EQ(visibility.first_steps.cols(), 60);
  EXPECT_EQ(visibility.distances.size(), 66);
  EXPECT_NEAR(visibility.reach_m, 0.55, 0.001);

  const Measurement scan = measurement(result.details, visibility, result.run.world);
  EXPECT_EQ(scan.path_m.rows(), visibility.scan_step);
  const SensorDetails& bearing = result.details.sensors[1];
  EXPECT_TRUE(bearing.views.empty());
  EXPECT_EQ(result.details.path.positions_m.rows(), 200);
  EXPECT_FALSE(bearing.spectra.empty());
}

TEST(RunDetails, CountHowOftenOneLandmarkHidAnother) {
  const RunResult result = simulate_run(small_experiment(), {1, 1});
  ASSERT_TRUE(result.run.occlusion);
  EXPECT_GT(result.run.occlusion->hidden, 0);
  EXPECT_LT(result.run.occlusion->hidden, result.run.occlusion->within_reach / 2);
  Experiment clear = small_experiment();
  clear.sensors[0].sensor.occlusion = false;
  EXPECT_FALSE(simulate_run(clear, {1, 1}).run.occlusion);
}

// The paper's protocol on 8 layouts x 2 poses: wide bounds around the bands of independent
// prototypes (40 layouts x 5 poses), so that a broken method fails and chance does not.
TEST(PaperProtocol, LandsNearThePublishedErrors) {
  Experiment experiment;
  experiment.seed = 20070620;
  experiment.affine_fit = AffineFit::kLeastSquares;
  SensorStudy visibility;
  visibility.checkpoints = {2000};
  visibility.methods = {{Method::kLpca, {}},
                        {Method::kSmacof, {}},
                        {Method::kSmacofKnn, {5}},
                        {Method::kIsomap, {6}}};
  SensorStudy bearing = visibility;
  bearing.sensor.sensor = Sensor::kBearing;
  bearing.methods[2].parameters = {8};
  bearing.methods[3].parameters = {9};
  experiment.sensors = {visibility, bearing};

  std::map<std::string, double> moe;
  for (int layout = 1; layout <= 8; ++layout)
    for (int pose = 1; pose <= 2; ++pose)
      for (const RunRecord& record : simulate_run(experiment, {layout, pose}).run.records)
        moe[std::string(name(record.sensor)) + "/" + slug(record.setting)] +=
            record.score->moe_percent / 16.0;

  EXPECT_NEAR(moe["visibility/lpca"], 19.0, 5.0);
  EXPECT_NEAR(moe["visibility/smacof"], 6.0, 2.5);
  EXPECT_NEAR(moe["visibility/smacof-knn-K5"], 4.5, 2.0);
  EXPECT_NEAR(moe["visibility/isomap-K6"], 4.7, 1.5);
  EXPECT_NEAR(moe["bearing/lpca"], 2.1, 0.4);
  EXPECT_NEAR(moe["bearing/smacof"], 1.3, 0.3);
  EXPECT_NEAR(moe["bearing/smacof-knn-K8"], 0.95, 0.25);
  EXPECT_NEAR(moe["bearing/isomap-K9"], 2.4, 0.9);
  EXPECT_LT(moe["visibility/smacof-knn-K5"], moe["visibility/smacof"]);
  EXPECT_LT(moe["bearing/smacof-knn-K8"], moe["bearing/smacof"]);
  EXPECT_LT(moe["bearing/smacof"], moe["bearing/lpca"]);
}

}  // namespace
}  // namespace mapproof
