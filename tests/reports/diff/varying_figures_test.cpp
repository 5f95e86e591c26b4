#include <gtest/gtest.h>

#include "render/figures/diagrams/method_comparison.hpp"
#include "reports/diff/folder_diff.hpp"
#include "tests/reports/diff/small_study.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

ParetoSpec costs() {
  return {.id = "cost-bearing",
          .title = "Cost of a map",
          .settings = {{"LPCA", 0.01, 0.3},
                       {"ISOMAP", 0.02, 0.2},
                       {"SDE", 0.3, 0.1},
                       {"MDS", 0.5, 0.4}},
          .record_ids = {"layout-1-pose-1/bearing/lpca/2000"}};
}

DiffResult diff_of(const Figure& before, const Figure& after) {
  const TemporaryFolder folder;
  write_study_figure(before, report_theme(), folder / "before");
  write_study_figure(after, report_theme(), folder / "after");
  return folder_diff(folder / "before", folder / "after");
}

TEST(VaryingFigures, PassWhereTheFastestIsAnother) {
  ParetoSpec later = costs();
  later.settings[3].seconds = 0.001;  // Now MDS is on the front, and none is dominated.
  const Figure before = pareto_figure(costs());
  ASSERT_NE(before.panels[0].layers.size(), pareto_figure(later).panels[0].layers.size());
  const DiffResult result = diff_of(before, pareto_figure(later));
  EXPECT_TRUE(result.passes) << result.judgement.cause;
  EXPECT_EQ(result.judgement.verdict, Verdict::kWithinTolerance);
  EXPECT_NE(result.judgement.cause.find("varies from run to run"), std::string::npos);
}

TEST(VaryingFigures, PassWhereOneSettingIsOnTheFrontAlone) {
  ParetoSpec later = costs();
  later.settings[2].seconds = 0.001;  // SDE, which has the least error.
  const Figure before = pareto_figure(costs()), after = pareto_figure(later);
  for (const bool turned : {false, true}) {
    const DiffResult result = turned ? diff_of(after, before) : diff_of(before, after);
    EXPECT_TRUE(result.passes) << result.judgement.cause;
  }
}

TEST(VaryingFigures, PassWhereTimesHaveAnotherUnit) {
  ParetoSpec later = costs();
  for (CostedSetting& setting : later.settings) setting.seconds *= 1e-3;
  const Figure before = pareto_figure(costs()), after = pareto_figure(later);
  ASSERT_NE(before.panels[0].x.label, after.panels[0].x.label);
  const DiffResult result = diff_of(before, after);
  EXPECT_TRUE(result.passes) << result.judgement.cause;
  Figure renamed = after;
  renamed.panels[0].x.label = "time per landmark [µs]";
  EXPECT_FALSE(diff_of(before, renamed).passes);
}

TEST(VaryingFigures, AreNotJudgedByImagesOfAnotherSize) {
  const Figure before = pareto_figure(costs());
  const TemporaryFolder folder;
  write_study_figure(before, report_theme(), folder / "before");
  ParetoSpec later = costs();
  later.settings[0].seconds *= 1.1;
  Theme taller = report_theme();
  taller.width_pt += 10.0;
  write_study_figure(pareto_figure(later), taller, folder / "after");
  const DiffResult result = folder_diff(folder / "before", folder / "after");
  EXPECT_TRUE(result.passes) << result.judgement.cause;
  EXPECT_EQ(result.judgement.cause.find("value is equal"), std::string::npos);
}

void set_error(Mark& mark, const char* error) {
  for (auto& [key, value] : mark.data)
    if (key == "error") value = error;
}

TEST(OtherRecords, MakeNoFigureBetterOrWorse) {
  Figure before = pareto_figure(costs());
  before.varies = false;
  Figure after = before;
  after.record_ids = {"layout-9-pose-1/bearing/lpca/2000"};
  for (Layer& layer : after.panels[0].layers)
    if (auto* points = std::get_if<Scatter>(&layer))
      for (std::size_t i = 0; i < points->y.size(); ++i) {
        points->y[i] *= 2.0;
        set_error(points->marks[i], "9");
      }
  EXPECT_EQ(diff_of(before, after).judgement.verdict, Verdict::kChanged);
  after.record_ids = before.record_ids;
  EXPECT_EQ(diff_of(before, after).judgement.verdict, Verdict::kWorse);
}

TEST(VaryingFigures, AreReportedWhereSomethingLastingChanged) {
  const Figure before = pareto_figure(costs());
  ParetoSpec fewer = costs();
  fewer.settings.pop_back();
  EXPECT_EQ(diff_of(before, pareto_figure(fewer)).judgement.verdict, Verdict::kChanged);
  Figure renamed = before;
  renamed.panels[0].x.label = "minutes a map";
  EXPECT_EQ(diff_of(before, renamed).judgement.verdict, Verdict::kStyle);
  Figure others = before;
  others.record_ids = {"layout-9-pose-1/bearing/lpca/2000"};
  EXPECT_EQ(diff_of(before, others).judgement.verdict, Verdict::kChanged);
  Figure lost = before;
  std::erase_if(lost.panels[0].layers,
                [](const Layer& layer) { return std::holds_alternative<Polyline>(layer); });
  EXPECT_EQ(diff_of(before, lost).judgement.verdict, Verdict::kChanged);
}

}  // namespace
}  // namespace mapproof::test
