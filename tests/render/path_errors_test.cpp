#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "render/figures/error_ramp.hpp"
#include "render/figures/maps/path_errors.hpp"
#include "render/plot/layout.hpp"
#include "render/plot/outlines.hpp"
#include "render/svg/svg.hpp"
#include "render/theme/palette.hpp"
#include "render/theme/theme.hpp"

namespace mapproof::test {
namespace {

const PanelMap kUnit{AxisMap(Scale::kLinear, {0, 1}, 0, 1), AxisMap(Scale::kLinear, {0, 1}, 0, 1)};

std::size_t lines_in(const Shape& shape) {
  return static_cast<std::size_t>(std::ranges::count(shape.path.commands, PathCommand::kLine));
}

/// Straight on, a metre at a time, with that error to the left.
PoseErrors straight(const std::vector<double>& errors_m) {
  const auto n = static_cast<Eigen::Index>(errors_m.size());
  PoseErrors poses;
  poses.time_s = poses.distance_m = Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1));
  poses.error_m = Eigen::Map<const Eigen::VectorXd>(errors_m.data(), n);
  poses.ground_truth_m = poses.estimate_m = SpacePoints::Zero(n, 3);
  poses.ground_truth_m.col(0) = poses.estimate_m.col(0) = poses.distance_m;
  poses.estimate_m.col(1) = poses.error_m;
  return poses;
}

TEST(ColouredLine, HasAStrokePerShadeWithTheGreatestOnTop) {
  const Polyline line{.x = {0, 1, 2, 3, 4},
                      .y = {0, 0, 0, 0, 0},
                      .values = {0.0, 9.0, 0.0, 0.0, 0.0},
                      .colour_scale = {.limits = {0.0, 9.0}, .ramp = Ramp::kViridis}};
  const std::vector<Shape> shapes = coloured_line_shapes(line, kUnit, report_theme());
  ASSERT_EQ(shapes.size(), 3U);
  EXPECT_EQ(lines_in(shapes[0]), 4U) << "the rim";
  EXPECT_GT(shapes[0].stroke->width, shapes[1].stroke->width);
  // A piece has the greater value of its ends, so that a single peak can be seen.
  EXPECT_EQ(lines_in(shapes[1]), 2U);
  EXPECT_EQ(lines_in(shapes[2]), 2U);
  EXPECT_EQ(bounds(shapes[2].path).x1, 2.0);
  EXPECT_EQ(shapes[2].stroke->colour, viridis(1.0));
  EXPECT_TRUE(shapes[2].stroke->is_round);
}

TEST(ColouredLine, OfManyValuesHas64Strokes) {
  Polyline line{.colour_scale = {.limits = {0.0, 999.0}}};
  for (int i = 0; i < 1000; ++i) {
    line.x.push_back(i);
    line.y.push_back(i % 7);
    line.values.push_back(i);
  }
  const std::vector<Shape> shapes = coloured_line_shapes(line, kUnit, report_theme());
  EXPECT_EQ(shapes.size(), 65U);
  std::size_t lines = 0;
  for (const Shape& shape : shapes) lines += lines_in(shape);
  EXPECT_EQ(lines, 2U * 999U);
}

TEST(ColouredLine, IsBrokenByWhatIsMissingAndShowsAPointAloneAsADot) {
  const Polyline line{.x = {0, 1, NAN, 3, 4, 5},
                      .y = {0, 0, 0, 0, 0, 0},
                      .values = {1, 1, 1, 1, NAN, 1},
                      .colour_scale = {.limits = {0.0, 1.0}}};
  const std::vector<Shape> shapes = coloured_line_shapes(line, kUnit, report_theme());
  ASSERT_EQ(shapes.size(), 2U);
  const std::vector<Point> expected = {{0, 0}, {1, 0}, {3, 0}, {3, 0}, {5, 0}, {5, 0}};
  ASSERT_EQ(shapes[1].path.points.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(shapes[1].path.points[i].x, expected[i].x) << i;
}

TEST(PathErrorMap, ShowsTheEstimateInTheColoursOfItsErrorsOverAThinGroundTruth) {
  const PoseErrors good = straight({0.1, 0.2, 0.3}), bad = straight({0.5, 2.0, 0.5});
  const PathErrorsSpec spec{"errors", "Errors", {{"good", &good}, {"bad", &bad}}, {}};
  const Figure figure = path_error_map_figure(spec, 0);
  ASSERT_EQ(figure.panels.size(), 1U);
  EXPECT_TRUE(figure.panels[0].equal_aspect);
  const auto& ground_truth = std::get<Polyline>(figure.panels[0].layers.at(0));
  const auto& estimate = std::get<Polyline>(figure.panels[0].layers.at(1));
  EXPECT_EQ(ground_truth.colour, ThemeColour::kMuted);
  EXPECT_EQ(ground_truth.y, (std::vector<double>{0.0, 0.0, 0.0}));
  EXPECT_LT(ground_truth.width, estimate.width);
  EXPECT_EQ(estimate.y, (std::vector<double>{0.1, 0.2, 0.3}));
  EXPECT_EQ(estimate.values, estimate.y);
  EXPECT_EQ(estimate.colour_scale.limits, (Range{0.0, 2.0})) << "the scale of all methods";
  EXPECT_EQ(estimate.colour_scale.bar_label, "error [m]");
}

TEST(PathErrorMap, OfALongPathHas2000PointsAmongThemTheOneWithTheGreatestError) {
  std::vector<double> errors_m(30'000, 0.1);
  errors_m[12'345] = 4.0;
  const PoseErrors poses = straight(errors_m);
  const Figure figure = path_error_map_figure({"errors", "Errors", {{"long", &poses}}, {}}, 0);
  const auto& estimate = std::get<Polyline>(figure.panels[0].layers.at(1));
  EXPECT_LE(estimate.x.size(), 2001U);
  EXPECT_GE(estimate.x.size(), 1990U);
  const auto greatest = std::ranges::max_element(estimate.values);
  EXPECT_EQ(*greatest, 4.0);
  EXPECT_EQ(estimate.x[static_cast<std::size_t>(greatest - estimate.values.begin())], 12'345.0);
  EXPECT_LT(to_svg(lay_out(figure, report_theme())).size(), 100'000U);
}

TEST(PathErrorMap, IsBrokenByAGap) {
  PoseErrors poses = straight(std::vector<double>(40, 0.1));
  poses.distance_m.tail(20).array() += 500.0;
  const Figure figure = path_error_map_figure({"errors", "Errors", {{"gap", &poses}}, {}}, 0);
  const auto& estimate = std::get<Polyline>(figure.panels[0].layers.at(1));
  ASSERT_EQ(estimate.x.size(), 41U);
  EXPECT_TRUE(std::isnan(estimate.x[20]));
  EXPECT_TRUE(std::isnan(estimate.values[20]));
}

/// Of both halves of a drive, 20 poses each, 500 s and 500 m apart.
PoseErrors with_a_gap() {
  PoseErrors poses = straight(std::vector<double>(40, 0.1));
  poses.time_s.tail(20).array() += 500.0;
  poses.distance_m.tail(20).array() += 500.0;
  poses.ground_truth_m.col(0) = poses.estimate_m.col(0) = poses.distance_m;
  return poses;
}

/// One every second, along x.
LonePoses lone_poses(double from_s, Eigen::Index n) {
  LonePoses alone{Eigen::VectorXd::LinSpaced(n, from_s, from_s + static_cast<double>(n - 1)),
                  SpacePoints::Zero(n, 3)};
  alone.positions_m.col(0) = alone.time_s;
  return alone;
}

TEST(PathErrorMap, HasTheWholeGroundTruthAlsoWhereTheEstimateHasAGap) {
  PoseErrors poses = with_a_gap();
  poses.ground_truth_alone = lone_poses(20.0, 500);
  const Figure figure = path_error_map_figure({"errors", "Errors", {{"gap", &poses}}, {}}, 0);
  ASSERT_EQ(figure.panels[0].layers.size(), 2U);
  const auto& ground_truth = std::get<Polyline>(figure.panels[0].layers[0]);
  ASSERT_EQ(ground_truth.x.size(), 540U);
  for (std::size_t i = 0; i < 540; ++i)
    EXPECT_NEAR(ground_truth.x[i], static_cast<double>(i), 1e-9);
  const auto& estimate = std::get<Polyline>(figure.panels[0].layers[1]);
  EXPECT_TRUE(std::isnan(estimate.x[20]));
}

TEST(PathErrorMap, HasTheEstimateAlsoWhereTheGroundTruthHasAGap) {
  PoseErrors poses = with_a_gap();
  poses.estimate_alone = lone_poses(20.0, 500);
  poses.ground_truth_alone = lone_poses(540.0, 9);
  const Figure figure = path_error_map_figure({"errors", "Errors", {{"gap", &poses}}, {}}, 0);
  ASSERT_EQ(figure.panels[0].layers.size(), 3U);
  const auto& ground_truth = std::get<Polyline>(figure.panels[0].layers[0]);
  EXPECT_TRUE(std::isnan(ground_truth.x[20])) << "it has no pose there";
  const auto& alone = std::get<Polyline>(figure.panels[0].layers[1]);
  EXPECT_EQ(alone.label, "without ground truth");
  ASSERT_EQ(alone.x.size(), 502U) << "with an associated pose at either end";
  EXPECT_NEAR(alone.x.front(), 19.0, 1e-9);
  EXPECT_NEAR(alone.x.back(), 520.0, 1e-9);
}

TEST(PathErrorMap, HasNoLineOfPosesBetweenAssociatedOnes) {
  PoseErrors poses = straight(std::vector<double>(40, 0.1));
  poses.estimate_alone = lone_poses(0.5, 39);
  const Figure figure = path_error_map_figure({"errors", "Errors", {{"gap", &poses}}, {}}, 0);
  EXPECT_EQ(figure.panels[0].layers.size(), 2U);
}

TEST(PathErrorCurves, AreBrokenByAPause) {
  PoseErrors poses = straight(std::vector<double>(40, 0.1));
  poses.has_times = true;
  const auto breaks = [&] {
    const Figure figure = path_error_curves_figure({"errors", "Errors", {{"gap", &poses}}, {}});
    std::vector<std::ptrdiff_t> found;
    for (const Panel& panel : figure.panels) {
      const std::vector<double>& y = std::get<Polyline>(panel.layers.at(0)).y;
      found.push_back(std::ranges::count_if(y, [](double value) { return std::isnan(value); }));
    }
    found.push_back(figure.caption.find("broken") == std::string::npos ? 0 : 1);
    return found;
  };
  poses.time_s.tail(20).array() += 9.0;  // Ten steps.
  EXPECT_EQ(breaks(), (std::vector<std::ptrdiff_t>{0, 0, 0}));
  poses.time_s.tail(20).array() += 0.5;
  EXPECT_EQ(breaks(), (std::vector<std::ptrdiff_t>{1, 1, 1}));
  poses.has_times = false;
  EXPECT_EQ(breaks(), (std::vector<std::ptrdiff_t>{0, 0, 0}));
}

TEST(PathErrorCurves, OfManyPosesAreMediansOverTheErrorsOfEach) {
  std::vector<double> errors_m(800, 0.1);
  for (std::size_t i = 0; i < errors_m.size(); i += 5) errors_m[i] = 0.9;  // Never in the majority.
  const PoseErrors many = straight(errors_m), few = straight(std::vector<double>(159, 0.4));
  const Figure figure =
      path_error_curves_figure({"errors", "Errors", {{"many", &many}, {"few", &few}}, {}});
  for (const Panel& panel : figure.panels) {
    ASSERT_EQ(panel.layers.size(), 3U);
    const auto& behind = std::get<Polyline>(panel.layers[0]);
    EXPECT_EQ(behind.colour, ThemeColour::kMuted);
    EXPECT_LT(behind.width, 0.5);
    EXPECT_EQ(std::ranges::max(behind.y), 0.9) << "no peak is lost";
    const auto& medians = std::get<Polyline>(panel.layers[1]);
    EXPECT_EQ(medians.y, std::vector<double>(80, 0.1));
    EXPECT_GT(std::get<Polyline>(panel.layers[2]).y.size(), 100U) << "too few for medians";
  }
  EXPECT_NE(figure.caption.find("the median in each of 80 equal pieces"), std::string::npos);
  EXPECT_NE(figure.caption.find("fewer than 160 poses"), std::string::npos);
}

TEST(Layout, APageEndsBelowAMapThatIsWiderThanHigh) {
  Figure figure;
  figure.id = "wide";
  figure.panels.resize(1);
  figure.panels[0].equal_aspect = true;
  figure.panels[0].x.label = "x [m]";
  figure.panels[0].layers.emplace_back(Polyline{.x = {0, 40}, .y = {0, 16}});
  const Theme theme = report_theme();
  const Drawing drawing = lay_out(figure, theme);
  EXPECT_LT(drawing.height, theme.height_pt);
  // Below the frame: ticks, the axis' label and the margin.
  EXPECT_LT(drawing.height - drawing.frames[0].y1, 5.0 * theme.font_pt);
  EXPECT_GT(drawing.frames[0].width(), 0.8 * theme.width_pt);
  figure.panels[0].equal_aspect = false;
  EXPECT_EQ(lay_out(figure, theme).height, theme.height_pt);
}

TEST(ErrorRamp, EndsAtThe95thPercentileOfWhatIsFinite) {
  std::vector<double> errors_m;
  for (int i = 0; i <= 100; ++i) errors_m.push_back(100 - i);
  errors_m.insert(errors_m.end(), {NAN, INFINITY});
  EXPECT_EQ(end_of_error_ramp(errors_m), 95.0);
  EXPECT_EQ(end_of_error_ramp({NAN}), 1e-6);
  EXPECT_EQ(end_of_error_ramp({0.0}), 1e-6);
  EXPECT_EQ(error_ramp_text(0.1234), "0 to 0.12 m or more");
}

}  // namespace
}  // namespace mapproof::test
