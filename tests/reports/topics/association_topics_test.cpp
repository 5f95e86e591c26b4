#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/world.hpp"
#include "core/topics/topics.hpp"
#include "reports/sections/topics/topic_text.hpp"

namespace mapproof::test {
namespace {

/// A study of a topic in one small room, its other options the usual ones.
TopicStudy small_study(const Topic& topic, std::map<std::string, std::vector<double>> options) {
  TopicStudy study;
  TopicExperiment& experiment = study.experiment;
  experiment.topic = topic.name;
  experiment.steps = 300;
  experiment.world.landmarks = 20;
  experiment.options = std::move(options);
  for (const TopicOption& option : topic.options)
    experiment.options.try_emplace(std::string(option.name), option.usual);
  Random random(5);
  const World world = scatter_landmarks(experiment.world, random);
  const Path path = random_walk(world, experiment.walk, experiment.steps, random);
  study.design = topic.design(experiment);
  study.parts.push_back(
      topic.make({.experiment = experiment,
                  .part = "layout-1-pose-1",
                  .run = {},
                  .world = &world,
                  .path = &path,
                  .anchors = place_anchors(world, 4, AnchorPlacement::kWalls, random),
                  .seed = 9,
                  .data = {}}));
  return study;
}

const TopicOutcome& outcome(const TopicStudy& study, std::string_view setup,
                            std::string_view method, double level) {
  const auto found =
      std::ranges::find_if(study.parts.front().outcomes, [&](const TopicOutcome& one) {
        return one.at.setup == setup && one.method == method &&
               std::get<double>(one.at.levels->at(0).value) == level;
      });
  EXPECT_NE(found, study.parts.front().outcomes.end());
  return *found;
}

TEST(AssociationTopic, EstimatesBetterThanTheGivenIds) {
  const TopicStudy study =
      small_study(kAssociationTopic, {{"shares", {0.0, 0.2}}, {"neighbours", {6}}});
  EXPECT_EQ(outcome(study, "unassociated", "given", 0.0).values.at("mpe_m"),
            outcome(study, "unassociated", "estimated", 0.0).values.at("mpe_m"));
  EXPECT_GT(outcome(study, "unassociated", "estimated", 20.0).values.at("correct_percent"), 70.0);
  EXPECT_FALSE(outcome(study, "unassociated", "given", 20.0).values.contains("correct_percent"));
  EXPECT_EQ(conclusions_of(study).size(), 3U);
  // Its MOE allows for a reflection, and the label states it.
  EXPECT_EQ(study.design.quantities[2], known_quantity("moe_unmirrored_percent"));
}

TEST(MovedTopic, FindsTheLandmarkThatMovedFarAndNoOther) {
  const TopicStudy study = small_study(kMovedTopic, {{"distances_m", {0.0, 0.3}},
                                                     {"noises", {0.02}},
                                                     {"reach_m", {1.2}},
                                                     {"least_move", {1.5}},
                                                     {"tried", {3}}});
  EXPECT_EQ(outcome(study, "distance", "permutations", 0.0).values.at("false_percent"), 0.0);
  EXPECT_FALSE(outcome(study, "distance", "permutations", 0.0).values.contains("named_percent"));
  EXPECT_EQ(outcome(study, "distance", "permutations", 0.3).values.at("named_percent"), 100.0);
  EXPECT_LT(outcome(study, "distance", "permutations", 0.3).values.at("length_error_m"), 0.03);
  EXPECT_EQ(conclusions_of(study).size(), 3U);
}

}  // namespace
}  // namespace mapproof::test
