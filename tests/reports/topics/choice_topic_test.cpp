#include <algorithm>
#include <cctype>
#include <cmath>

#include <gtest/gtest.h>

#include "core/topics/topics.hpp"
#include "reports/sections/topics/topic_text.hpp"
#include "tests/reports/topics/simulated_part.hpp"

namespace mapproof {
namespace {

TEST(ChoiceTopic, HasNoRegretForTheBestAndTriesEverySeries) {
  TopicExperiment experiment;
  experiment.topic = "choice";
  experiment.steps = 300;
  experiment.world.landmarks = 16;
  experiment.world.side_m = 1.4;
  experiment.options = {{"observations", {100, 300}}, {"replicates", {2}}};
  const TopicStudy study = test::simulated_study(kChoiceTopic, experiment, {0, 5, 10, 15});
  EXPECT_EQ(study.parts[0].outcomes.size(), 2U * 2U * study.design.methods.size());
  for (const TopicOutcome& outcome : study.parts[0].outcomes) {
    EXPECT_GE(outcome.values.at("regret_m"), 0.0) << outcome.method;
    if (outcome.method != "anchors") {
      EXPECT_GE(outcome.values.at("regret_shape_m"), 0.0) << outcome.method;
    }
  }
  // What the mean rank picks after all observations, of each sensor.
  ASSERT_EQ(study.parts[0].maps.size(), 2U);
  for (const TopicMap& map : study.parts[0].maps) {
    EXPECT_EQ(map.method, "combined");
    ASSERT_TRUE(map.map.score) << map.id;
    const auto same =
        std::ranges::find_if(study.parts[0].outcomes, [&](const TopicOutcome& outcome) {
          return outcome.at == map.at && outcome.method == map.method;
        });
    ASSERT_NE(same, study.parts[0].outcomes.end());
    EXPECT_NEAR(same->values.at("mpe_m"), map.map.score->mpe_m, 1e-3) << map.id;
  }
  const auto sentences = conclusions_of(study);
  ASSERT_EQ(sentences.size(), 2U);
  EXPECT_NE(sentences[0].find("mean regret is "), std::string::npos) << sentences[0];
  const std::string picked_by = kChoiceWords.headline(study).detail;
  EXPECT_TRUE(picked_by.starts_with("by ") && std::islower(picked_by[3])) << picked_by;
  EXPECT_EQ(sentences[0].find("nan"), std::string::npos) << sentences[0];
  EXPECT_TRUE(sentences[0].ends_with("; too few runs to rank the criteria, in 1 layout."))
      << sentences[0];
  // A page's first screen may cut it after a semicolon.
  EXPECT_EQ(question_of(experiment).find(';'), std::string::npos);
}

}  // namespace
}  // namespace mapproof
