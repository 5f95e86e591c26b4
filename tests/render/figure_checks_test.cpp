#include "tests/support/images/figure_checks.hpp"

#include <gtest/gtest.h>

#include "render/plot/layout.hpp"
#include "render/plot/panel_layout.hpp"
#include "tests/support/images/figure_rules.hpp"
#include "tests/support/samples/sample_figures.hpp"

namespace mapproof::test {
namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

struct Case {
  Figure figure;
  Theme theme;
};

void PrintTo(const Case& one, std::ostream* out) { *out << one.figure.id << ' ' << one.theme.name; }

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const Figure& figure : sample_figures())
    for (const Theme& theme : {report_theme(), paper_theme(3.25), paper_theme(6.75)})
      cases.push_back({figure, theme});
  return cases;
}

class EveryFigure : public ::testing::TestWithParam<Case> {};

TEST_P(EveryFigure, IsCleanToTheEye) {
  EXPECT_EQ(joined(flaws(lay_out(GetParam().figure, GetParam().theme))), "");
}

INSTANTIATE_TEST_SUITE_P(All, EveryFigure, ::testing::ValuesIn(all_cases()), [](const auto& one) {
  std::string text = one.param.figure.id + "_" + one.param.theme.name;
  std::erase_if(text, [](char c) { return c == '.'; });
  std::ranges::replace(text, '-', '_');
  return text;
});

/// A clean figure with room in it, for tests that spoil it.
class FigureChecks : public ::testing::Test {
 protected:
  FigureChecks() {
    Figure figure;
    figure.id = "spoiled";
    Panel& panel = figure.panels.emplace_back();
    panel.x.label = "x";
    panel.layers.push_back(Polyline{.label = "line", .x = {0, 1, 2}, .y = {0, 1, 0}});
    panel.layers.push_back(Scatter{.label = "dots", .x = {0.5}, .y = {0.1}});
    drawing_ = lay_out(figure, report_theme());
  }

  void add(const std::string& text, Point at, Colour colour = mapproof::colour(0x000000)) {
    drawing_.add_text(
        ItemClass::kMarkLabel, 0,
        {.shaped = shape_text(text), .whole = text, .at = at, .size = 12.0, .colour = colour});
  }

  Item& item_of(ItemClass item_class) {
    return *std::ranges::find(drawing_.items, item_class, &Item::item_class);
  }

  std::string found() { return joined(flaws(drawing_)); }

  Drawing drawing_;
};

TEST_F(FigureChecks, FindNothingInACleanFigure) { EXPECT_EQ(found(), ""); }

TEST_F(FigureChecks, FindTextOnALine) {
  const Point peak = std::get<Shape>(item_of(ItemClass::kLine).what).path.points[1];
  add("peak", {peak.x - 12.0, peak.y + 4.0});
  EXPECT_NE(found().find("'peak' covers a line"), std::string::npos);
}

TEST_F(FigureChecks, FindTextOnAMarker) {
  const Point at = std::get<Stamp>(item_of(ItemClass::kMarker).what).at;
  add("dot", {at.x - 8.0, at.y + 4.0});
  EXPECT_NE(found().find("'dot' covers"), std::string::npos);
}

TEST_F(FigureChecks, FindTextOnText) {
  const Box frame = drawing_.frames[0];
  add("one", {frame.x0 + 20.0, frame.y0 + 30.0});
  add("two", {frame.x0 + 30.0, frame.y0 + 33.0});
  EXPECT_NE(found().find("'one' and mark-label 'two' overlap"), std::string::npos);
}

TEST_F(FigureChecks, FindTextCutByTheBorder) {
  add("outside", {drawing_.width - 20.0, 20.0});
  EXPECT_NE(found().find("'outside' is cut"), std::string::npos);
}

TEST_F(FigureChecks, FindTextOnTheFrame) {
  const Box frame = drawing_.frames[0];
  add("edge", {frame.x0 - 10.0, frame.y0 + 60.0});
  EXPECT_NE(found().find("'edge' covers"), std::string::npos);
}

TEST_F(FigureChecks, FindALegendOnData) {
  const Point peak = std::get<Shape>(item_of(ItemClass::kLine).what).path.points[1];
  Shape box;
  box.path.add_box(Box{peak.x, peak.y, peak.x, peak.y}.grown(10.0));
  box.fill = drawing_.background;
  drawing_.add(ItemClass::kLegendBox, 0, std::move(box));
  EXPECT_NE(found().find("legend-box covers data"), std::string::npos);
}

TEST_F(FigureChecks, FindPaleTextAndPaleLines) {
  const Box frame = drawing_.frames[0];
  add("pale", {frame.x0 + 20.0, frame.y0 + 30.0}, colour(0x999999));
  std::get<Shape>(item_of(ItemClass::kLine).what).stroke->colour = colour(0xF0E442);
  EXPECT_NE(found().find("'pale' has too little contrast"), std::string::npos);
  EXPECT_NE(found().find("a line has too little contrast"), std::string::npos);
}

TEST_F(FigureChecks, FindAGlyphThatTheFontLacks) {
  add("x", {drawing_.frames[0].x0 + 20.0, drawing_.frames[0].y0 + 30.0});
  std::get<TextLine>(drawing_.items.back().what).shaped.glyphs[0].index = 0;
  EXPECT_NE(found().find("lacks"), std::string::npos);
}

TEST_F(FigureChecks, FindAMarkerOutsideThePage) {
  std::get<Stamp>(item_of(ItemClass::kMarker).what).at = {1.0, 200.0};
  EXPECT_NE(found().find("marker is cut"), std::string::npos);
}

Polyline straight(std::string label, double from, double to) {
  return {.label = std::move(label), .x = {0.0, 10.0}, .y = {from, to}};
}

Figure plot_of(std::vector<Panel> panels) {
  return {.id = "plot",
          .title = "Plot",
          .caption = "Plot",
          .alt = "A plot.",
          .panels = std::move(panels)};
}

std::string rules_broken_by(std::vector<Panel> panels) {
  return joined(broken_rules(plot_of(std::move(panels)), report_theme()));
}

TEST(FigureRules, KeepAPlotOfLinesThatDiffer) {
  Polyline other = straight("b", 10.0, 0.0);
  other.colour = ThemeColour::kSeries2;
  other.dash = Dash::kDashed;
  EXPECT_EQ(rules_broken_by({{.title = "", .layers = {straight("a", 0.0, 10.0), other}}}), "");
}

TEST(FigureRules, FindLinesThatCrossInColoursThatAreAlike) {
  Theme theme = report_theme();
  theme.series[1] = theme.series[0];
  theme.series[1].red ^= 8;
  const auto broken = [&](const Polyline& first, Polyline second) {
    second.colour = ThemeColour::kSeries2;
    return joined(broken_rules(plot_of({{.title = "", .layers = {first, second}}}), theme));
  };
  const char* const rule = "'a' and 'b' touch and are alike";
  EXPECT_NE(broken(straight("a", 0.0, 10.0), straight("b", 10.0, 0.0)).find(rule),
            std::string::npos);
  EXPECT_EQ(broken(straight("a", 0.0, 1.0), straight("b", 9.0, 10.0)).find(rule),
            std::string::npos);
}

TEST(FigureRules, FindFramesThatTakeLittleOfThePage) {
  Panel named{.title = "", .layers = {}};
  for (int i = 0; i < 60; ++i)
    named.layers.push_back(straight("line " + std::to_string(i), 0.0, i));
  Panel others = named;
  for (Layer& layer : others.layers) std::get<Polyline>(layer).label += ", another";
  EXPECT_NE(rules_broken_by({named, others}).find("the panels take"), std::string::npos);
}

TEST(FigureRules, FindABarThatIsCutByTheFrame) {
  Panel panel{
      .title = "",
      .layers = {straight("a", 0.0, 10.0),
                 Segments{.label = "b", .x0 = {5.0}, .y0 = {-4.0}, .x1 = {5.0}, .y1 = {4.0}}}};
  panel.y.limits = Range{0.0, 10.0};
  const char* const rule = "a bar of 'b' is cut by the frame";
  EXPECT_NE(rules_broken_by({panel}).find(rule), std::string::npos);
  std::get<Segments>(panel.layers[1]).arrow = true;
  EXPECT_EQ(rules_broken_by({panel}).find(rule), std::string::npos);
}

TEST(FigureRules, FindABandThatIsCutByTheFrameWithoutANote) {
  Figure figure = plot_of(
      {{.title = "",
        .layers = {Band{.label = "b", .x = {0.0, 10.0}, .low = {0.0, 1.0}, .high = {4.0, 12.0}},
                   straight("b", 2.0, 8.0)}}});
  const auto is_found = [&] {
    return joined(broken_rules(figure, report_theme())).find("the band of 'b' is cut") !=
           std::string::npos;
  };
  EXPECT_FALSE(is_found());
  figure.panels[0].y.limits = Range{0.0, 10.0};
  EXPECT_TRUE(is_found());
  figure.notes.push_back({"1 interval ends above the frame."});
  EXPECT_FALSE(is_found());
}

TEST(FigureRules, FindAPointThatMayBeAnywhereBelowItsAxis) {
  Panel panel{.title = "",
              .layers = {straight("a", 1.0, 10.0), Scatter{.label = "b", .x = {5.0}, .y = {1.0}}}};
  panel.y.scale = Scale::kLog;
  panel.y.limits = Range{1.0, 20.0};
  EXPECT_NE(rules_broken_by({panel}).find("a point of 'b' is at the foot"), std::string::npos);
}

TEST(FigureRules, FindATextOfWhichAPartIsLeftOut) {
  Panel panel{.title = "", .layers = {straight("a", 0.0, 10.0)}};
  panel.x.label = std::string(300, 'x');
  EXPECT_NE(rules_broken_by({panel}).find("the axis-label 'xxx"), std::string::npos);
}

TEST(FigureRules, FindATitleThatCountsWhatItDoesNotName) {
  Figure figure = plot_of({{.title = "", .layers = {straight("a", 0.0, 10.0)}}});
  figure.title = "A, B and 3 more have the lowest MPE";
  EXPECT_NE(joined(broken_rules(figure, report_theme())).find("the title"), std::string::npos);
}

TEST(FigureRules, HoldRowsOfPanelsInAColumnToTheirShare) {
  std::vector<Panel> panels;
  for (const char* title : {"one", "two"}) {
    Panel& panel = panels.emplace_back(Panel{.title = title, .layers = {}});
    for (int i = 0; i < 6; ++i) {
      Polyline line = straight("line of a long name " + std::to_string(i), 0.0, i);
      line.dash = static_cast<Dash>(i % 5);
      line.colour = series_colour(static_cast<std::size_t>(i));
      panel.layers.push_back(line);
    }
  }
  EXPECT_EQ(joined(broken_rules(plot_of(panels), paper_theme(3.25))), "");
}

TEST(FigureRules, FindALineThatIsLostOnItsPage) {
  Panel empty{.title = "", .layers = {Polyline{.label = "", .x = {4.9, 5.0}, .y = {5.0, 5.0}}}};
  empty.x.limits = empty.y.limits = Range{0.0, 10.0};
  EXPECT_NE(rules_broken_by({empty}).find("of the coloured pixels"), std::string::npos);
}

}  // namespace
}  // namespace mapproof::test
