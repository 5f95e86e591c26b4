#include <cmath>

#include <gtest/gtest.h>

#include "core/topics/topics.hpp"
#include "reports/sections/topics/topic_text.hpp"
#include "tests/reports/topics/simulated_part.hpp"

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
  const TopicStudy study = test::simulated_study(kMixedTopic, experiment, {0, 8, 16, 24});
  // 2 sensors with two methods and 3 mixes at 4 levels, 3 sensors with two methods and 3 mixes at
  // 2.
  ASSERT_EQ(study.parts[0].outcomes.size(), 46U);
  for (const TopicOutcome& outcome : study.parts[0].outcomes)
    EXPECT_GT(outcome.values.at("mpe_m"), 0.0);
  const std::vector<std::string> sentences = conclusions_of(study);
  // Of each setup the gain of mixing, then the cost of choosing by the neighbourhoods.
  ASSERT_EQ(sentences.size(), 6U);
  for (const char* part :
       {"at noise of bearings 0\u00B0 the mean MPE is ", "at noise of bearings 20\u00B0 the mean ",
        "; too few runs to test differences, in 1 layout."})
    EXPECT_NE(sentences[0].find(part), std::string::npos) << sentences[0];
  EXPECT_EQ(sentences[2].find("both"), std::string::npos) << "three sensors: " << sentences[2];
  EXPECT_NE(sentences[3].find("keeps most neighbourhoods"), std::string::npos);
}

}  // namespace
}  // namespace mapproof
