#include "reports/sections/topics/topic_means.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

Condition at(double level) { return condition("s", {{"l", level}}); }

/// Two methods in five layouts of two runs each; the second is `by` better, but for what `jitter`
/// adds to it in every other layout.
TopicStudy study_of(double by, double jitter) {
  TopicStudy study;
  study.design.methods = {{"one", "First"}, {"two", "Second"}};
  study.design.quantities = {known_quantity("mpe_m")};
  for (int layout = 1; layout <= 5; ++layout)
    for (int pose = 1; pose <= 2; ++pose) {
      TopicPart part;
      part.run = RunId{layout, pose};
      const double first = 0.1 * layout + 0.01 * pose;
      const double second = first - by + (layout == 2 ? jitter : 0.0);
      part.outcomes = {{at(5.0), "one", {{"mpe_m", first}}, {}},
                       {at(5.0), "two", {{"mpe_m", second}}, {}}};
      study.parts.push_back(std::move(part));
    }
  return study;
}

MeanEstimate difference(const TopicStudy& study) {
  return topic_difference(study, at(5.0), "two", "one", "mpe_m").value();
}

TEST(TopicMeans, ADifferenceIsPairedByRun) {
  const MeanEstimate found = difference(study_of(0.02, 0.0));
  EXPECT_NEAR(found.mean, -0.02, 1e-12);
  EXPECT_NEAR(found.half_width.value(), 0.0, 1e-12);  // What layouts share is no noise.
  EXPECT_EQ(verdict_words(found), "better");
  EXPECT_EQ(verdict_words(difference(study_of(-0.02, 0.0))), "worse");
  EXPECT_EQ(verdict_words(difference(study_of(0.02, 0.3))), "not significantly different");
}

TEST(TopicMeans, OneLayoutTellsNothingOfChance) {
  TopicStudy study = study_of(0.02, 0.0);
  study.parts.resize(2);
  EXPECT_FALSE(difference(study).half_width);
  EXPECT_EQ(verdict_words(difference(study)), "too few runs to test the difference, in 1 layout");
}

TEST(TopicMeans, FewerLayoutsThanAnIntervalNeedsShowNoSignificance) {
  TopicStudy study = study_of(0.02, 0.0);
  EXPECT_FALSE(has_few_layouts(study));
  EXPECT_TRUE(is_apart_from_0(difference(study)));
  study.parts.resize(4);
  EXPECT_EQ(layouts_of(study), 2);
  EXPECT_TRUE(has_few_layouts(study));
  EXPECT_FALSE(is_apart_from_0(difference(study)));
  EXPECT_EQ(verdict_words(difference(study)), "too few runs to test the difference, in 2 layouts");
  EXPECT_EQ(few_layouts_words(study), "; too few runs to test differences, in 2 layouts");
}

TEST(TopicMeans, ADifferenceOverSeveralConditionsHasThePairsOfAllOfThem) {
  TopicStudy study = study_of(0.02, 0.0);
  study.parts[0].outcomes.push_back({at(6.0), "one", {{"mpe_m", 1.0}}, {}});
  study.parts[0].outcomes.push_back({at(6.0), "two", {{"mpe_m", 1.22}}, {}});
  const auto found = topic_difference(study, {at(5.0), at(6.0)}, "two", "one", "mpe_m");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->values, 11);
  EXPECT_EQ(found->clusters, 5);
  EXPECT_NEAR(found->mean, (10 * -0.02 + 0.22) / 11.0, 1e-12);
}

TEST(TopicMeans, ADifferenceNeedsBothSeries) {
  TopicStudy study = study_of(0.02, 0.0);
  EXPECT_FALSE(topic_difference(study, at(6.0), "two", "one", "mpe_m"));
  study.parts[0].outcomes.pop_back();
  EXPECT_EQ(difference(study).values, 9);
  EXPECT_THROW(topic_difference(study, at(5.0), "two", "one", "moe"), InvalidInput);
}

TEST(TopicMeans, LevelsAreGivenWithWhatTheyAreOf) {
  const auto words = [](std::vector<SetupFactor> factors) {
    const TopicSetup setup{"a", "A", std::move(factors)};
    return level_words(setup, conditions_of(setup).front());
  };
  const SetupFactor share{"missing", "share missing", "%", {30}};
  EXPECT_EQ(words({share}), "share missing 30\u00A0%");
  EXPECT_EQ(words({{"noise", "noise of bearings", "\u00B0", {0}}}), "noise of bearings 0\u00B0");
  EXPECT_EQ(words({steps_factor({200})}), "observations 200");
  EXPECT_EQ(words({share, steps_factor({200})}), "share missing 30\u00A0%, observations 200");
  EXPECT_EQ(words({}), "");
  EXPECT_EQ(label_with_unit(share), "share missing [%]");
  EXPECT_EQ(label_with_unit(steps_factor({})), "observations");
}

TEST(TopicMeans, ConditionsAreAllCombinationsOfLevels) {
  const TopicSetup grid{"g", "G", {{"b", "B", "", {1, 2, 3}}, {"a", "A", "", {5, 7}}}};
  const std::vector<Condition> conditions = conditions_of(grid);
  ASSERT_EQ(conditions.size(), 6U);
  EXPECT_EQ(conditions[1], condition("g", {{"a", 7.0}, {"b", 1.0}}));
  EXPECT_EQ(conditions[5], condition("g", {{"a", 7.0}, {"b", 3.0}}));
  EXPECT_THROW(levels_of(grid), InvalidInput);
  EXPECT_THROW(condition_at(grid, 1.0), InvalidInput);
  const TopicSetup single{"s", "S"};
  EXPECT_EQ(conditions_of(single), std::vector{condition("s")});
  EXPECT_EQ(levels_of(single), std::vector{0.0});
}

TEST(TopicMeans, SeriesHaveTheirLabels) {
  const TopicStudy study = study_of(0.0, 0.0);
  EXPECT_EQ(series_label(study.design, "two"), "Second");
  EXPECT_EQ(series_label(study.design, "three"), "three");
}

}  // namespace
}  // namespace mapproof
