#include "reports/sections/method_ranks.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/reports/synthetic_study.hpp"

namespace mapproof {
namespace {

using test::synthetic_mpe;
using test::synthetic_study;

void remove_scores(Study& study, Method method, int layout) {
  for (Run& run : study.runs)
    for (RunRecord& record : run.records)
      if (record.setting.method == method && run.id.layout == layout) record.score.reset();
}

TEST(MethodRanks, TakeLayoutsAsUnitsAndPosesInTheMean) {
  const Study study = synthetic_study(5, 2);
  const MethodRanks ranks = method_ranks(study, study.experiment.sensors[0]);
  EXPECT_EQ(ranks.layouts, (std::vector{1, 2, 3, 4, 5}));
  ASSERT_EQ(ranks.methods.size(), 4U);
  const MethodSetting lpca{Method::kLpca, {}};
  EXPECT_NEAR(ranks.mpe_m(2, 0),
              0.5 * (synthetic_mpe(lpca, {3, 1}, 2000) + synthetic_mpe(lpca, {3, 2}, 2000)), 1e-12);
}

TEST(MethodRanks, AreTheSameInEveryLayoutWhereErrorsGrowTogether) {
  const Study study = synthetic_study(5, 2);
  const MethodRanks ranks = method_ranks(study, study.experiment.sensors[0]);
  EXPECT_EQ(ranks.test->mean_ranks, (std::vector{4.0, 3.0, 1.0, 2.0}));
  EXPECT_EQ(ranks.test->units, 5);
  EXPECT_TRUE(std::isinf(ranks.test->f));
  EXPECT_NEAR(ranks.critical_difference, 2.569 * std::sqrt(20.0 / 30.0), 1e-3);
  EXPECT_EQ(ranks.alike, (std::vector<std::vector<int>>{{2, 3, 1}, {3, 1, 0}}));
}

TEST(MethodRanks, LeaveOutAMethodWithoutAScoreInSomeLayout) {
  Study study = synthetic_study(3, 2);
  remove_scores(study, Method::kSmacof, 2);
  const MethodRanks ranks = method_ranks(study, study.experiment.sensors[0]);
  EXPECT_EQ(ranks.left_out, std::vector{Method::kSmacof});
  EXPECT_EQ(ranks.methods.size(), 3U);
  EXPECT_EQ(ranks.test->units, 3);
}

TEST(MethodRanks, HaveNoTestOverASingleLayoutOrMethod) {
  Study study = synthetic_study(1, 3);
  EXPECT_FALSE(method_ranks(study, study.experiment.sensors[0]).test);
  study = synthetic_study(4, 1);
  study.experiment.sensors[0].methods.resize(1);
  EXPECT_FALSE(method_ranks(study, study.experiment.sensors[0]).test);
  study.runs.clear();
  EXPECT_FALSE(method_ranks(study, study.experiment.sensors[0]).test);
}

TEST(OrderingClaims, AreTheNeighbouringPairsEachOnce) {
  Study study = synthetic_study(5, 2);
  SensorStudy& sensor = study.experiment.sensors[0];
  sensor.published.orderings = {{Method::kIsomap, Method::kSmacof, Method::kLpca},
                                {Method::kSmacofKnn, Method::kSmacof, Method::kLpca}};
  const auto claims = ordering_claims(study, sensor);
  ASSERT_EQ(claims.size(), 3U);
  EXPECT_EQ(claims[2].less, Method::kSmacofKnn);
  EXPECT_EQ(claims[2].more, Method::kSmacof);
}

TEST(OrderingClaims, CompareRunByRunWithLayoutsAsUnits) {
  Study study = synthetic_study(5, 2);
  SensorStudy& sensor = study.experiment.sensors[0];
  sensor.published.orderings = {{Method::kSmacof, Method::kLpca}, {Method::kLpca, Method::kIsomap}};
  const auto claims = ordering_claims(study, sensor);
  const double middle = 1.0 + 0.3 + 0.015;
  EXPECT_NEAR(claims[0].difference_m->mean, (0.20 - 0.09) * middle * 200.0 / std::sqrt(2000.0),
              1e-12);
  EXPECT_EQ(claims[0].difference_m->clusters, 5);
  EXPECT_EQ(claims[0].layouts_where, 5);
  EXPECT_TRUE(claims[0].holds());
  EXPECT_TRUE(claims[0].is_significant());
  EXPECT_FALSE(claims[1].holds());
  EXPECT_EQ(claims[1].layouts_where, 0);
}

TEST(OrderingClaims, SayNothingOfMethodsThatWereNotTried) {
  Study study = synthetic_study(2, 1);
  SensorStudy& sensor = study.experiment.sensors[0];
  sensor.published.orderings = {{Method::kLpca, Method::kIsomap}};
  std::erase_if(sensor.methods, [](const auto& grid) { return grid.method == Method::kIsomap; });
  const auto claims = ordering_claims(study, sensor);
  EXPECT_FALSE(claims[0].difference_m);
  EXPECT_FALSE(claims[0].holds());
  EXPECT_FALSE(claims[0].is_significant());
}

}  // namespace
}  // namespace mapproof
