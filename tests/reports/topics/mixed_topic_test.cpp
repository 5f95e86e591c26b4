#include <cmath>

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/world.hpp"
#include "core/topics/topics.hpp"
#include "reports/sections/topics/topic_text.hpp"

namespace mapproof {
namespace {

TEST(MixedTopic, MapsEverySensorAndEveryMixAtEveryLevel) {
  TopicExperiment experiment;
  experiment.topic = "mixed";
  experiment.steps = 1000;
  experiment.world.landmarks = 25;
  experiment.world.side_m = 1.7;
  experiment.options = {{"bearing_noise_deg", {0, 20}},
                        {"visibility_errors_percent", {0, 5}},
                        {"usual_bearing_noise_deg", {20}},
                        {"range_noise_m", {0.1}}};
  Random random(9);
  const World world = scatter_landmarks(experiment.world, random);
  const Path path = random_walk(world, experiment.walk, experiment.steps, random);
  TopicStudy study;
  study.experiment = experiment;
  study.design = kMixedTopic.design(experiment);
  study.parts = {kMixedTopic.make({.experiment = experiment,
                                   .part = "layout-1-pose-1",
                                   .run = {},
                                   .world = &world,
                                   .path = &path,
                                   .anchors = {0, 8, 16, 24},
                                   .seed = 5,
                                   .data = {},
                                   .with_maps = true})};
  // 2 sensors with two methods and 3 mixes at 4 levels, 3 sensors with two methods and 3 mixes at
  // 2.
  ASSERT_EQ(study.parts[0].outcomes.size(), 46U);
  for (const TopicOutcome& outcome : study.parts[0].outcomes)
    EXPECT_GT(outcome.values.at("mpe_m"), 0.0);
  const std::vector<std::string> sentences = conclusions_of(study);
  // Of each setup the gain of mixing, then the cost of choosing by the neighbourhoods.
  ASSERT_EQ(sentences.size(), 6U);
  for (const char* part :
       {"at noise of bearings 0\u00B0, ", "at noise of bearings 20\u00B0, ", "in one layout"})
    EXPECT_NE(sentences[0].find(part), std::string::npos) << sentences[0];
  EXPECT_NE(sentences[3].find("keeps most neighbourhoods"), std::string::npos);
}

}  // namespace
}  // namespace mapproof
