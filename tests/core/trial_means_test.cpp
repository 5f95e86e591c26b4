#include "core/trials/trial_means.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

/// Two series in three layouts of two runs each; the second is `by` better, but for what `jitter`
/// adds to it in every other layout.
TrialStudy study_of(double by, double jitter) {
  TrialStudy study;
  study.design.series = {{"one", "First"}, {"two", "Second"}};
  study.design.quantities = {known_quantity("mpe_m")};
  for (int layout = 1; layout <= 3; ++layout)
    for (int pose = 1; pose <= 2; ++pose) {
      TrialPart part;
      part.run = RunId{layout, pose};
      const double first = 0.1 * layout + 0.01 * pose;
      const double second = first - by + (layout == 2 ? jitter : 0.0);
      part.trials = {{"s", "one", 5.0, {first}, {}}, {"s", "two", 5.0, {second}, {}}};
      study.parts.push_back(std::move(part));
    }
  return study;
}

MeanEstimate difference(const TrialStudy& study) {
  return trial_difference(study, "s", "two", "one", 5.0, "mpe_m").value();
}

TEST(TrialMeans, ADifferenceIsPairedByRun) {
  const MeanEstimate found = difference(study_of(0.02, 0.0));
  EXPECT_NEAR(found.mean, -0.02, 1e-12);
  EXPECT_NEAR(found.half_width.value(), 0.0, 1e-12);  // What layouts share is no noise.
  EXPECT_EQ(verdict_words(found), "better");
  EXPECT_EQ(verdict_words(difference(study_of(-0.02, 0.0))), "worse");
  EXPECT_EQ(verdict_words(difference(study_of(0.02, 0.3))), "no different beyond chance");
}

TEST(TrialMeans, OneLayoutTellsNothingOfChance) {
  TrialStudy study = study_of(0.02, 0.0);
  study.parts.resize(2);
  EXPECT_FALSE(difference(study).half_width);
  EXPECT_EQ(verdict_words(difference(study)), "better, in one layout");
}

TEST(TrialMeans, ADifferenceNeedsBothSeries) {
  TrialStudy study = study_of(0.02, 0.0);
  EXPECT_FALSE(trial_difference(study, "s", "two", "one", 6.0, "mpe_m"));
  study.parts[0].trials.pop_back();
  EXPECT_EQ(difference(study).values, 5);
  EXPECT_THROW(trial_difference(study, "s", "two", "one", 5.0, "moe"), InvalidInput);
}

TEST(TrialMeans, LevelsAreToldWithWhatTheyAreOf) {
  EXPECT_EQ(level_words({"a", "A", "share missing [%]", {30}}, 30), "share missing 30 %");
  EXPECT_EQ(level_words({"a", "A", "noise of bearings [\u00B0]", {0}}, 0),
            "noise of bearings 0\u00B0");
  EXPECT_EQ(level_words({"a", "A", "observations", {200}}, 200), "observations 200");
  EXPECT_EQ(level_words({"a", "A", "", {0}}, 0), "");
}

TEST(TrialMeans, SeriesAreToldByTheirLabels) {
  const TrialStudy study = study_of(0.0, 0.0);
  EXPECT_EQ(series_label(study.design, "two"), "Second");
  EXPECT_EQ(series_label(study.design, "three"), "three");
}

}  // namespace
}  // namespace mapproof
