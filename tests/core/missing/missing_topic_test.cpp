#include <cmath>

#include <gtest/gtest.h>

#include "core/trials/missing.hpp"
#include "tests/support/gappy.hpp"

namespace mapproof {
namespace {

TrialExperiment small_trials() {
  TrialExperiment experiment;
  experiment.topic = kMissingTopic.name;
  experiment.steps = 400;
  for (const TrialOption& option : kMissingTopic.options)
    experiment.options[std::string(option.name)] = option.usual;
  experiment.options["shares_at_random"] = {0.0, 0.5};
  experiment.options["shares_sensor_range"] = {0.7};
  experiment.options["shares_occlusion"] = {0.3};
  experiment.options["dimensions"] = {5};
  return experiment;
}

TEST(MissingTopic, TriesEverySeriesAndConcludesWithNumbers) {
  const TrialExperiment experiment = small_trials();
  const test::WalkedRoom room = test::walked_room(1, 400, 25);
  TrialStudy study;
  study.experiment = experiment;
  study.design = kMissingTopic.design(experiment);
  const TrialContext context{.experiment = experiment,
                             .part = "layout-1-pose-1",
                             .run = {1, 1},
                             .world = &room.world,
                             .path = &room.path,
                             .anchors = room.anchors,
                             .seed = 3,
                             .data = {},
                             .with_maps = true};
  study.parts.push_back(kMissingTopic.make(context));
  const TrialPart& part = study.parts.front();
  // Covisible pairs are not tried at the two levels of gaps at random.
  EXPECT_EQ(part.trials.size(), 4 * study.design.series.size() - 2);
  for (const Trial& trial : part.trials) {
    EXPECT_EQ(trial.values.size(), study.design.quantities.size());
    EXPECT_TRUE(std::isfinite(trial.values.back())) << trial.series;
  }
  EXPECT_EQ(part.maps.size(), 6U);
  EXPECT_EQ(part.trials.front().values,
            kMissingTopic.make(context).trials.front().values);  // nothing but its arguments counts
  const std::vector<std::string> sentences = kMissingTopic.conclude(study);
  ASSERT_FALSE(sentences.empty());
  EXPECT_NE(sentences.front().find(" m"), std::string::npos);
}

}  // namespace
}  // namespace mapproof
