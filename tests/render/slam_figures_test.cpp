#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "render/figures/curves/convergence.hpp"
#include "render/figures/curves/log_log.hpp"
#include "render/figures/curves/refinement_starts.hpp"
#include "render/figures/curves/spectrum.hpp"
#include "render/figures/maps/map_grid.hpp"
#include "tests/support/samples/drawn_panels.hpp"
#include "tests/support/samples/sample_comparisons.hpp"
#include "tests/support/samples/sample_slam.hpp"

namespace mapproof::test {
namespace {

ConvergenceCurve white() { return sample_convergence("white", "white noise", 1.0); }

/// Slope of a drawn line in the logarithms of both axes, from end to end.
double drawn_slope(const Polyline& line) {
  return std::log(line.y.back() / line.y.front()) / std::log(line.x.back() / line.x.front());
}

TEST(LogLogSlope, IsThePowerOfAPowerLaw) {
  EXPECT_NEAR(log_log_slope({1, 10, 100}, {5, 0.5, 0.05}), -1.0, 1e-12);
  EXPECT_NEAR(log_log_slope({1, 4, NAN, 9}, {2, 16, 7, 54}), 1.5, 1e-12);
  EXPECT_TRUE(std::isnan(log_log_slope({3, 3}, {1, 2})));
  EXPECT_TRUE(std::isnan(log_log_slope({1, 2}, {0, -1})));
}

TEST(ConvergenceFigure, StandsOverMeasurementsWithTheLandmarksBeside) {
  const Figure figure = convergence_figure("fig-1b", white());
  ASSERT_EQ(figure.panels.size(), 2u);
  for (const Panel& panel : figure.panels) {
    EXPECT_EQ(panel.x.scale, Scale::kLog);
    EXPECT_EQ(panel.y.scale, Scale::kLog);
    const Polyline line = labelled<Polyline>(panel, "measured").value();
    EXPECT_EQ(line.x.front(), 50.0 * 6);
    EXPECT_EQ(line.x.back(), 5000.0 * 6);
    EXPECT_NEAR(drawn_slope(labelled<Polyline>(panel, "slope \u22121/2").value()), -0.5, 1e-12);
  }
  EXPECT_TRUE(contains(figure.caption, "1000 random pairs")) << figure.caption;
  EXPECT_TRUE(contains(figure.caption, "\u22120.50 and \u22120.50")) << figure.caption;
}

TEST(ConvergenceFigure, DrawsThe95PercentBars) {
  const Panel panel = convergence_figure("fig-1b", white()).panels[0];
  const auto bars = layers_of<Segments>(panel);
  ASSERT_EQ(bars.size(), 1u);
  const double mean = white().points[0].observation.mean;
  EXPECT_NEAR(bars[0].y0[0], 0.94 * mean, 1e-12);
  EXPECT_NEAR(bars[0].y1[0], 1.06 * mean, 1e-12);
}

TEST(ConvergenceFigure, EndsABarThatReachesZeroInAnArrowAndLeavesUnknownPointsOut) {
  ConvergenceCurve curve = white();
  curve.points[2].observation.half_width = 2.0 * curve.points[2].observation.mean;
  curve.points[4].observation = {};
  EXPECT_FALSE(contains(convergence_figure("fig-1b", white()).caption, "arrows"));
  EXPECT_TRUE(contains(convergence_figure("fig-1b", curve).caption,
                       "bars: 95 % intervals; arrows: those that reach below the frame"));
  const Panel panel = convergence_figure("fig-1b", curve).panels[0];
  const auto bars = layers_of<Segments>(panel);
  ASSERT_EQ(bars.size(), 2u);
  EXPECT_EQ(bars[0].y0.size(), curve.points.size() - 2);
  EXPECT_TRUE(bars[1].arrow);
  EXPECT_EQ(bars[1].y1, std::vector<double>{panel.y.limits->low});
  EXPECT_EQ(labelled<Polyline>(panel, "measured")->x.size(), curve.points.size() - 1);
}

TEST(SubspaceAngleFigure, HasTheBoundBesideTheMeasuredSine) {
  const Figure figure = subspace_angle_figure("angle-simulation", white());
  const Polyline bound = labelled<Polyline>(figure.panels[0], "bound, eq. 5").value();
  EXPECT_EQ(bound.dash, Dash::kDashed);
  EXPECT_EQ(bound.y[3], white().points[3].bound);
}

TEST(PositionsFigure, TellsThatTheMapConvergesWhilePositionsDoNot) {
  const Panel panel = positions_figure("positions-simulation", white()).panels[0];
  EXPECT_NEAR(drawn_slope(*labelled<Polyline>(panel, "landmarks")), -0.5, 1e-9);
  EXPECT_GT(drawn_slope(*labelled<Polyline>(panel, "robot\u2019s positions")), -0.2);
}

TEST(NoiseModelsFigure, HasALineForEachModelInBothPanels) {
  const std::vector<ConvergenceCurve> curves = {white(),
                                                sample_convergence("c", "correlated", 2.0)};
  const Figure figure = noise_models_figure("noise-simulation", curves);
  for (const Panel& panel : figure.panels) EXPECT_TRUE(labelled<Polyline>(panel, "correlated"));
  EXPECT_EQ(figure.record_ids, (std::vector<std::string>{"convergence/white", "convergence/c"}));
}

TEST(NoiseModelsFigure, ComparesNoiseOfOneAmplitude) {
  const auto curve = [](const char* id, const char* title, double error_m) {
    ConvergenceCurve one = sample_convergence(id, title, 1.0);
    for (ConvergencePoint& point : one.points) point.landmarks_m.mean = error_m;
    return one;
  };
  const ConvergenceCurve strong = curve("a", "correlated noise, 1 % of the range, 0.9", 0.4),
                         even = curve("b", "white noise, 1 % of the range", 0.1),
                         other = curve("c", "white noise, 0.1 m", 0.05);
  EXPECT_EQ(noise_models_figure("noise", std::vector{strong, even, other}).title,
            "Correlated noise makes landmarks err 4.0 times as much as white noise");
  EXPECT_EQ(noise_models_figure("noise", std::vector{strong, other}).title,
            "Convergence under other noise");
}

TEST(FactorizationCostFigure, GroupsByLandmarksAndByStepsAndVaries) {
  const Figure figure = factorization_cost_figure("factorization-cost", sample_factorization());
  EXPECT_TRUE(figure.varies);
  const Polyline steps = labelled<Polyline>(figure.panels[0], "N = 300").value();
  EXPECT_EQ(steps.x, (std::vector<double>{1e3, 1e4, 1e5}));
  const Polyline landmarks = labelled<Polyline>(figure.panels[1], "T = 100,000").value();
  EXPECT_EQ(landmarks.x, (std::vector<double>{10, 30, 100, 300}));
  EXPECT_NEAR(drawn_slope(*labelled<Polyline>(figure.panels[1], "slope 2")), 2.0, 1e-12);
}

TEST(FactorizationCostFigure, MakesNoLineOfOnePoint) {
  const std::vector<FactorizationCost> costs = {{6, 1000, 0.1}, {6, 2000, 0.2}, {12, 1000, 0.4}};
  const Figure figure = factorization_cost_figure("factorization-cost", costs);
  EXPECT_TRUE(labelled<Polyline>(figure.panels[0], "N = 6"));
  EXPECT_FALSE(labelled<Polyline>(figure.panels[0], "N = 12"));
}

TEST(SingularValuesFigure, FillsThoseKeptAndDrawsTheFloorThatIsKnown) {
  const Figure figure =
      singular_values_figure({"spectrum-plaza-1", "", {{"4-D", {100, 50, 20, 8, 2}, 4, 1.0}}, {}});
  const Panel& panel = figure.panels[0];
  EXPECT_EQ(labelled<Scatter>(panel, "kept")->x.size(), 4u);
  EXPECT_EQ(labelled<Scatter>(panel, "dropped")->y, (std::vector<double>{2.0}));
  EXPECT_EQ(labelled<Segments>(panel, "noise floor")->y0, (std::vector<double>{1.0}));
  EXPECT_EQ(panel.title, "4-D\ns4 over floor: 8.0");
}

TEST(SingularValuesFigure, TakesTheGreatestDroppedWhereNoLevelIsKnownAndNothingWhereNoneIsDropped) {
  const auto panel_of = [](std::vector<double> values) {
    return singular_values_figure({"s", "", {{"4-D", std::move(values), 4, std::nullopt}}, {}})
        .panels[0];
  };
  EXPECT_EQ(labelled<Segments>(panel_of({100, 50, 20, 8, 2, 1}), "greatest dropped")->y0[0], 2.0);
  EXPECT_FALSE(labelled<Segments>(panel_of({100, 50, 20, 8}), "greatest dropped"));
  EXPECT_EQ(panel_of({100, 50, 20, 8, 0}).title, "4-D");
}

TEST(SingularValuesFigure, LeavesOutWhatIs0WithinRounding) {
  const Figure figure =
      singular_values_figure({"s", "", {{"4-D", {100, 50, 20, 8, 2, 1e-14}, 4, {}}}, {}});
  EXPECT_EQ(labelled<Scatter>(figure.panels[0], "dropped")->y, (std::vector<double>{2.0}));
  EXPECT_TRUE(figure.caption.ends_with("Not shown, as 0 within rounding: 1 value."));
}

TEST(SingularValuesFigure, RefusesWhatIsNoSingularValue) {
  EXPECT_THROW(singular_values_figure({"s", "", {{"", {1.0, -1.0}, 4, {}}}, {}}), InvalidInput);
  EXPECT_THROW(singular_values_figure({"s", "", {{"", {INFINITY}, 4, {}}}, {}}), InvalidInput);
}

TEST(WindowCurveFigure, RingsTheChosenLengthAndSaysWhichPredictNothing) {
  const WindowCurve windows{{240, 120, 60, 30}, {0.66, 0.58, NAN, NAN}, 120};
  const Figure figure = window_curve_figure({"windows-plaza-1", "", windows, "plaza-1"});
  const Panel& panel = figure.panels[0];
  EXPECT_EQ(labelled<Polyline>(panel, "held-out ranges")->x, (std::vector<double>{120, 240}));
  EXPECT_EQ(labelled<Scatter>(panel, "chosen")->x, (std::vector<double>{120}));
  EXPECT_EQ(labelled<Scatter>(panel, "chosen")->y, (std::vector<double>{0.58}));
  ASSERT_EQ(figure.notes.size(), 1u);
  EXPECT_EQ(figure.notes[0].text, "2 windows, of 30\u00A0s to 60\u00A0s, predict nothing.");
  EXPECT_TRUE(figure.caption.ends_with(figure.notes[0].text));
  EXPECT_TRUE(contains(figure.alt, "60 s predicts nothing"));
}

TEST(WindowCurveFigure, RefusesLengthsThatAreNone) {
  EXPECT_THROW(window_curve_figure({"w", "", {{1.0}, {}, 1.0}, ""}), InvalidInput);
  EXPECT_THROW(window_curve_figure({"w", "", {{0.0}, {1.0}, 1.0}, ""}), InvalidInput);
}

/// How many starts the bars of a kind stand for, the least cost first.
std::vector<double> bars_of(const Figure& figure, const std::string& kind) {
  std::vector<double> lengths;
  for (const Area& bar : layers_of<Area>(figure.panels[0]))
    if (bar.label == kind) lengths.push_back(bar.x[1] - bar.x[0]);
  return lengths;
}

TEST(RefinementStartsFigure, CountsTheStartsThatEndAtEachCost) {
  const SlamRun run = sample_drive("plaza-1", 100, 1);
  const Figure figure = refinement_starts_figure({"starts-plaza-1", "", run.starts, "plaza-1"});
  const Panel& panel = figure.panels[0];
  EXPECT_EQ(panel.y.names, (std::vector<std::string>{"9150: 21.3 m", "812: 0.190 m"}));
  EXPECT_EQ(bars_of(figure, "from random"), (std::vector<double>{11, 1}));
  EXPECT_EQ(bars_of(figure, "from spectral"), (std::vector<double>{1}));
  EXPECT_EQ(layers_of<Texts>(panel).at(0).text, (std::vector<std::string>{"13", "1"}));
  EXPECT_EQ(panel.x.label, "starts, 14 in all");
  EXPECT_TRUE(notes_contain(figure,
                            "from spectral 1 of 1, from odometry 1 of 1 and from random 11 "
                            "of 12"));
  const StartCount random = starts_at_optimum(run.starts, SlamMethod::kRefinedFromRandom);
  EXPECT_EQ(random.reached, 11);
  EXPECT_EQ(random.of, 12);
}

TEST(RefinementStartsFigure, HasOneRowForAllEndsBeyondTheNinth) {
  std::vector<RefinementStart> starts;
  for (int i = 1; i <= 30; ++i)
    starts.push_back({SlamMethod::kRefinedFromRandom, i, 100.0 * i, 1.0 * i, 5, true});
  const Figure figure = refinement_starts_figure({"starts-x", "", starts, "x"});
  ASSERT_EQ(figure.panels[0].y.names.size(), 10U);
  EXPECT_EQ(figure.panels[0].y.names.front(), "21 more, from 1000");
  EXPECT_EQ(bars_of(figure, "from random").back(), 21.0);
}

TEST(RefinementStartsFigure, CountsAStartWithoutAResultAgainstItsKind) {
  const std::vector<RefinementStart> starts = {
      {SlamMethod::kRefined, 1, 10.0, std::nullopt, 5, true},
      {SlamMethod::kRefinedFromRandom, 1, NAN, std::nullopt, 0, false}};
  const Figure figure = refinement_starts_figure({"starts-x", "", starts, "x"});
  EXPECT_EQ(figure.panels[0].y.label, "final cost");
  EXPECT_EQ(figure.panels[0].y.names, (std::vector<std::string>{"10.0"}));
  EXPECT_TRUE(notes_contain(figure, "1 start without a result"));
  EXPECT_EQ(starts_at_optimum(starts, SlamMethod::kRefinedFromRandom).reached, 0);
}

TEST(MapWallFigure, ShowsAllMapsHoweverMany) {
  EXPECT_EQ(map_wall_figure(sample_maps(21)).panels.size(), 21u);
  EXPECT_EQ(film_strip_figure(sample_maps(21)).panels.size(), 10u);
}

}  // namespace
}  // namespace mapproof::test
