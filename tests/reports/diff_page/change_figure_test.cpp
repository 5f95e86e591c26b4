#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "render/output/write_figure.hpp"
#include "render/plot/axis_map.hpp"
#include "render/theme/theme.hpp"
#include "reports/diff/figures/change_figure.hpp"
#include "reports/diff/figures/figure_diff.hpp"
#include "reports/diff/folder_diff.hpp"
#include "reports/diff/item_images.hpp"
#include "reports/html/diff/diff_html.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

/// A line of ten landmarks, and a curve that does not change.
Figure landmarks() {
  Scatter points{.label = "map"};
  for (int i = 0; i < 10; ++i) {
    points.x.push_back(i);
    points.y.push_back(0.1 * i);
    points.marks.push_back({"l" + std::to_string(i), {{"landmark", "L" + std::to_string(i)}}});
  }
  const Polyline wall{.label = "wall", .x = {0.0, 9.0}, .y = {1.0, 0.0}};
  Figure figure;
  figure.id = "map";
  figure.title = "A map";
  figure.alt = "Ten landmarks.";
  Panel& panel = figure.panels.emplace_back();
  panel.x.label = "x [m]", panel.y.label = "y [m]";
  panel.layers = {wall, points};
  return figure;
}

Scatter& points_of(Figure& figure) { return std::get<Scatter>(figure.panels[0].layers[1]); }

/// The fourth landmark is elsewhere, within the limits of the others.
Figure moved() {
  Figure figure = landmarks();
  points_of(figure).y[3] = 0.8;
  return figure;
}

/// The last landmark is so far away that the limits of the axes shift.
Figure stretched() {
  Figure figure = landmarks();
  points_of(figure).y[9] = 2.5;
  return figure;
}

template <typename Kind>
std::vector<Kind> layers_of(const Panel& panel) {
  std::vector<Kind> found;
  for (const Layer& layer : panel.layers)
    if (const Kind* one = std::get_if<Kind>(&layer)) found.push_back(*one);
  return found;
}

/// The page on two folders with this figure, as mapproof writes it.
std::string page_of(const Figure& baseline, const Figure& current) {
  const TemporaryFolder folder;
  write_figure(baseline, report_theme(), OutputFolder(folder / "a"));
  write_figure(current, report_theme(), OutputFolder(folder / "b"));
  const DiffResult result = folder_diff(folder / "a", folder / "b");
  return diff_html(result, shown_images(result, {}), load_templates());
}

TEST(ChangeFigure, JoinsTheOldAndTheNewPositionOfWhatMovedAndNamesIt) {
  const auto figure = change_figure({landmarks(), moved()}, figure_diff(landmarks(), moved()));
  ASSERT_TRUE(figure);
  ASSERT_EQ(figure->panels.size(), 1U);
  const std::vector<Segments> moves = layers_of<Segments>(figure->panels[0]);
  ASSERT_EQ(moves.size(), 1U);
  EXPECT_EQ(moves[0].x0, std::vector{3.0});
  EXPECT_EQ(moves[0].x1, std::vector{3.0});
  EXPECT_DOUBLE_EQ(moves[0].y0[0], 0.1 * 3);
  EXPECT_EQ(moves[0].y1, std::vector{0.8});
  const std::vector<PointLabels> names = layers_of<PointLabels>(figure->panels[0]);
  ASSERT_EQ(names.size(), 1U);
  EXPECT_EQ(names[0].text, std::vector<std::string>{"L3"});
}

TEST(ChangeFigure, ShowsWhatIsEqualInGreyOnce) {
  const auto figure = change_figure({landmarks(), moved()}, figure_diff(landmarks(), moved()));
  ASSERT_TRUE(figure);
  const std::vector<Polyline> walls = layers_of<Polyline>(figure->panels[0]);
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_EQ(walls[0].colour, ThemeColour::kMuted);
  const std::vector<Scatter> both = layers_of<Scatter>(figure->panels[0]);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].label, "map, baseline");
  EXPECT_EQ(both[1].label, "map, current");
  EXPECT_EQ(walls[0].label, "wall") << "the legend names what is drawn";
}

TEST(ChangeFigure, ShowsNothingOfTheCurrentFigureInTheGreyOfTheBaseline) {
  const auto with_errors = [](double y) {
    Figure figure = landmarks();
    figure.panels[0].layers.emplace_back(
        Segments{.label = "error", .x0 = {1.0}, .y0 = {0.2}, .x1 = {1.0}, .y1 = {y}});
    return figure;
  };
  ASSERT_EQ(Segments{}.colour, ThemeColour::kMuted);
  const auto figure = change_figure({with_errors(0.4), with_errors(0.6)},
                                    figure_diff(with_errors(0.4), with_errors(0.6)));
  ASSERT_TRUE(figure);
  const std::vector<Segments> errors = layers_of<Segments>(figure->panels[0]);
  ASSERT_GE(errors.size(), 2U);
  EXPECT_EQ(errors[0].label, "error, baseline");
  EXPECT_EQ(errors[0].colour, ThemeColour::kMuted);
  EXPECT_EQ(errors[1].label, "error, current");
  EXPECT_NE(errors[1].colour, ThemeColour::kMuted);
}

TEST(ChangeFigure, OfEqualDataIsNone) {
  Figure titled = landmarks();
  titled.title = "Another title";
  EXPECT_FALSE(change_figure({landmarks(), titled}, figure_diff(landmarks(), titled)));
}

TEST(ChangeFigure, ShowsCellsByTheSizeOfTheirChange) {
  const auto with = [](double value) {
    Figure figure;
    figure.id = "cells";
    figure.title = "Cells";
    figure.panels.emplace_back().layers = {Cells{.x = {0, 2},
                                                 .y = {0, 1},
                                                 .columns = 2,
                                                 .values = {1.0, value},
                                                 .colour_scale = {.limits = {0, 9}}}};
    return figure;
  };
  const auto figure = change_figure({with(4.0), with(1.5)}, figure_diff(with(4.0), with(1.5)));
  ASSERT_TRUE(figure);
  const std::vector<Cells> cells = layers_of<Cells>(figure->panels[0]);
  ASSERT_EQ(cells.size(), 1U);
  EXPECT_EQ(cells[0].values, (std::vector{0.0, 2.5}));
}

TEST(ChangeFigure, OfRecordsShowsTheLandmarksThatMovedAndTheScoresOfTheRuns) {
  RecordDiff diff;
  PointsDiff& points = diff.points.emplace_back();
  points.record = "map";
  points.quantity = "landmark_m";
  PointMove& move = points.moves.emplace_back();
  move.name = "L1";
  move.current = {1, 1};
  move.moved = 1.4;
  Comparison comparison;
  comparison.subject = "bearing/isomap";
  comparison.label = {comparison.subject};
  comparison.quantity.label = "MPE";
  comparison.quantity.unit = "m";
  comparison.beyond = 2;
  comparison.pairs = 2;
  comparison.values = {{0.1, 0.2}, {0.2, 0.1}};
  comparison.outcome = Outcome::kChanged;
  diff.comparisons = {comparison};
  const auto figure = change_figure(diff);
  ASSERT_TRUE(figure);
  ASSERT_EQ(figure->panels.size(), 2U);
  EXPECT_EQ(layers_of<Segments>(figure->panels[0]).size(), 1U);
  EXPECT_EQ(figure->panels[1].x.label, "baseline: MPE [m]");
  const Scatter runs = layers_of<Scatter>(figure->panels[1])[0];
  EXPECT_EQ(runs.y, (std::vector{0.2, 0.1}));
  EXPECT_EQ(runs.label, "2 runs");
  EXPECT_FALSE(change_figure(RecordDiff{}));
}

TEST(ChangeFigure, OfRecordsIsInTheUnitOfTheirReport) {
  RecordDiff diff;
  Comparison& comparison = diff.comparisons.emplace_back();
  comparison.quantity = {.id = "scan_s", .label = "time per scan", .unit = "s"};
  comparison.beyond = 1;
  comparison.values = {{0.02, 0.04}};
  comparison.greatest_mean = 0.04;
  const auto figure = change_figure(diff);
  ASSERT_TRUE(figure);
  EXPECT_EQ(figure->panels[0].x.label, "baseline: time per scan [ms]");
  EXPECT_DOUBLE_EQ(layers_of<Scatter>(figure->panels[0])[0].y[0], 40.0);
}

TEST(ChangeFigure, LegendSaysHowManyOfTheRunsAreShown) {
  RecordDiff diff;
  Comparison& comparison = diff.comparisons.emplace_back();
  comparison.beyond = 2;
  comparison.pairs = 3;
  comparison.values = {{0.1, 0.2}, {0.2, 0.1}};
  const auto figure = change_figure(diff);
  ASSERT_TRUE(figure);
  EXPECT_EQ(layers_of<Scatter>(figure->panels[0])[0].label, "2 of 3 runs");
}

/// Errors drawn to the estimates, which a layer of their own draws again.
Figure with_errors(double shift) {
  Figure figure = landmarks();
  Scatter& points = points_of(figure);
  for (double& y : points.y) y += shift * (&y - points.y.data());
  Segments errors{.label = "error"};
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    errors.x0.push_back(points.x[i]), errors.y0.push_back(0.5);
    errors.x1.push_back(points.x[i]), errors.y1.push_back(points.y[i]);
    errors.marks.push_back({"e" + std::to_string(i), points.marks[i].data});
  }
  figure.panels[0].layers.insert(figure.panels[0].layers.begin() + 1, errors);
  return figure;
}

TEST(FigureDiff, CountsALandmarkOnceHoweverManyLayersDrawIt) {
  const std::string cause = judge(figure_diff(with_errors(0.0), with_errors(0.01))).cause;
  EXPECT_NE(cause.find(", 9 landmarks moved in all"), std::string::npos) << cause;
  const std::string page = page_of(with_errors(0.0), with_errors(0.01));
  const std::string moves = page.substr(page.find("id=\"table-moves-"), 20000);
  std::size_t rows = 0;
  const std::string body = moves.substr(0, moves.find("</table>"));
  for (std::size_t at = body.find("landmark L"); at != std::string::npos;
       at = body.find("landmark L", at + 1))
    ++rows;
  EXPECT_EQ(rows, 9U) << body;
  EXPECT_EQ(body.find("Where"), std::string::npos) << body;  // One place for all: a note has it.
  EXPECT_NE(moves.find("All are of scatter "), std::string::npos) << moves;
}

TEST(FigureDiff, CountsALandmarkWithinToleranceOnceHoweverManyLayersDrawIt) {
  Figure current = with_errors(0.0);
  auto& layers = current.panels[0].layers;
  std::get<Segments>(layers[1]).y1[3] += 1e-8;
  std::get<Scatter>(layers[2]).y[3] += 1e-8;
  const FigureDiff diff = figure_diff(with_errors(0.0), current);
  EXPECT_EQ(diff.moved, 0);
  EXPECT_EQ(diff.within, 1);
  EXPECT_EQ(diff.within_landmarks, 1);
}

TEST(FigureDiff, MeanErrorIsWithoutAnchors) {
  const auto with = [](const std::string& error, const std::string& of_anchor) {
    Figure figure = landmarks();
    points_of(figure).marks[0].data.emplace_back("error", of_anchor);
    points_of(figure).marks[1].data.emplace_back("error", error);
    figure.panels[0].layers.push_back(
        Scatter{.label = "anchor",
                .x = {0.0},
                .y = {0.0},
                .marks = {{"anchor-1", {{"landmark", "L0"}, {"kind", "anchor"}}}}});
    return figure;
  };
  const FigureDiff diff = figure_diff(with("0.1", "0.5"), with("0.2", "0.9"));
  EXPECT_EQ(diff.baseline_error, 0.1);
  EXPECT_EQ(diff.current_error, 0.2);
}

TEST(FigureDiff, CauseOfAMovementDoesNotRepeatItInTheWordsOfTheFigure) {
  Figure baseline = landmarks(), current = moved();
  baseline.alt = "Least 0.0861 at 2000.", current.alt = "Least 0.0990 at 2000.";
  EXPECT_EQ(judge(figure_diff(baseline, current)).cause.find("alternative text"),
            std::string::npos);
  current = landmarks();
  current.alt = "Least 0.0990 at 2000.";
  EXPECT_EQ(judge(figure_diff(baseline, current)).cause,
            "figure: alternative text Least 0.0861 at 2000 \u2192 Least 0.0990 at 2000");
}

TEST(DiffPage, GivesPositionsOfAMapWithUnitsAndEqualDecimals) {
  Figure baseline = landmarks(), current = landmarks();
  baseline.panels[0].equal_aspect = current.panels[0].equal_aspect = true;
  points_of(current).y[3] = -0.5;
  const std::string page = page_of(baseline, current);
  EXPECT_NE(page.find("(3.000, 0.300)\u00A0m"), std::string::npos);
  EXPECT_NE(page.find("(3.000, \u22120.500)\u00A0m"), std::string::npos);
}

TEST(DiffPage, GivesPointsOfACurveByItsNameAndWithThreeDigits) {
  const auto curve = [](double last) {
    Figure figure = landmarks();
    figure.panels[0].x.label = "observations";
    figure.panels[0].y.label = "MPE [m]";
    figure.panels[0].layers = {Polyline{.label = "ISOMAP",
                                        .x = {500.0, 2000.0},
                                        .y = {0.12, last},
                                        .mark = {"line-2-mean", {{"curve", "ISOMAP"}}}}};
    return figure;
  };
  const std::string page = page_of(curve(0.08609425000000001), curve(0.09900851));
  EXPECT_NE(page.find("point 2 of ISOMAP"), std::string::npos);
  EXPECT_EQ(page.find("line-2-mean of"), std::string::npos);
  EXPECT_NE(page.find("(2000, 0.0861\u00A0m)"), std::string::npos);
}

TEST(DiffPage, ReadsTheEscapesOfAMarkdownTable) {
  const TemporaryFolder folder;
  for (const auto& [side, value] : {std::pair{"a", "0.0861"}, {"b", "0.0990"}})
    write_file(folder / side / "tables" / "errors.md",
               std::string("| Method | Mean \\[m\\] |\n|---|---|\n| ISOMAP | ") + value + " |\n");
  const DiffResult result = folder_diff(folder / "a", folder / "b");
  ASSERT_EQ(result.items.size(), 1U);
  ASSERT_EQ(result.items[0].documents.size(), 1U);
  EXPECT_EQ(result.items[0].documents[0].first, "row 3 (ISOMAP), Mean [m]");
}

TEST(ChangeFigure, OfRecordsBeginsWithWhatGotWorse) {
  RecordDiff diff;
  for (const auto& [subject, outcome] :
       {std::pair("LPCA", Outcome::kChanged), std::pair("SDE", Outcome::kBetter),
        std::pair("ISOMAP", Outcome::kWorse)}) {
    Comparison comparison;
    comparison.label = {"bearing", subject};
    comparison.quantity = known_quantity("mpe_m");
    comparison.beyond = 1;
    comparison.values = {{0.1, 0.2}};
    comparison.outcome = outcome;
    diff.comparisons.push_back(comparison);
  }
  const auto figure = change_figure(diff);
  ASSERT_TRUE(figure);
  EXPECT_EQ(figure->panels.front().title, "ISOMAP");
  EXPECT_EQ(figure->panels.size(), 3U);
}

/// The titles of the panels of some comparisons, each under its label; that of the figure first.
std::vector<std::string> titles_of(const std::vector<SubjectLabel>& labels) {
  RecordDiff diff;
  for (const SubjectLabel& label : labels) {
    Comparison& comparison = diff.comparisons.emplace_back();
    comparison.label = label;
    comparison.quantity = known_quantity("mpe_m");
    comparison.beyond = 1;
    comparison.values = {{0.1, 0.2}};
    comparison.outcome = Outcome::kWorse;
  }
  const auto figure = change_figure(diff);
  std::vector<std::string> titles;
  if (!figure) return titles;
  titles.push_back(figure->title);
  for (const Panel& panel : figure->panels) titles.push_back(panel.title);
  return titles;
}

TEST(ChangeFigure, OfRecordsNamesOnceWhatAllPanelsShareAndInEachWhatDistinguishesIt) {
  const std::string method =
      "Graph SLAM with switchable constraints and dynamic covariance scaling";
  EXPECT_EQ(
      titles_of({{"indoors", method, "noise 0.1"},
                 {"outdoors", method, "noise 0.1"},
                 {"indoors", method, "noise 0.2"}}),
      (std::vector<std::string>{"What changed in the records: " + method, "indoors\nnoise 0.1",
                                "outdoors\nnoise 0.1", "indoors\nnoise 0.2"}));
  EXPECT_EQ(titles_of({{"indoors", "EKF"}}),
            (std::vector<std::string>{"What changed in the records: indoors, EKF", ""}));
  EXPECT_EQ(titles_of({{"a", "b"}, {"b", "a"}}),
            (std::vector<std::string>{"What changed in the records", "a\nb", "b\na"}));
}

TEST(CommonAxes, HoldWhatEitherFigureShows) {
  const auto both = on_common_axes({landmarks(), stretched()});
  ASSERT_TRUE(both);
  const PanelLimits a = panel_limits(both->first.panels[0]);
  const PanelLimits b = panel_limits(both->second.panels[0]);
  EXPECT_EQ(a.y, b.y);
  EXPECT_LE(a.y.low, 0.0);
  EXPECT_GE(a.y.high, 2.5);
  EXPECT_FALSE(on_common_axes({landmarks(), moved()})) << "their limits are equal";
}

TEST(CommonAxes, HaveNoTitlesAndNotesOverEachOther) {
  Figure baseline = landmarks(), current = moved();
  baseline.notes.push_back({.text = "MPE 0.1 m"});
  current.notes.push_back({.text = "MPE 0.2 m"});
  const auto both = on_common_axes({baseline, current});
  ASSERT_TRUE(both);
  for (const Figure& figure : {both->first, both->second}) EXPECT_TRUE(figure.notes.empty());
  EXPECT_EQ(on_common_axes({landmarks(), stretched()})->first.title, "A map");
}

TEST(ItemImages, HoldWhatMovedBesideAChangeOfData) {
  const TemporaryFolder folder;
  write_figure(landmarks(), report_theme(), OutputFolder(folder / "a"));
  write_figure(moved(), report_theme(), OutputFolder(folder / "b"));
  write_item_images(folder_diff(folder / "a", folder / "b"), {}, folder / "images");
  EXPECT_TRUE(read_file(folder / "images/map.change/difference.png").starts_with("\x89PNG"));
}

/// The share of changed pixels, as the page orders its items.
double share_on(const std::string& page) {
  const std::string key = "data-share=\"";
  return std::stod(page.substr(page.find(key) + key.size()));
}

TEST(DiffPage, ShowsWhatMovedBesideAChangeOfData) {
  const std::string page = page_of(landmarks(), moved());
  EXPECT_NE(page.find("<figure class=\"change\">"), std::string::npos);
  EXPECT_NE(page.find("alt=\"What changed of map\""), std::string::npos);
  // What few readers need is folded.
  for (const char* caption : {"Files, pixels and elements", "What changed in the SVG"}) {
    const std::size_t at = page.find(caption);
    ASSERT_NE(at, std::string::npos) << caption;
    EXPECT_NE(page.substr(at - 200, 200).find("<details class=\"fold\""), std::string::npos);
  }
}

TEST(DiffPage, ANarrowPageHasThePanelsOfWhatChangedInOneColumn) {
  const auto twice = [](Figure figure) {
    Panel& square = figure.panels[0];
    square.equal_aspect = true;
    square.x.limits = square.y.limits = Range{0.0, 9.0};
    Panel second = square;
    prefix_mark_ids(second, "b-");
    figure.panels.push_back(second);
    return figure;
  };
  const TemporaryFolder folder;
  write_figure(twice(landmarks()), report_theme(), OutputFolder(folder / "a"));
  write_figure(twice(moved()), report_theme(), OutputFolder(folder / "b"));
  const DiffResult result = folder_diff(folder / "a", folder / "b");
  const std::vector<ShownImages> shown = shown_images(result, {});
  ASSERT_EQ(shown.size(), 1U);
  ASSERT_TRUE(shown[0].change && shown[0].narrow_change);
  const ImageSize wide = *shown[0].change->size, narrow = *shown[0].narrow_change->size;
  EXPECT_EQ(wide.width, 800);
  EXPECT_GT(wide.width, wide.height);
  EXPECT_LT(1.5 * narrow.width, narrow.height);
  EXPECT_GE(345.0 / narrow.width * report_theme().tick_font_pt * 96.0 / 72.0, 9.99)
      << "px of words";
  const std::string page = diff_html(result, shown, load_templates());
  EXPECT_NE(page.find("<source media=\"(max-width: 37rem)\" srcset=\"data:image/svg+xml;base64,"),
            std::string::npos);
}

TEST(DiffPage, AShiftOfLimitsDoesNotDrownTheHeatMap) {
  const std::string page = page_of(landmarks(), stretched());
  EXPECT_NE(page.find("values drawn on common axes"), std::string::npos);
  const double share = share_on(page);
  EXPECT_GT(share, 0.0);
  EXPECT_LT(share, 0.01) << "of the pixels: two markers and a legend that found another place";
  EXPECT_NE(page.find("% of pixels</span>"), std::string::npos) << "the list says of what it is";
}

}  // namespace
}  // namespace mapproof::test
