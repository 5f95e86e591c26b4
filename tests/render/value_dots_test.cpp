#include "render/figures/diagrams/value_dots.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/base/text/error_text.hpp"
#include "render/plot/layout.hpp"
#include "tests/support/images/figure_checks.hpp"

namespace mapproof::test {
namespace {

ValueDotsSpec three_methods() {
  return {.id = "dots",
          .title = "A has the lowest MPE",
          .caption = "Dots.",
          .x_label = "MPE [m]",
          .unit = "m",
          .panels = {{.methods = {{"A", "a", 0, 0.1, {}},
                                  {"B", "b", 1, 0.3, {0.2, 0.3, 0.4}},
                                  {"lost", "c", 2, kNaN, {}}}}}};
}

TEST(ValueDots, PutTheBestMethodUppermostAndLeaveOutWhatHasNoValue) {
  ValueDotsSpec spec = three_methods();
  EXPECT_EQ(value_dots_figure(spec).panels[0].y.names, (std::vector<std::string>{"B", "A"}));
  spec.higher_is_better = true;
  EXPECT_EQ(value_dots_figure(spec).panels[0].y.names, (std::vector<std::string>{"A", "B"}));
}

TEST(ValueDots, KeepTheOrderOfMethodsThatAreNotRanked) {
  ValueDotsSpec spec = three_methods();
  spec.ranked = false;
  for (const bool higher_is_better : {false, true}) {
    spec.higher_is_better = higher_is_better;
    EXPECT_EQ(value_dots_figure(spec).panels[0].y.names, (std::vector<std::string>{"B", "A"}));
  }
}

TEST(ValueDots, HaveTheirIntervalsBehindThem) {
  ValueDotsSpec spec = three_methods();
  spec.panels[0].methods[0].interval = Range{0.05, 0.2};
  const Panel panel = value_dots_figure(spec).panels[0];
  ASSERT_EQ(panel.layers.size(), 4U) << "runs and value of B, interval and value of A";
  const auto& bar = std::get<Segments>(panel.layers[2]);
  EXPECT_EQ(bar.x0, std::vector<double>{0.05});
  EXPECT_EQ(bar.x1, std::vector<double>{0.2});
  EXPECT_EQ(bar.y0, std::vector<double>{1.0});
  EXPECT_EQ(bar.y1, bar.y0);
  EXPECT_EQ(bar.colour, std::get<Scatter>(panel.layers[3]).colour);
}

TEST(ValueDots, ShowRunsBehindTheirMedian) {
  const Panel panel = value_dots_figure(three_methods()).panels[0];
  ASSERT_EQ(panel.layers.size(), 3U) << "runs and value of B, value of A";
  const auto& runs = std::get<Scatter>(panel.layers[0]);
  const auto& value = std::get<Scatter>(panel.layers[1]);
  EXPECT_EQ(runs.x, (std::vector<double>{0.2, 0.3, 0.4}));
  EXPECT_EQ(runs.y, (std::vector<double>{0.0, 0.0, 0.0}));
  EXPECT_FALSE(runs.filled);
  EXPECT_TRUE(value.filled);
  EXPECT_GT(value.size, runs.size);
  EXPECT_EQ(value.colour, runs.colour);
}

TEST(ValueDots, AreOnALogarithmicAxisIfTheySpanMuch) {
  ValueDotsSpec spec = three_methods();
  EXPECT_EQ(value_dots_figure(spec).panels[0].x.scale, Scale::kLinear);
  spec.panels[0].methods[1].runs.push_back(30.0);
  EXPECT_EQ(value_dots_figure(spec).panels[0].x.scale, Scale::kLog);
}

/// B diverged in one of three runs, C in all of them.
ValueDotsSpec with_diverged() {
  ValueDotsSpec spec = three_methods();
  spec.panels[0].methods[1].runs = {0.2, 0.3, 5e4};
  spec.panels[0].methods.push_back({"C", "d", 3, 2e6, {1e6, 2e6, 3e6}});
  return spec;
}

TEST(ValueDots, SayInANoteWhatDivergedAndHaveATriangleForItAtTheEndOfTheirAxis) {
  const Figure figure = value_dots_figure(with_diverged());
  const Panel& panel = figure.panels[0];
  EXPECT_EQ(panel.y.names, (std::vector<std::string>{"C", "B", "A"}));
  EXPECT_EQ(panel.x.scale, Scale::kLinear);
  ASSERT_TRUE(panel.x.limits);
  EXPECT_LT(panel.x.limits->high, 1.0);
  ASSERT_EQ(figure.notes.size(), 1U);
  EXPECT_EQ(figure.notes[0].text, "Diverged, over 1\u00A0km: B in 1 of 3 runs and C.");
  std::vector<double> rows;
  for (const Layer& layer : panel.layers) {
    const auto& dots = std::get<Scatter>(layer);
    EXPECT_LT(std::ranges::max(dots.x), panel.x.limits->high);
    if (dots.label == kGreatErrorText) rows.push_back(dots.y.at(0));
  }
  EXPECT_EQ(rows, (std::vector<double>{0.0, 1.0}));
  EXPECT_NE(figure.alt.find("C over 1\u00A0km"), std::string::npos) << figure.alt;
}

TEST(ValueDots, HaveAllValuesOnTheirAxisWhereAllAreThatLargeOrNoneDiverges) {
  ValueDotsSpec spec = with_diverged();
  spec.great_errors = false;
  EXPECT_FALSE(value_dots_figure(spec).panels[0].x.limits);
  EXPECT_TRUE(value_dots_figure(spec).notes.empty());
  spec = with_diverged();
  spec.panels[0].methods.erase(spec.panels[0].methods.begin(), spec.panels[0].methods.begin() + 3);
  EXPECT_FALSE(value_dots_figure(spec).panels[0].x.limits);
}

TEST(ValueDots, AreSaidInWords) {
  EXPECT_EQ(value_dots_figure(three_methods()).alt,
            "A has the lowest MPE. A 0.100\u00A0m; B 0.300\u00A0m.");
}

TEST(ValueDots, AreCleanOnPagesOfAllKinds) {
  ValueDotsSpec shares = three_methods();
  shares.panels[0].methods = {{"A", "a", 0, 100.0, {}, Range{100.0, 100.0}},
                              {"B", "b", 0, 40.0, {}, Range{20.0, 60.0}}};
  shares.x_limits = Range{-3.0, 103.0};
  for (ValueDotsSpec spec : {three_methods(), with_diverged(), shares}) {
    spec.panels.push_back(spec.panels[0]);
    for (const Theme& theme : {report_theme(), dark_theme(), paper_theme(3.25)})
      for (const std::string& flaw : flaws(lay_out(value_dots_figure(spec), theme)))
        ADD_FAILURE() << theme.name << ": " << flaw;
  }
}

}  // namespace
}  // namespace mapproof::test
