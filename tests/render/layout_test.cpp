#include "render/plot/layout.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "render/base/geometry.hpp"
#include "render/cairo/cairo_backend.hpp"
#include "render/figures/diagrams/method_comparison.hpp"
#include "render/figures/maps/map.hpp"
#include "render/plot/axis_map.hpp"
#include "render/plot/layers.hpp"
#include "tests/support/images/figure_checks.hpp"
#include "tests/support/images/figure_rules.hpp"
#include "tests/support/samples/drawn_panels.hpp"
#include "tests/support/samples/sample_comparisons.hpp"
#include "tests/support/samples/sample_figures.hpp"

namespace mapproof::test {
namespace {

Figure with_panels(std::size_t count) {
  Figure figure;
  figure.id = "test";
  figure.panels.resize(count);
  return figure;
}

bool legend_is_inside(const Drawing& drawing) {
  return std::ranges::find(drawing.items, ItemClass::kLegendBox, &Item::item_class) !=
         drawing.items.end();
}

TEST(AxisMap, PutsLimitsAtTheEnds) {
  const AxisMap linear(Scale::kLinear, {2.0, 4.0}, 100.0, 200.0);
  EXPECT_DOUBLE_EQ(linear(2.0), 100.0);
  EXPECT_DOUBLE_EQ(linear(3.0), 150.0);
  const AxisMap log(Scale::kLog, {0.01, 100.0}, 0.0, 80.0);
  EXPECT_DOUBLE_EQ(log(1.0), 40.0);
  EXPECT_DOUBLE_EQ(log(100.0), 80.0);
  EXPECT_TRUE(std::isnan(linear(NAN)));
}

TEST(PanelLimits, HoldAllDataWithRoomAround) {
  Panel panel;
  panel.layers.push_back(Scatter{.x = {1.0, 5.0, NAN}, .y = {-2.0, 2.0, 1e9}});
  const PanelLimits limits = panel_limits(panel);
  EXPECT_LT(limits.x.low, 1.0);
  EXPECT_GT(limits.x.high, 5.0);
  EXPECT_LT(limits.y.high, 3.0);  // The point with a NaN does not count.
}

TEST(PanelLimits, AreNeverEmpty) {
  Panel panel;
  for (const double value : {0.0, 1e-300, 5.0, -1e12, 1e150}) {
    panel.layers = {Scatter{.x = {value}, .y = {value}}};
    const PanelLimits limits = panel_limits(panel);
    EXPECT_LT(limits.x.low, limits.x.high) << value;
    EXPECT_LT(limits.y.low, limits.y.high) << value;
  }
}

TEST(Layout, EqualAspectMakesUnitsEquallyLong) {
  const Drawing drawing = lay_out(map_figure(sample_map(50, 0.1, 1), "map"), report_theme());
  std::vector<Point> at;
  for (const Item& item : drawing.items)
    if (item.mark && drawing.marks[*item.mark].id.starts_with("true-"))
      at.push_back(std::get<Stamp>(item.what).at);
  const auto true_m = *sample_map(50, 0.1, 1).ground_truth_m;
  std::vector<Eigen::Index> rows;
  const auto anchors = sample_map(50, 0.1, 1).anchors;
  for (Eigen::Index i = 0; i < 50; ++i)
    if (std::ranges::find(anchors, i) == anchors.end()) rows.push_back(i);
  ASSERT_EQ(at.size(), rows.size());
  const double x_scale = (at[1].x - at[0].x) / (true_m(rows[1], 0) - true_m(rows[0], 0));
  const double y_scale = (at[1].y - at[0].y) / (true_m(rows[1], 1) - true_m(rows[0], 1));
  EXPECT_NEAR(x_scale, -y_scale, 1e-9 * x_scale);  // y grows downward on the page.
}

/// The greatest coordinate of a panel's layers.
double farthest(const Drawing& drawing) {
  double most = 0.0;
  for (const Item& item : drawing.items)
    if (const Shape* shape = std::get_if<Shape>(&item.what))
      for (const Point p : shape->path.points)
        most = std::max({most, std::abs(p.x), std::abs(p.y)});
  return most;
}

TEST(Layout, CutsLinesThatLeadFarAwayWhereTheyCannotBeSeen) {
  const std::vector<double> far = {0.0, 1e3, 1e112, -1e149, 1e150, -1e150, 0.5};
  Figure figure = with_panels(1);
  figure.panels[0].x.limits = figure.panels[0].y.limits = Range{0.0, 1.0};
  figure.panels[0].layers = {Polyline{.x = far, .y = far, .dash = Dash::kDashed},
                             Segments{.x0 = {0.0}, .y0 = {0.5}, .x1 = {1e150}, .y1 = {0.5}},
                             Band{.x = {0.0, 1.0}, .low = {-1e149, 0.0}, .high = {1e149, 1.0}},
                             Area{.x = {0.0, 1e149, 1e149, 0.0}, .y = {0.0, 0.0, 1e149, 1e149}}};
  const Drawing drawing = lay_out(figure, report_theme());
  EXPECT_LT(farthest(drawing), 11'000.0);
  EXPECT_LT(to_pdf(drawing).size(), 100'000U);
}

TEST(Outline, IsCutAtTheSidesOfABoxWithoutATurn) {
  const Box box{0.0, 0.0, 10.0, 10.0};
  Outline lines;
  lines.move_to({5.0, 5.0});
  lines.line_to({25.0, 15.0});
  lines.line_to({25.0, 4.0});
  lines.line_to({-15.0, 4.0});
  lines.line_to({5.0, 5.0});
  const Outline cut = cut_to(box, lines);
  const std::vector<Point> expected = {{5.0, 5.0}, {10.0, 7.5}, {10.0, 4.0},
                                       {0.0, 4.0}, {0.0, 4.75}, {5.0, 5.0}};
  ASSERT_EQ(cut.points.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(cut.points[i].x, expected[i].x, 1e-12) << i;
    EXPECT_NEAR(cut.points[i].y, expected[i].y, 1e-12) << i;
  }
  EXPECT_EQ(std::ranges::count(cut.commands, PathCommand::kMove), 3);
  Outline inside;
  inside.move_to({1.0, 1.0});
  inside.line_to({2.0, 2.0});
  EXPECT_EQ(cut_to(box, inside).points, inside.points);
}

/// The lines of a label with what they say, joined.
std::string joined_text(const std::vector<TextLine>& lines) {
  std::string text;
  for (const TextLine& line : lines) text += (text.empty() ? "" : " ") + line.shaped.text;
  return text;
}

TEST(Layout, ALongLabelOfTheYAxisIsWrapped) {
  const std::string label =
      "distance between the mean of the estimated positions and the ground truth [m]";
  for (const bool is_equal : {false, true}) {
    Figure figure = with_panels(1);
    figure.panels[0].y.label = label;
    figure.panels[0].equal_aspect = is_equal;
    figure.panels[0].layers.push_back(Polyline{.x = {0, 3}, .y = {0, 1}});
    const Drawing drawing = lay_out(figure, report_theme());
    const std::vector<TextLine> lines = texts_of(drawing, ItemClass::kAxisLabel);
    EXPECT_GT(lines.size(), 1U);
    EXPECT_EQ(joined_text(lines), label);
    for (const TextLine& line : lines) EXPECT_EQ(line.whole, label);
    EXPECT_TRUE(flaws(drawing).empty()) << flaws(drawing).front();
  }
}

TEST(Layout, NoAxisOfAMapHasASingleTick) {
  Figure figure = with_panels(1);
  figure.panels[0].equal_aspect = true;
  figure.panels[0].layers.push_back(Polyline{.x = {0.4, 13.8}, .y = {1.5, 8.6}});
  std::set<double> baselines;  // One for all ticks of x, one for each of y.
  for (const TextLine& line : texts_of(lay_out(figure, paper_theme(3.4)), ItemClass::kTickLabel))
    baselines.insert(line.at.y);
  EXPECT_GE(baselines.size(), 3U);
}

TEST(Layout, ALongLabelOfASharedYAxisIsWrapped) {
  const std::string label = "distance of the map from the ground truth [m]";
  Figure figure = with_panels(3);
  figure.shared_y = true;
  for (Panel& panel : figure.panels) {
    panel.y.label = label;
    panel.layers.push_back(Polyline{.x = {0, 3}, .y = {0, 1}});
  }
  const Drawing drawing = lay_out(figure, report_theme());
  EXPECT_EQ(joined_text(texts_of(drawing, ItemClass::kAxisLabel)), label);
  EXPECT_TRUE(flaws(drawing).empty()) << flaws(drawing).front();
}

TEST(Layout, ALongLabelOfAColourBarIsWrapped) {
  const std::string label =
      "distance between the mean of the estimated positions and the ground truth [m]";
  Figure figure = with_panels(1);
  figure.panels[0].layers.push_back(Cells{.x = {0, 1},
                                          .y = {0, 1},
                                          .columns = 2,
                                          .values = {1, 2, 3, 4},
                                          .colour_scale = {.limits = {1, 4}, .bar_label = label}});
  const Drawing drawing = lay_out(figure, report_theme());
  std::vector<TextLine> lines = texts_of(drawing, ItemClass::kLegendText);
  std::erase_if(lines, [](const TextLine& line) { return !line.upward; });
  EXPECT_EQ(joined_text(lines), label);
  EXPECT_TRUE(flaws(drawing).empty()) << flaws(drawing).front();
}

TEST(Layout, TheColourBarOfAMapStaysOnThePageAndBesideTheLegend) {
  for (const double height : {10.0, 20.0, 60.0})
    for (const std::string label : {"", "ground truth"}) {
      Figure figure = with_panels(1);
      Panel& map = figure.panels[0];
      map.equal_aspect = true;
      map.layers.push_back(
          Cells{.x = {0, 40},
                .y = {0, height},
                .columns = 2,
                .values = {0.01, 0.02, 0.03, 0.04},
                .colour_scale = {.limits = {0.01, 0.04}, .bar_label = "error [m]"}});
      map.layers.push_back(Polyline{.label = label, .x = {0, 40}, .y = {0, height}});
      const Drawing drawing = lay_out(figure, report_theme());
      EXPECT_TRUE(flaws(drawing).empty()) << height << label << ": " << flaws(drawing).front();
    }
}

TEST(Layout, PutsTheLegendInACornerThatIsFree) {
  Figure figure = with_panels(1);
  figure.panels[0].layers.push_back(Polyline{.label = "rising", .x = {0, 1}, .y = {0, 1}});
  const Drawing drawing = lay_out(figure, report_theme());
  ASSERT_TRUE(legend_is_inside(drawing));
  const Box frame = drawing.frames[0];
  const TextLine text = texts_of(drawing, ItemClass::kLegendText)[0];
  EXPECT_LT(text.at.x, frame.centre().x);  // The line ends at the upper right.
  EXPECT_LT(text.at.y, frame.centre().y);
}

TEST(Layout, PutsTheLegendOutsideWhenDataAreEverywhere) {
  Figure figure = with_panels(1);
  Scatter dots{.label = "dots"};
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j) {
      dots.x.push_back(i);
      dots.y.push_back(j);
    }
  figure.panels[0].layers.push_back(dots);
  const Drawing drawing = lay_out(figure, report_theme());
  EXPECT_FALSE(legend_is_inside(drawing));
  const Box text = text_box(texts_of(drawing, ItemClass::kLegendText)[0]);
  EXPECT_FALSE(drawing.frames[0].overlaps(text));
}

TEST(Layout, LayersOfOneLabelShareAnEntry) {
  Figure figure = with_panels(1);
  figure.panels[0].layers = {Band{.label = "a", .x = {0, 1}, .low = {0, 0}, .high = {1, 1}},
                             Polyline{.label = "a", .x = {0, 1}, .y = {0, 1}},
                             Polyline{.label = "", .x = {0, 1}, .y = {1, 0}}};
  EXPECT_EQ(texts_of(lay_out(figure, report_theme()), ItemClass::kLegendText).size(), 1u);
}

TEST(Layout, LabelsOfCrowdedPointsCoverNeitherMarksNorEachOther) {
  Figure figure = with_panels(1);
  PointLabels labels;
  Scatter dots;
  for (int i = 0; i < 12; ++i) {
    labels.x.push_back(0.1 * i);
    labels.y.push_back(0.02 * (i % 3));
    labels.text.push_back("landmark " + std::to_string(i));
  }
  dots.x = labels.x;
  dots.y = labels.y;
  figure.panels[0].layers = {dots, labels};
  const Drawing drawing = lay_out(figure, report_theme());
  EXPECT_EQ(texts_of(drawing, ItemClass::kMarkLabel).size(), 12u);
  EXPECT_TRUE(flaws(drawing).empty());
}

TEST(Layout, PanelsStandSideBySideAndAreClean) {
  Figure figure = with_panels(3);
  for (Panel& panel : figure.panels) {
    panel.title = "A panel with a title";
    panel.x = {.label = "frequency [Hz]", .scale = Scale::kLog};
    panel.y = {.label = "power", .scale = Scale::kLog};
    panel.layers.push_back(Polyline{.label = "p", .x = {1, 10, 1000}, .y = {1e6, 1e3, 1e-4}});
  }
  const Drawing drawing = lay_out(figure, paper_theme(6.75));
  ASSERT_EQ(drawing.frames.size(), 3u);
  EXPECT_LT(drawing.frames[0].x1, drawing.frames[1].x0);
  EXPECT_LT(drawing.frames[1].x1, drawing.frames[2].x0);
  for (const std::string& flaw : flaws(drawing)) ADD_FAILURE() << flaw;
}

TEST(Layout, FramesStayOnThePageWhateverTheNotes) {
  Figure figure = map_figure(sample_map(20, 0.1, 1), "map");
  for (int i = 0; i < 40; ++i)
    figure.notes.push_back({"Something else went wrong, again, and this is why."});
  for (const Theme& theme : {report_theme(), paper_theme(3.25)})
    for (const std::string& flaw : flaws(lay_out(figure, theme))) ADD_FAILURE() << flaw;
}

TEST(Layout, RefusesAFigureThatCannotBeDrawn) {
  EXPECT_THROW(lay_out(with_panels(0), report_theme()), InvalidInput);
}

/// As many lines as ends, each from 0 to its end.
Figure with_lines(const std::vector<double>& ends, const std::string& name = "line ") {
  Figure figure = with_panels(1);
  for (std::size_t i = 0; i < ends.size(); ++i)
    figure.panels[0].layers.push_back(Polyline{.label = name + std::to_string(i),
                                               .x = {0.0, 1.0},
                                               .y = {0.0, ends[i]},
                                               .marker = Marker::kCircle});
  return figure;
}

std::vector<std::string> legend_words(const Drawing& drawing) {
  std::vector<std::string> words;
  for (const TextLine& line : texts_of(drawing, ItemClass::kLegendText))
    words.push_back(line.shaped.text);
  return words;
}

TEST(LineEnds, AreLabelledRightOfTheFrameInTheirOrder) {
  const Drawing drawing = lay_out(with_lines({1.0, 3.0, 2.9}), report_theme());
  EXPECT_EQ(legend_words(drawing), (std::vector<std::string>{"line 1", "line 2", "line 0"}));
  double last = 0.0;
  for (const TextLine& line : texts_of(drawing, ItemClass::kLegendText)) {
    EXPECT_GT(line.at.x, drawing.frames[0].x1);
    EXPECT_GT(line.at.y, last + 12.0);  // Apart, though two ends nearly meet.
    last = line.at.y;
  }
  EXPECT_FALSE(legend_is_inside(drawing));
  for (const std::string& flaw : flaws(drawing)) ADD_FAILURE() << flaw;
}

TEST(Layout, BreaksLongNamesIntoLinesInTheLegendOfAJournalsColumn) {
  const std::string name = "Grid-based FastSLAM 2.0 with adaptive resampling, variant ";
  const Drawing drawing = lay_out(with_lines({1.0, 3.0, 2.9}, name), paper_theme(3.25));
  std::string words;
  for (const std::string& line : legend_words(drawing)) words += line + " ";
  for (const char* variant : {"0 ", "1 ", "2 "})
    EXPECT_NE(words.find(name + variant), std::string::npos) << words;
  EXPECT_EQ(words.find("…"), std::string::npos) << words;
  for (const std::string& flaw : flaws(drawing)) ADD_FAILURE() << flaw;
}

TEST(Curves, HaveTheValuesOfTheirMarkersForPages) {
  Figure figure = with_lines({0.25});
  std::get<Polyline>(figure.panels[0].layers[0]).mark = {"line", {{"curve", "line 0"}}};
  const Drawing drawing = lay_out(figure, report_theme());
  using Data = std::vector<std::pair<std::string, std::string>>;
  ASSERT_EQ(drawing.marks.size(), 1U);
  EXPECT_EQ(drawing.marks[0].data, (Data{{"curve", "line 0"}, {"points", "0, 0;1, 0.25"}}));
}

TEST(Curves, HaveAMarkerAtEachLevelThatHasRoomForIt) {
  const Theme theme = report_theme();
  const auto markers = [&](int levels) {
    Figure figure = with_lines({0.25});
    Polyline& line = std::get<Polyline>(figure.panels[0].layers[0]);
    line.marker = Marker::kDiamond;
    line.x.clear();
    line.y.clear();
    for (int i = 0; i < levels; ++i) {
      line.x.push_back(i);
      line.y.push_back(0.25);
    }
    const Drawing drawing = lay_out(figure, theme);
    return std::ranges::count(drawing.items, ItemClass::kMarker, &Item::item_class);
  };
  EXPECT_EQ(markers(40), 40);
  EXPECT_LT(markers(2000), 40);  // Dashes are visible between them.
}

TEST(Layout, BreaksLongNamesBesideARankDiagramIntoLinesInAJournalsColumn) {
  CriticalDifferenceSpec spec = sample_ranks(7);
  spec.methods[0].label = "Batch Levenberg\u2013Marquardt started at the true trajectory (oracle)";
  spec.methods[1].label = "iSAM2, incremental smoothing and mapping with robust kernels";
  spec.methods[3].label =
      "Graph-based simultaneous localisation and mapping with switchable constraints and dynamic "
      "covariance scaling (g2o back end)";
  spec.methods[5].label = "EKF-SLAM with joint compatibility branch and bound";
  const Figure figure = critical_difference_figure(spec);
  for (const Theme& theme : {report_theme(), paper_theme(3.25)}) {
    const Drawing drawing = lay_out(figure, theme);
    std::string words;
    for (const TextLine& line : texts_of(drawing, ItemClass::kMarkLabel)) {
      const std::string& text = line.shaped.text;
      words += text.ends_with("\u2013") ? text : text + " ";
    }
    EXPECT_EQ(words.find("\u2026"), std::string::npos) << words;
    for (const std::size_t i : {0, 1, 3, 5})
      EXPECT_NE(words.find(spec.methods[i].label), std::string::npos) << words;
    for (const std::string& flaw : flaws(drawing)) ADD_FAILURE() << flaw;
  }
}

std::string long_name(std::size_t i) {
  return "Graph-based simultaneous localisation and mapping with switchable constraints and "
         "dynamic covariance scaling (g2o back end) " +
         std::to_string(i);
}

/// Expects no text of the figure to be cut, or to cover another one, on pages and on paper.
void expect_whole(const Figure& figure) {
  for (const Theme& theme : {report_theme(), paper_theme(3.25)}) {
    for (const std::string& broken : broken_rules(figure, theme))
      EXPECT_EQ(broken.find(" is cut"), std::string::npos) << figure.id << ": " << broken;
    for (const std::string& flaw : flaws(lay_out(figure, theme)))
      ADD_FAILURE() << theme.name << ", " << figure.id << ": " << flaw;
  }
}

TEST(Layout, CutsNoNameBesideARankDiagramOfManyMethods) {
  for (const std::size_t methods : {15, 22, 30}) {
    CriticalDifferenceSpec spec = sample_ranks(2);
    spec.title = "Ranks";
    spec.methods.clear();
    for (std::size_t i = 0; i < methods; ++i)
      spec.methods.push_back({"M" + std::to_string(i), 1.0 + static_cast<double>(i)});
    spec.methods[2].label = long_name(2);
    spec.methods.back().label = long_name(methods - 1);
    expect_whole(critical_difference_figure(spec));
  }
}

TEST(Layout, MakesAPageAsHighAsLongNamesOfAllMethodsNeed) {
  CriticalDifferenceSpec spec = sample_ranks(2);
  spec.methods.clear();
  for (std::size_t i = 0; i < 16; ++i)
    spec.methods.push_back({long_name(i), 1.0 + static_cast<double>(i)});
  expect_whole(critical_difference_figure(spec));
}

TEST(Layout, CutsNoNameOfARowAndLeavesNoneOut) {
  Panel panel;
  panel.x.label = "MPE [m]";
  Scatter dots;
  for (std::size_t i = 0; i < 12; ++i) {
    panel.y.names.push_back(i == 4 ? long_name(4) : "method " + std::to_string(i));
    dots.x.push_back(0.1 * static_cast<double>(i));
    dots.y.push_back(static_cast<double>(i));
  }
  panel.y.limits = Range{-0.6, 11.6};
  panel.layers.push_back(dots);
  for (const std::size_t panels : {1, 2}) {
    Figure figure = with_panels(0);
    figure.title = "Rows";
    figure.panels.assign(panels, panel);
    expect_whole(figure);
    for (const Theme& theme : {report_theme(), paper_theme(3.25)}) {
      std::multiset<std::string> names;
      for (const TextLine& line : texts_of(lay_out(figure, theme), ItemClass::kTickLabel))
        names.insert(line.whole.empty() ? line.shaped.text : line.whole);
      for (const std::string& name : panel.y.names) EXPECT_GE(names.count(name), panels) << name;
    }
  }
}

TEST(Layout, CutsNoNameInALegend) {
  const Figure figure = with_lines({1.0, 3.0, 2.9}, long_name(1) + ", then " + long_name(2));
  for (const Theme& theme : {report_theme(), paper_theme(3.25)}) {
    for (const std::string& broken : broken_rules(figure, theme))
      EXPECT_EQ(broken.find(" is cut"), std::string::npos) << broken;
    for (const std::string& line : legend_words(lay_out(figure, theme)))
      EXPECT_EQ(line.find("…"), std::string::npos) << line;
  }
}

TEST(LineEnds, ThatAreFarFromTheRightSideNeedALegend) {
  Figure figure = with_lines({1.0, 2.0});
  std::get<Polyline>(figure.panels[0].layers[0]).x = {0.0, 0.3};
  const Drawing drawing = lay_out(figure, report_theme());
  EXPECT_TRUE(legend_is_inside(drawing));
}

TEST(Legend, ListsLinesInTheOrderOfTheirEnds) {
  const Figure figure = with_lines({1.0, 3.0, 2.0}, "a name too long to stand beside a frame, ");
  const std::vector<std::string> words = legend_words(lay_out(figure, report_theme()));
  ASSERT_EQ(words.size(), 3U);
  EXPECT_TRUE(words[0].ends_with("1"));
  EXPECT_TRUE(words[1].ends_with("2"));
  EXPECT_TRUE(words[2].ends_with("0"));
}

TEST(LineEnds, HaveShortNamesWhereLongOnesAreTooLong) {
  const Figure figure = with_lines({1.0, 3.0}, "SMACOF, kNN weights, K = ");
  EXPECT_EQ(legend_words(lay_out(figure, paper_theme(6.75)))[0], "SMACOF kNN, K = 1");
}

TEST(Legend, ShowsTwoPeriodsOfTheLongestDashAndNoMarkerOverAGap) {
  Figure figure = with_lines({1.0, 3.0});
  std::get<Polyline>(figure.panels[0].layers[0]).x = {0.0, 0.3};  // A legend.
  auto& line = std::get<Polyline>(figure.panels[0].layers[1]);
  for (const Theme& theme : {report_theme(), paper_theme(3.25)})
    for (const Dash dash : {Dash::kDashed, Dash::kDashDot, Dash::kLongDash}) {
      line.dash = dash;
      const std::vector<double> lengths = dash_lengths(dash, line.width * theme.line_pt);
      const double period = std::accumulate(lengths.begin(), lengths.end(), 0.0);
      bool is_seen = false;
      for (const Item& item : lay_out(figure, theme).items) {
        const auto* shape = std::get_if<Shape>(&item.what);
        if (item.item_class != ItemClass::kLegendSample || shape == nullptr || !shape->stroke ||
            shape->stroke->dashes != lengths)
          continue;
        is_seen = true;
        const double length = shape->path.points[1].x - shape->path.points[0].x;
        EXPECT_GE(length, 2.0 * period + lengths[0] - 1e-9) << theme.name;
      }
      EXPECT_TRUE(is_seen) << theme.name;
    }
}

TEST(Legend, HasShortNamesOfMethodsInAColumn) {
  Figure figure = with_lines({1.0, 3.0}, "SMACOF, kNN weights, K = ");
  std::get<Polyline>(figure.panels[0].layers[1]).x = {0.0, 0.3};
  EXPECT_EQ(legend_words(lay_out(figure, paper_theme(3.25)))[0], "SMACOF kNN, K = 1");
  EXPECT_EQ(legend_words(lay_out(figure, paper_theme(6.75)))[0], "SMACOF, kNN weights, K = 1");
}

/// What stands for the bands.
std::vector<Shape> bands_in(const Drawing& drawing) {
  std::vector<Shape> shapes;
  for (const Item& item : drawing.items)
    if (item.item_class == ItemClass::kBand) shapes.push_back(std::get<Shape>(item.what));
  return shapes;
}

TEST(Bands, AreBarsSideBySideWhereMoreThanThreeLieOnEachOther) {
  Figure figure = with_panels(1);
  for (int i = 0; i < 3; ++i)
    figure.panels[0].layers.push_back(
        Band{.x = {0.0, 1.0}, .low = {0.0, 0.0}, .high = {1.0, 1.0 + i}});
  for (const Shape& band : bands_in(lay_out(figure, report_theme()))) EXPECT_TRUE(band.fill);
  figure.panels[0].layers.push_back(Band{.x = {0.0, 1.0}, .low = {0.5, 9.0}, .high = {1.0, 10.0}});
  std::vector<double> at;
  for (const Shape& band : bands_in(lay_out(figure, report_theme()))) {
    EXPECT_FALSE(band.fill);
    ASSERT_EQ(band.path.points.size(), 4U);  // Two bars.
    at.push_back(band.path.points[0].x);
  }
  ASSERT_EQ(at.size(), 4U);
  for (std::size_t i = 1; i < at.size(); ++i) EXPECT_GT(at[i], at[i - 1] + 1.5);
}

TEST(Bands, AreThinnerBarsInTheRoomOfTenWhereTheyAreMore) {
  const auto bars_of = [](int bands) {
    Figure figure = with_panels(1);
    for (int i = 0; i < bands; ++i)
      figure.panels[0].layers.push_back(
          Band{.x = {0.0, 1.0}, .low = {0.0, 0.0}, .high = {1.0, 1.0}});
    return bands_in(lay_out(figure, report_theme()));
  };
  const auto room = [](const std::vector<Shape>& bars) {
    return bars.back().path.points[0].x - bars.front().path.points[0].x;
  };
  const std::vector<Shape> ten = bars_of(10), twenty = bars_of(20);
  ASSERT_EQ(twenty.size(), 20U);
  for (const Shape& bar : twenty) EXPECT_EQ(bar.path.points.size(), 4U);  // At both points.
  EXPECT_LT(room(twenty), 1.1 * room(ten));
  EXPECT_NEAR(twenty[0].stroke->width, 0.5 * ten[0].stroke->width, 1e-9);
}

TEST(LayOut, LeavesTheFrameTwoThirdsOfAPageWithoutTitle) {
  const Figure figure = with_lines({1, 2, 3, 4, 5, 6, 7, 8}, "a name too long to stand beside, ");
  for (const double width_in : {3.25, 6.75}) {
    const Drawing drawing = lay_out(figure, paper_theme(width_in));
    EXPECT_GE(drawing.frames[0].height(), 0.65 * drawing.height);
    for (const std::string& flaw : flaws(drawing)) ADD_FAILURE() << flaw;
  }
}

}  // namespace
}  // namespace mapproof::test
