#include <map>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/experiment/run.hpp"
#include "tests/support/worlds.hpp"

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

TEST(SimulateRun, GivesAMethodTheSameMapWhateverStandsBesideIt) {
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
