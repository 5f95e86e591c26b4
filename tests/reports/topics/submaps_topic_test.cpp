#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/topics/topics.hpp"
#include "reports/sections/topics/topic_text.hpp"
#include "tests/support/samples/incomplete.hpp"

namespace mapproof {
namespace {

TEST(SubmapsTopic, ComparesPartsWithTheWholeAndReportsWhichIsWorse) {
  TopicExperiment experiment;
  experiment.topic = kSubmapsTopic.name;
  for (const TopicOption& option : kSubmapsTopic.options)
    experiment.options[std::string(option.name)] = option.usual;
  experiment.options["sizes"] = {16, 100};
  experiment.options["overlaps"] = {0.5};
  experiment.options["shares_sensor_range"] = {0.5};
  experiment.options["usual_size"] = {16};
  const test::WalkedRoom room = test::walked_room(1, 400, 30);
  TopicStudy study;
  study.experiment = experiment;
  study.design = kSubmapsTopic.design(experiment);
  study.parts.push_back(kSubmapsTopic.make({.experiment = experiment,
                                            .part = "layout-1-pose-1",
                                            .run = {1, 1},
                                            .world = &room.world,
                                            .path = &room.path,
                                            .anchors = room.anchors,
                                            .seed = 3,
                                            .data = {},
                                            .with_maps = true}));
  // Of the whole and of parts, at the highest level of each of three setups.
  ASSERT_EQ(study.parts.front().maps.size(), 6U);
  for (const TopicMap& map : study.parts.front().maps) {
    EXPECT_TRUE(map.map.estimate.allFinite()) << map.id;
    ASSERT_TRUE(map.map.score) << map.id;
    const auto same =
        std::ranges::find_if(study.parts.front().outcomes, [&](const TopicOutcome& outcome) {
          return outcome.at == map.at && outcome.method == map.method;
        });
    EXPECT_EQ(same->values.at("mpe_m"), map.map.score->mpe_m) << map.id;
  }
  // Its MOE allows for a reflection, and the label states it.
  EXPECT_EQ(study.design.quantities[1], known_quantity("moe_unmirrored_percent"));
  // Six method at each of four levels, and two more where data are missing.
  EXPECT_EQ(study.parts.front().outcomes.size(), 26U);
  for (const TopicOutcome& outcome : study.parts.front().outcomes) {
    EXPECT_EQ(outcome.values.at("mapped_percent"), 100.0) << outcome.method;
    // Parts that hold all landmarks are the whole.
    if (outcome.at == condition("size", {{"submap_landmarks", 100.0}})) {
      EXPECT_FALSE(outcome.values.contains("residual_percent"));
    }
  }
  const auto sentences = conclusions_of(study);
  ASSERT_FALSE(sentences.empty());
  // One layout has no information on chance.
  EXPECT_TRUE(sentences.front().ends_with("; too few runs to test differences, in 1 layout."))
      << sentences.front();
  // A share has its unit, and no label of an axis.
  const auto overlap = std::ranges::find_if(
      sentences, [](const std::string& one) { return one.starts_with("Sub-maps by overlap"); });
  ASSERT_NE(overlap, sentences.end());
  EXPECT_NE(overlap->find("at 50\u00A0% (share borrowed) the mean"), std::string::npos) << *overlap;
}

}  // namespace
}  // namespace mapproof
