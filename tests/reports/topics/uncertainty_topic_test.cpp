#include <gtest/gtest.h>

#include "core/topics/topics.hpp"
#include "core/topics/uncertainty.hpp"
#include "reports/sections/results/topic_records.hpp"
#include "reports/sections/topics/topic_text.hpp"
#include "tests/reports/topics/simulated_part.hpp"

namespace mapproof {
namespace {

TopicExperiment small_study() {
  TopicExperiment experiment;
  experiment.name = "uncertainty";
  experiment.topic = "uncertainty";
  experiment.steps = 200;
  experiment.world.landmarks = 15;
  experiment.world.side_m = 1.4;
  for (const TopicOption& option : kUncertaintyTopic.options)
    experiment.options[std::string(option.name)] = option.usual;
  experiment.options["walks"] = {6};
  experiment.options["tried"] = {2};
  experiment.options["replicates"] = {12};
  experiment.options["observations"] = {100, 200};
  experiment.options["blocks"] = {0.5, 1};
  return experiment;
}

TopicPart made(const TopicExperiment& experiment) {
  TopicPart part = test::simulated_part(kUncertaintyTopic, experiment, {0, 4, 9, 14});
  part.run = RunId{};
  return part;
}

TEST(UncertaintyTopic, TriesEverySeriesAtEveryLevelOfBothSensors) {
  const TopicExperiment experiment = small_study();
  TopicStudy study;
  study.experiment = experiment;
  study.design = kUncertaintyTopic.design(experiment);
  study.parts = {made(experiment)};
  // 2 sensors x 2 levels x 4 methods, and 2 lengths of blocks x 2 methods.
  EXPECT_EQ(study.parts[0].outcomes.size(), 20U);
  for (const TopicOutcome& outcome : study.parts[0].outcomes) {
    ASSERT_EQ(outcome.values.size(), study.design.quantities.size());
    EXPECT_GE(outcome.values.at("mean_covered_percent"), 0.0);
    EXPECT_LE(outcome.values.at("mean_covered_percent"), 100.0);
    EXPECT_GT(outcome.values.at("spread_m"), 0.0);
  }
  std::vector<std::string> methods;
  for (const StudiedMethod& method : study.design.methods) methods.push_back(method.id);
  EXPECT_EQ(methods, (std::vector<std::string>{"lpca", "smacof", "smacof-knn-K8", "isomap-K8"}));
  ASSERT_EQ(study.parts[0].maps.size(), 2U);
  ASSERT_TRUE(study.parts[0].maps[0].uncertainty);
  EXPECT_EQ(study.parts[0].maps[0].uncertainty->covariances.size(), 15U);
  EXPECT_EQ(conclusions_of(study).size(), 6U);
  MapUncertainty& uncertainty = *study.parts[0].maps[0].uncertainty;
  for (const auto& [variance, words] :
       {std::pair{1e6, ", the 95\u00a0% ellipses of 11 of 11 landmarks hold the true position"},
        std::pair{1e-12, ", the 95\u00a0% ellipses of 0 of 11 landmarks hold the true position"}}) {
    uncertainty.covariances.assign(15, variance * Eigen::Matrix2d::Identity());
    const std::string title = topic_maps(study, "u").figures.at(0).title;
    EXPECT_TRUE(title.ends_with(words)) << title;
  }
}

TEST(UncertaintyTopic, MakesTheSameAgain) {
  const TopicExperiment experiment = small_study();
  const TopicPart once = made(experiment), again = made(experiment);
  for (std::size_t i = 0; i < once.outcomes.size(); ++i)
    EXPECT_EQ(once.outcomes[i].values, again.outcomes[i].values);
}

TEST(Coverage, CountsByHand) {
  // Two landmarks and an anchor; two maps about (0, 0) and (4, 0).
  Points ground_truth(3, 2), first(3, 2), second(3, 2);
  ground_truth << 0, 0, 4, 3, 9, 9;
  first << 1, 0, 4, 1, 9, 9;
  second << -1, 0, 4, -1, 9, 9;
  MapUncertainty wide;
  wide.squared_radius = 4.0;
  wide.covariances.assign(3, Eigen::Matrix2d::Identity());  // Circles of radius 2.
  wide.covariances[1] *= 0.2;                               // Of radius 0.89.
  const Coverage found = coverage({first, second}, {wide, wide}, {ground_truth, {2}});
  EXPECT_DOUBLE_EQ(found.mean_percent, 50.0);
  EXPECT_DOUBLE_EQ(found.ground_truth_percent, 50.0);
  EXPECT_DOUBLE_EQ(found.bias_m, 1.5);
  EXPECT_DOUBLE_EQ(found.spread_m, 1.0);
  EXPECT_DOUBLE_EQ(found.predicted_m, std::sqrt((2.0 + 0.4) / 2.0));
}

}  // namespace
}  // namespace mapproof
