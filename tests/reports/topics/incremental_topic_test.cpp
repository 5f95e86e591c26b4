#include <gtest/gtest.h>

#include "core/topics/topics.hpp"
#include "reports/sections/topics/topic_text.hpp"
#include "tests/reports/topics/simulated_part.hpp"

namespace mapproof {
namespace {

TEST(IncrementalTopic, MapsEverySensorIncrementallyToEveryLevel) {
  TopicExperiment experiment;
  experiment.topic = "incremental";
  experiment.steps = 300;
  experiment.world.landmarks = 16;
  experiment.world.side_m = 1.4;
  experiment.options = {{"observations", {100, 300}}, {"every", {50}}};
  const TopicStudy study = test::simulated_study(kIncrementalTopic, experiment, {0, 5, 10, 15});
  // Three sensors, three methods, two levels, incremental and from scratch.
  ASSERT_EQ(study.parts[0].outcomes.size(), 36U);
  for (const TopicOutcome& outcome : study.parts[0].outcomes) {
    EXPECT_GE(outcome.values.at("greatest_gap_ppm"), outcome.values.at("gap_ppm"));
    EXPECT_LE(outcome.values.at("greatest_gap_ppm"), 1.0)
        << outcome.at.setup << ' ' << outcome.method;
    EXPECT_EQ(outcome.values.at("beyond_percent"), 0.0);
    const double steps = std::get<double>(outcome.at.levels->at(0).value);
    EXPECT_EQ(outcome.values.at("steps_gone_through"),
              outcome.method.ends_with("-whole") ? steps : 50.0);
  }
  EXPECT_EQ(study.design.methods[4].id, "isomap-K6");
  EXPECT_EQ(study.design.methods[5].id, "isomap-K6-whole");
  EXPECT_EQ(conclusions_of(study).size(), 3U);
}

}  // namespace
}  // namespace mapproof
