#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/world.hpp"
#include "core/trials/topics.hpp"
#include "reports/sections/trials/topic_text.hpp"

namespace mapproof {
namespace {

TEST(IncrementalTopic, MapsEverySensorIncrementallyToEveryLevel) {
  TrialExperiment experiment;
  experiment.topic = "incremental";
  experiment.steps = 300;
  experiment.world.landmarks = 16;
  experiment.world.side_m = 1.4;
  experiment.options = {{"observations", {100, 300}}, {"every", {50}}};
  Random random(9);
  const World world = scatter_landmarks(experiment.world, random);
  const Path path = random_walk(world, experiment.walk, experiment.steps, random);
  TrialStudy study;
  study.experiment = experiment;
  study.design = kIncrementalTopic.design(experiment);
  study.parts = {kIncrementalTopic.make({.experiment = experiment,
                                         .part = "layout-1-pose-1",
                                         .run = {},
                                         .world = &world,
                                         .path = &path,
                                         .anchors = {0, 5, 10, 15},
                                         .seed = 5,
                                         .data = {},
                                         .with_maps = true})};
  // Three sensors, three methods, two levels, incremental and from scratch.
  ASSERT_EQ(study.parts[0].trials.size(), 36U);
  for (const Trial& trial : study.parts[0].trials) {
    EXPECT_GE(trial.values.at("greatest_gap_ppm"), trial.values.at("gap_ppm"));
    EXPECT_LE(trial.values.at("greatest_gap_ppm"), 1.0) << trial.at.setup << ' ' << trial.series;
    EXPECT_EQ(trial.values.at("beyond_percent"), 0.0);
    const double steps = std::get<double>(trial.at.levels.at(0).value);
    EXPECT_EQ(trial.values.at("steps_gone_through"),
              trial.series.ends_with("-whole") ? steps : 50.0);
  }
  EXPECT_EQ(study.design.series[4].id, "isomap-K6");
  EXPECT_EQ(study.design.series[5].id, "isomap-K6-whole");
  EXPECT_EQ(conclusions_of(study).size(), 3U);
}

}  // namespace
}  // namespace mapproof
