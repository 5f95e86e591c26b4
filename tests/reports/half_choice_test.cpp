#include "reports/sections/half_choice.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/reports/synthetic_study.hpp"

namespace mapproof {
namespace {

using test::synthetic_study;

const HalfChoice& choice_of(const HalfChoices& choices, Method method) {
  for (const HalfChoice& choice : choices.methods)
    if (choice.method == method) return choice;
  throw std::runtime_error("no such method");
}

/// A study in which ISOMAP's error at the last step is what `error_of` says.
template <typename ErrorOf>
Study study_with(int layouts, int poses, ErrorOf error_of) {
  Study study = synthetic_study(layouts, poses);
  for (Run& run : study.runs)
    for (RunRecord& record : run.records)
      if (record.setting.method == Method::kIsomap) {
        const double error = error_of(run.id, *record.setting.parameter);
        record.score = Score{error, 10.0 * error, error, 10.0 * error};
      }
  return study;
}

TEST(HalfChoices, JudgeEachLayoutByTheParameterThatTheOthersChose) {
  // Odd layouts are best at K = 4, even ones at K = 9; each is worse by its number elsewhere.
  const Study study = study_with(5, 2, [](const RunId& run, double K) {
    const bool is_best = K == (run.layout % 2 == 1 ? 4.0 : 9.0);
    return is_best ? 1.0 : 1.0 + run.layout;
  });
  const HalfChoices choices = half_choices(study, study.experiment.sensors[0]);
  EXPECT_EQ(choices.halves, Halves::kLayouts);
  EXPECT_EQ(choices.members[0], (std::vector{1, 3, 5}));
  EXPECT_EQ(choices.members[1], (std::vector{2, 4}));
  const HalfChoice& isomap = choice_of(choices, Method::kIsomap);
  EXPECT_EQ(isomap.chosen[0]->parameter, 4.0);
  EXPECT_EQ(isomap.chosen[1]->parameter, 9.0);
  EXPECT_NEAR(isomap.mpe_m->mean, 1.0 + 3.0, 1e-12);  // every layout at its worse parameter
  EXPECT_NEAR(isomap.moe_percent->mean, 40.0, 1e-12);
  EXPECT_EQ(isomap.mpe_m->clusters, 5);
  // Over all runs K = 4 is best: 1 in three layouts, 3 and 5 in two.
  EXPECT_NEAR(isomap.same_runs_mpe_m->mean, (3.0 + 3.0 + 5.0) / 5.0, 1e-12);
  EXPECT_NEAR(isomap.optimism_m->mean, 4.0 - 2.2, 1e-12);
  EXPECT_NEAR(optimism_percent(isomap), 100.0 * 1.8 / 2.2, 1e-9);
}

TEST(HalfChoices, AreNotOptimisticWhereOneParameterIsBestEverywhere) {
  const Study study = synthetic_study(5, 2);
  const HalfChoices choices = half_choices(study, study.experiment.sensors[1]);
  for (const HalfChoice& choice : choices.methods) {
    EXPECT_EQ(choice.optimism_m->mean, 0.0);
    EXPECT_EQ(choice.mpe_m->mean, choice.same_runs_mpe_m->mean);
  }
  EXPECT_FALSE(choice_of(choices, Method::kLpca).has_choice);
  EXPECT_TRUE(choice_of(choices, Method::kIsomap).has_choice);
}

TEST(HalfChoices, PartTheRunsThatThereAreWhateverTheirNumbers) {
  Study study = synthetic_study(5, 1);
  std::erase_if(study.runs, [](const auto& run) { return run.id.layout % 2 == 0; });
  const HalfChoices choices = half_choices(study, study.experiment.sensors[0]);
  EXPECT_EQ(choices.members[0], (std::vector{1, 5}));
  EXPECT_EQ(choices.members[1], (std::vector{3}));
}

TEST(HalfChoices, PartThePosesOfASingleLayout) {
  const Study study = synthetic_study(1, 4);
  const HalfChoices choices = half_choices(study, study.experiment.sensors[0]);
  EXPECT_EQ(choices.halves, Halves::kPoses);
  EXPECT_EQ(choices.members[1], (std::vector{2, 4}));
  EXPECT_FALSE(choice_of(choices, Method::kIsomap).mpe_m->half_width);
}

TEST(HalfChoices, DoNotExistForASingleRun) {
  for (const int layouts : {0, 1}) {
    const Study study = synthetic_study(layouts, 1);
    const HalfChoices choices = half_choices(study, study.experiment.sensors[0]);
    EXPECT_EQ(choices.halves, Halves::kNone);
    EXPECT_TRUE(choices.methods.empty());
  }
}

TEST(HalfChoices, LeaveOutWhatOneHalfNeverScored) {
  Study study = synthetic_study(2, 1);
  for (RunRecord& record : study.runs[0].records)
    if (record.setting.method == Method::kIsomap) record.score.reset();
  const HalfChoice isomap =
      choice_of(half_choices(study, study.experiment.sensors[0]), Method::kIsomap);
  EXPECT_FALSE(isomap.chosen[0]);
  EXPECT_TRUE(isomap.chosen[1]);
  EXPECT_FALSE(isomap.mpe_m);  // nothing was chosen for the runs of layout 2, layout 1 has none
  EXPECT_TRUE(std::isnan(optimism_percent(isomap)));
}

}  // namespace
}  // namespace mapproof
