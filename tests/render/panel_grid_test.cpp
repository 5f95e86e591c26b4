#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "render/plot/figure_json.hpp"
#include "render/plot/layout.hpp"
#include "render/plot/outlines.hpp"
#include "tests/support/images/figure_checks.hpp"

namespace mapproof::test {
namespace {

Figure grid(std::size_t count, bool shared) {
  Figure figure;
  figure.id = "grid";
  figure.title = "A grid";
  figure.columns = 5;
  figure.shared_x = figure.shared_y = shared;
  for (std::size_t i = 0; i < count; ++i) {
    Panel& panel = figure.panels.emplace_back();
    panel.title = "panel " + std::to_string(i + 1);
    panel.x.label = "x";
    panel.y.label = "y";
    const double end = static_cast<double>(i + 1);
    panel.layers.push_back(Polyline{.label = "line", .x = {0.0, end}, .y = {0.0, end}});
  }
  return figure;
}

std::size_t count_of(const Drawing& drawing, ItemClass item_class) {
  return static_cast<std::size_t>(std::ranges::count(drawing.items, item_class, &Item::item_class));
}

/// A figure with one layer of each kind of area.
Figure of_areas() {
  Figure figure;
  figure.id = "areas";
  Panel& panel = figure.panels.emplace_back();
  panel.layers = {
      Cells{.label = "cells", .x = {0, 2}, .y = {0, 2}, .columns = 2, .values = {0, 1, 1, NAN}},
      Area{.label = "area", .x = {3, 4, 4, NAN}, .y = {0, 0, 1, NAN}, .outlined = true},
      Ellipses{
          .x = {3}, .y = {2}, .a = {1}, .b = {0.5}, .rotation_rad = {0.5}, .fill = Fill::kTint},
      Texts{.x = {0}, .y = {3}, .text = {"a text that is quite long"}, .align = Align::kEnd}};
  return figure;
}

TEST(PanelGrid, FramesOfSharedAxesHaveOneSizeAndStandInLine) {
  const Drawing drawing = lay_out(grid(10, true), report_theme());
  ASSERT_EQ(drawing.frames.size(), 10u);
  const Box first = drawing.frames[0];
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(drawing.frames[i].width(), first.width(), 1e-9);
    EXPECT_NEAR(drawing.frames[i].height(), first.height(), 1e-9);
    EXPECT_NEAR(drawing.frames[i].x0, drawing.frames[i % 5].x0, 1e-9);
  }
  EXPECT_GT(drawing.frames[5].y0, first.y1);
  EXPECT_EQ(count_of(drawing, ItemClass::kAxisLabel), 2u);
  EXPECT_EQ(count_of(drawing, ItemClass::kLegendText), 1u);
}

TEST(PanelGrid, SharedAxesHaveTheSameLimits) {
  const Drawing drawing = lay_out(grid(2, true), report_theme());
  std::vector<Point> ends;
  for (const Item& item : drawing.items)
    if (item.item_class == ItemClass::kLine)
      ends.push_back(std::get<Shape>(item.what).path.points[1]);
  ASSERT_EQ(ends.size(), 2u);
  const double first = (ends[0].x - drawing.frames[0].x0) / drawing.frames[0].width();
  const double second = (ends[1].x - drawing.frames[1].x0) / drawing.frames[1].width();
  EXPECT_NEAR((first - 0.05 / 1.1) * 2.0, second - 0.05 / 1.1, 1e-9);
}

TEST(PanelGrid, HasFewerColumnsOnANarrowPage) {
  const Drawing wide = lay_out(grid(10, true), report_theme());
  const Drawing narrow = lay_out(grid(10, true), paper_theme(3.25));
  EXPECT_NEAR(wide.frames[4].y0, wide.frames[0].y0, 1e-9);
  EXPECT_GT(narrow.frames[4].y0, narrow.frames[0].y0);
  EXPECT_GT(narrow.height, paper_theme(3.25).height_pt);
}

TEST(PanelGrid, HasALegendOnceOfPanelsWithTheSameNames) {
  const auto legend_texts = [](const std::string& other) {
    Figure figure = grid(2, false);
    std::get<Polyline>(figure.panels[1].layers[0]).label = other;
    return count_of(lay_out(figure, report_theme()), ItemClass::kLegendText);
  };
  EXPECT_EQ(legend_texts("line"), 1U);
  EXPECT_EQ(legend_texts("another line"), 2U);
}

/// Maps of one world.
Figure wall(std::size_t count, const std::string& title, double height_m) {
  Figure figure = grid(count, true);
  for (Panel& panel : figure.panels) {
    panel.equal_aspect = true;
    panel.title = title;
    panel.layers = {Scatter{.label = "landmark", .x = {0.0, 2.0}, .y = {0.0, height_m}}};
  }
  return figure;
}

void expect_two_thirds(const Figure& figure) {
  const Drawing drawing = lay_out(figure, paper_theme(3.25));
  double frames = 0.0, end = 0.0;
  for (const Box& frame : drawing.frames) {
    frames += std::max(0.0, frame.y1 - std::max(frame.y0, end));
    end = std::max(end, frame.y1);
  }
  EXPECT_GE(frames, 0.65 * drawing.height);
  EXPECT_LE(drawing.height, 9.5 * 72.0);
  for (const std::string& flaw : flaws(drawing)) ADD_FAILURE() << flaw;
}

TEST(PanelGrid, GivesMapsTwoThirdsOfTheHeightOfAPrintedPage) {
  for (const std::size_t count : {2U, 3U, 4U, 10U, 11U}) {
    SCOPED_TRACE(count);
    expect_two_thirds(wall(count, "panel\nMPE 0.1 m", 1.7));
  }
}

TEST(PanelGrid, GivesThemAsMuchBelowLongTitles) {
  for (const double height_m : {2.2, 2.7, 3.2}) {
    SCOPED_TRACE(height_m);
    expect_two_thirds(wall(9, "Range and bearing\nCMDS (not usable)\nMPE 22.7 m", height_m));
  }
}

TEST(PanelGrid, SaysOnceWhatEqualAxesShow) {
  const auto labels_of_x = [](double end) {
    Figure figure = grid(4, false);
    figure.shared_y = true;
    for (Panel& panel : figure.panels)
      panel.layers = {Polyline{.label = "line", .x = {1e6, end}, .y = {0.0, 1.0}}};
    std::get<Polyline>(figure.panels[1].layers[0]).x[1] = 5e6;
    std::vector<std::string> labels;
    for (const Item& item : lay_out(figure, report_theme()).items)
      if (const auto* text = std::get_if<TextLine>(&item.what);
          text != nullptr && item.item_class == ItemClass::kAxisLabel && !text->upward)
        labels.push_back(text->shaped.text);
    return labels;
  };
  const std::vector<std::string> of_equal = labels_of_x(5e6);
  ASSERT_EQ(of_equal.size(), 1U);
  EXPECT_EQ(of_equal[0].substr(0, 2), "x ") << "and the factor of their ticks";
  EXPECT_EQ(labels_of_x(4e6).size(), 4U);
}

TEST(PanelGrid, HasTheEntriesOfALegendInFewRowsOnPaper) {
  Figure figure = grid(1, false);
  figure.panels[0].layers.clear();
  Scatter everywhere;  // No legend has room inside the frame.
  for (int i = 0; i < 100; ++i) {
    everywhere.x.push_back(i % 10);
    everywhere.y.push_back(i / 10);
  }
  for (const char* label : {"short", "one with a longer name", "tiny", "a third one, longer"}) {
    everywhere.label = label;
    figure.panels[0].layers.emplace_back(everywhere);
  }
  std::set<double> rows;
  const Drawing drawing = lay_out(figure, paper_theme(3.25));
  for (const Item& item : drawing.items)
    if (item.item_class == ItemClass::kLegendText)
      rows.insert(std::round(std::get<TextLine>(item.what).at.y));
  EXPECT_EQ(rows.size(), 2U);
  for (const std::string& flaw : flaws(drawing)) ADD_FAILURE() << flaw;
}

TEST(PanelGrid, IsCleanInEveryTheme) {
  for (const bool shared : {true, false})
    for (const std::size_t count : {2u, 3u, 7u, 10u})
      for (const Theme& theme : {report_theme(), paper_theme(3.25), paper_theme(6.75)})
        for (const std::string& flaw : flaws(lay_out(grid(count, shared), theme)))
          ADD_FAILURE() << count << ' ' << theme.name << ": " << flaw;
}

TEST(PanelGrid, ArrowsStandBetweenTheirPanels) {
  Figure figure = grid(3, false);
  figure.arrows = {{0, "observe"}, {1, "embed"}};
  for (const Theme& theme : {report_theme(), paper_theme(3.25)}) {
    const Drawing drawing = lay_out(figure, theme);
    EXPECT_EQ(count_of(drawing, ItemClass::kPanelArrowLabel), 2u);
    EXPECT_EQ(count_of(drawing, ItemClass::kPanelArrow), 4u);
    for (const std::string& flaw : flaws(drawing)) ADD_FAILURE() << theme.name << ": " << flaw;
  }
}

TEST(PanelGrid, AnArrowNeedsAPanelToPointTo) {
  Figure figure = grid(2, false);
  figure.arrows = {{1, "nowhere"}};
  EXPECT_EQ(problem(figure), "arrows/0/from: no panel follows");
}

TEST(PanelGrid, PanelsOfDifferentScalesShareNoAxis) {
  Figure figure = grid(2, true);
  figure.panels[1].y.scale = Scale::kLog;
  EXPECT_NE(problem(figure), "");
}

TEST(Areas, RoundTripThroughJson) {
  const Figure figure = of_areas();
  EXPECT_EQ(figure_to_json(figure_from_json(figure_to_json(figure), "f")), figure_to_json(figure));
}

TEST(Areas, RefuseWhatCannotBeDrawn) {
  const auto refuses = [](auto change) {
    Figure figure = of_areas();
    change(figure.panels[0]);
    EXPECT_NE(problem(figure), "");
  };
  refuses([](Panel& p) { std::get<Cells>(p.layers[0]).values.pop_back(); });
  refuses([](Panel& p) { std::get<Cells>(p.layers[0]).x = {1.0, 1.0}; });
  refuses([](Panel& p) { std::get<Area>(p.layers[1]).y.pop_back(); });
  refuses([](Panel& p) { std::get<Ellipses>(p.layers[2]).a[0] = -1.0; });
  refuses([](Panel& p) { std::get<Ellipses>(p.layers[2]).rotation_rad.clear(); });
  refuses([](Panel& p) { std::get<Texts>(p.layers[3]).text.clear(); });
  refuses([](Panel& p) { p.x.scale = Scale::kLog; });
}

TEST(Areas, TextsOverTheSideOfTheFrameHaveRoom) {
  Figure figure = of_areas();
  figure.panels[0].bare = true;
  const Drawing drawing = lay_out(figure, report_theme());
  for (const std::string& flaw : flaws(drawing)) ADD_FAILURE() << flaw;
}

TEST(Areas, EveryShadeOfCellsCoversThoseAboveIt) {
  const Cells cells{.x = {0, 3}, .y = {0, 1}, .columns = 3, .values = {0.0, 0.5, 1.0}};
  const PanelMap map{AxisMap(Scale::kLinear, {0, 3}, 0, 30),
                     AxisMap(Scale::kLinear, {0, 1}, 10, 0)};
  const auto shapes = cell_shapes(cells, map, report_theme());
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_EQ(bounds(shapes[0].path).x0, 0.0);
  EXPECT_EQ(bounds(shapes[1].path).x0, 10.0);
  EXPECT_EQ(bounds(shapes[2].path).x0, 20.0);
  for (const Shape& shape : shapes) EXPECT_EQ(bounds(shape.path).x1, 30.0);
}

}  // namespace
}  // namespace mapproof::test
