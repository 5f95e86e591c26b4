#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/topics/topics.hpp"
#include "reports/sections/topics/topic_text.hpp"
#include "tests/support/samples/incomplete.hpp"

namespace mapproof {
namespace {

TopicExperiment small_topic_study() {
  TopicExperiment experiment;
  experiment.topic = kMissingTopic.name;
  experiment.steps = 400;
  for (const TopicOption& option : kMissingTopic.options)
    experiment.options[std::string(option.name)] = option.usual;
  experiment.options["shares_at_random"] = {0.0, 0.5};
  experiment.options["shares_sensor_range"] = {0.7};
  experiment.options["shares_occlusion"] = {0.3};
  experiment.options["dimensions"] = {5};
  return experiment;
}

/// The outcome whose map that is: those of the highest level of each setup are kept.
const TopicOutcome& outcome_of(const TopicStudy& study, const std::string& map) {
  for (const TopicOutcome& outcome : study.parts.front().outcomes)
    for (const TopicSetup& setup : study.design.setups)
      if (outcome.at == conditions_of(setup).back() && setup.id + "-" + outcome.method == map)
        return outcome;
  throw InvalidInput("no outcome of the map " + map);
}

/// A number under the id of one of a score's is that one and no other.
void expect_scores_of(const MapRecord& map, const TopicOutcome& outcome) {
  ASSERT_TRUE(map.score);
  const std::map<std::string, double> score = {
      {"mpe_m", map.score->mpe_m},
      {"moe_percent", map.score->moe_percent},
      {"mpe_all_fitted_m", map.score->mpe_all_fitted_m},
      {"moe_unmirrored_percent", map.score->moe_unmirrored_percent}};
  for (const auto& [quantity, value] : outcome.values)
    if (const auto known = score.find(quantity); known != score.end()) {
      EXPECT_EQ(value, known->second) << map.id << ", " << quantity;
    }
}

TEST(MissingTopic, TriesEverySeriesAndConcludesWithNumbers) {
  const TopicExperiment experiment = small_topic_study();
  const test::WalkedRoom room = test::walked_room(1, 400, 25);
  TopicStudy study;
  study.experiment = experiment;
  study.design = kMissingTopic.design(experiment);
  const TopicTask context{.experiment = experiment,
                          .part = "layout-1-pose-1",
                          .run = {1, 1},
                          .world = &room.world,
                          .path = &room.path,
                          .anchors = room.anchors,
                          .seed = 3,
                          .data = {},
                          .with_maps = true};
  study.parts.push_back(kMissingTopic.make(context));
  const TopicPart& part = study.parts.front();
  // Covisible pairs are not tried at the two levels of data missing at random.
  EXPECT_EQ(part.outcomes.size(), 4 * study.design.methods.size() - 2);
  for (const TopicOutcome& outcome : part.outcomes) {
    EXPECT_EQ(outcome.values.size(), study.design.quantities.size());
    EXPECT_TRUE(std::isfinite(outcome.values.at("mapped_percent"))) << outcome.method;
  }
  ASSERT_EQ(part.maps.size(), 6U);
  for (const TopicMap& map : part.maps) expect_scores_of(map.map, outcome_of(study, map.id));
  EXPECT_EQ(
      part.outcomes.front().values,
      kMissingTopic.make(context).outcomes.front().values);  // nothing but its arguments counts
  const std::vector<std::string> sentences = conclusions_of(study);
  ASSERT_FALSE(sentences.empty());
  EXPECT_NE(sentences.front().find(" m"), std::string::npos);
}

}  // namespace
}  // namespace mapproof
