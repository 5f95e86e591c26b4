#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/text/error_text.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/figures/maps/pair_distances.hpp"
#include "render/plot/layout.hpp"
#include "tests/support/samples/drawn_panels.hpp"
#include "tests/support/samples/sample_comparisons.hpp"

namespace mapproof::test {
namespace {

TEST(PublishedErrorsFigure, FillsThoseOutsideOurInterval) {
  const std::vector<PublishedError> methods = {
      {.label = "ISOMAP",
       .key = "a",
       .mean_m = 0.2,
       .interval = Range{0.1, 0.3},
       .published_m = 0.3},
      {.label = "SDE", .key = "b", .mean_m = 0.3, .interval = Range{0.2, 0.4}, .published_m = 0.41},
      {.label = "LLE", .key = "c", .mean_m = 0.4, .interval = std::nullopt, .published_m = 0.9},
      {.label = "LEM",
       .key = "d",
       .mean_m = 0.5,
       .interval = Range{0.4, 0.6},
       .published_m = 0.9,
       .can_compare = false}};
  const Figure figure =
      published_errors_figure({"published", {{"Bearing maps", "Table 1", methods}}, {"run"}});
  EXPECT_EQ(figure.title, "1 of 2 comparable published errors lie within our 95 % intervals");
  std::map<std::string, std::vector<double>> drawn;
  for (const Scatter& one : layers_of<Scatter>(figure.panels[0])) {
    drawn[one.label] = one.x;
    EXPECT_EQ(one.filled, one.label == "ours" || one.label == "published, outside the interval");
  }
  EXPECT_EQ(drawn["published"], (std::vector<double>{0.9, 0.3}));
  EXPECT_EQ(drawn["published, outside the interval"], std::vector<double>{0.41});
  EXPECT_EQ(drawn["published, not comparable"], std::vector<double>{0.9});
  EXPECT_EQ(drawn["ours"].size(), methods.size());
}

TEST(PublishedErrorsFigure, DoesNotWidenItsAxisByWhatDiverged) {
  const std::vector<PublishedError> methods = {{.label = "ISOMAP",
                                                .key = "a",
                                                .mean_m = 0.2,
                                                .interval = Range{0.1, 0.3},
                                                .published_m = 0.3},
                                               {.label = "LLE",
                                                .key = "b",
                                                .mean_m = 4e5,
                                                .interval = Range{100.0, 8e5},
                                                .published_m = 0.5}};
  const Figure figure =
      published_errors_figure({"published", {{"Bearing maps", "Table 1", methods}}, {"run"}});
  const Range limits = figure.panels[0].x.limits.value();
  EXPECT_LT(limits.high, 1.0);
  EXPECT_EQ(labelled<Segments>(figure.panels[0], "95 % interval").value().x0.size(), 1U);
  const Scatter diverged = labelled<Scatter>(figure.panels[0], kGreatErrorText).value();
  ASSERT_EQ(diverged.x.size(), 1U);
  EXPECT_LT(diverged.x[0], limits.high);
  EXPECT_TRUE(notes_contain(figure, "Diverged, over 1\u00A0km: LLE."));
  EXPECT_TRUE(contains(figure.alt, "LLE over 1\u00A0km (published 0.500)")) << figure.alt;
}

TEST(CriticalDifferenceFigure, PutsEachMethodAtItsMeanRankTheBetterHalfToTheLeft) {
  const Panel panel = critical_difference_figure(sample_ranks(10)).panels[0];
  const auto dots = layers_of<Scatter>(panel).at(0);
  ASSERT_EQ(dots.x.size(), 10u);
  EXPECT_NEAR(dots.x.front(), 1.6, 1e-9);  // SDE.
  EXPECT_TRUE(std::ranges::is_sorted(dots.x));
  const auto texts = layers_of<Texts>(panel);
  ASSERT_EQ(texts.size(), 3u);
  EXPECT_EQ(texts[1].align, Align::kEnd);
  EXPECT_EQ(texts[1].text.front(), "SDE 1.60");
  EXPECT_EQ(texts[2].text.front(), "LEM 6.60");
}

TEST(CriticalDifferenceFigure, JoinsMethodsThatAreCloserThanTheCriticalDifference) {
  CriticalDifferenceSpec spec = sample_ranks(4);
  for (std::size_t i = 0; i < 4; ++i) spec.methods[i].mean_rank = 1.0 + static_cast<double>(i);
  spec.critical_difference = 1.5;
  const Figure figure = critical_difference_figure(spec);
  const auto bars = layers_of<Segments>(figure.panels[0])[1];
  EXPECT_EQ(bars.x0.size(), 3u);  // 1-2, 2-3, 3-4.
  EXPECT_TRUE(contains(figure.alt, "No difference between LPCA and SMACOF.")) << figure.alt;
  EXPECT_TRUE(contains(figure.caption, "Friedman test: p < 0.001"));
}

TEST(CriticalDifferenceFigure, HasNoColourOfAMethod) {
  const Panel panel = critical_difference_figure(sample_ranks(10)).panels[0];
  for (std::size_t series = 0; series < 2 * kMethodStyles; ++series) {
    const ThemeColour of_method = series_style(series).colour;
    for (const Segments& lines : layers_of<Segments>(panel)) EXPECT_NE(lines.colour, of_method);
    for (const Scatter& dots : layers_of<Scatter>(panel)) EXPECT_NE(dots.colour, of_method);
  }
}

TEST(CriticalDifferenceFigure, SaysWhenTheFriedmanTestFindsNothing) {
  CriticalDifferenceSpec spec = sample_ranks(4);
  spec.friedman_p = 0.4;
  EXPECT_TRUE(notes_contain(critical_difference_figure(spec), "finds no difference"));
}

TEST(CriticalDifferenceFigure, DrawsADifferenceAtItsLengthOrOpenAtTheEndOfTheAxis) {
  CriticalDifferenceSpec spec = sample_ranks(10);
  const auto arrows = [](const Figure& figure) {
    std::vector<Segments> found = layers_of<Segments>(figure.panels[0]);
    std::erase_if(found, [](const Segments& lines) { return !lines.arrow; });
    return found;
  };
  spec.critical_difference = 9.0;  // From 1 to 10.
  const Figure whole = critical_difference_figure(spec);
  EXPECT_EQ(std::ranges::max(layers_of<Segments>(whole.panels[0]).at(2).x1), 10.0);
  EXPECT_TRUE(arrows(whole).empty());
  EXPECT_FALSE(notes_contain(whole, "longer than the axis"));
  spec.critical_difference = 9.58;
  const Figure open = critical_difference_figure(spec);
  ASSERT_EQ(arrows(open).size(), 1u);
  EXPECT_EQ(arrows(open)[0].x1.at(0), 10.0);
  EXPECT_TRUE(notes_contain(open, "longer than the axis"));
}

TEST(CriticalDifferenceFigure, RefusesRanksThatAreNone) {
  for (const double rank : {0.5, 5.0, std::nan("")}) {
    CriticalDifferenceSpec spec = sample_ranks(4);
    spec.methods[1].mean_rank = rank;
    EXPECT_THROW(critical_difference_figure(spec), InvalidInput) << rank;
  }
  CriticalDifferenceSpec spec = sample_ranks(4);
  spec.critical_difference = 0.0;
  EXPECT_THROW(critical_difference_figure(spec), InvalidInput);
}

TEST(ScatterEllipse, OfARectanglesCornersHasItsAxes) {
  std::vector<Points> runs;
  for (int times = 0; times < 3; ++times)
    for (const double x : {3.0, -3.0})
      for (const double y : {1.0, -1.0}) runs.emplace_back(Points(1, 2)) << x, y;
  const ScatterEllipse ellipse = scatter_ellipse(runs, 0);
  EXPECT_EQ(ellipse.runs, 12);
  EXPECT_NEAR(ellipse.a_m, std::sqrt(-2.0 * std::log(0.05)) * std::sqrt(108.0 / 11.0), 1e-12);
  EXPECT_NEAR(ellipse.b_m, std::sqrt(-2.0 * std::log(0.05)) * std::sqrt(12.0 / 11.0), 1e-12);
  EXPECT_NEAR(ellipse.rotation_rad, 0.0, 1e-12);
}

TEST(ScatterEllipse, TurnsWithItsPoints) {
  std::vector<Points> runs(kFewestForEllipse, Points::Zero(1, 2));
  runs[0] << 1.0, 1.0;
  runs[1] << -1.0, -1.0;
  EXPECT_NEAR(scatter_ellipse(runs, 0).rotation_rad, std::acos(-1.0) / 4.0, 1e-12);
  EXPECT_NEAR(scatter_ellipse(runs, 0).b_m, 0.0, 1e-7);
  runs.pop_back();
  EXPECT_TRUE(std::isnan(scatter_ellipse(runs, 0).a_m));
}

TEST(EllipseMapFigure, JoinsTheGroundTruthToTheMean) {
  const EllipseMapSpec spec = sample_runs(20, kFewestForEllipse);
  const Figure figure = ellipse_map_figure(spec);
  const auto bias = labelled<Segments>(figure.panels[0], "error of the mean").value();
  ASSERT_EQ(bias.x0.size(), 20u);
  EXPECT_EQ(bias.x0[3], spec.ground_truth_m(3, 0));
  EXPECT_NEAR(bias.x1[3], scatter_ellipse(spec.estimates_m, 3).mean_m.x(), 1e-15);
  EXPECT_EQ(labelled<Ellipses>(figure.panels[0], "95 % of estimates").value().x.size(), 20u);
  EXPECT_TRUE(contains(figure.caption, "20 landmarks over 10 runs"));
  EXPECT_FALSE(labelled<Scatter>(figure.panels[0], "single estimate"));
}

TEST(EllipseMapFigure, OfFewRunsShowsEachEstimateAndNoEllipse) {
  EllipseMapSpec spec = sample_runs(20, 5);
  spec.estimates_m[2].row(7).setConstant(NAN);
  const Figure figure = ellipse_map_figure(spec);
  const Panel& panel = figure.panels[0];
  EXPECT_TRUE(layers_of<Ellipses>(panel).empty());
  const auto estimates = labelled<Scatter>(panel, "single estimate").value();
  EXPECT_EQ(estimates.x.size(), 99U);
  EXPECT_EQ(estimates.x[1], spec.estimates_m[1](0, 0));
  const auto spokes = layers_of<Segments>(panel).front();
  EXPECT_EQ(spokes.x1, estimates.x);
  EXPECT_NEAR(spokes.x0[1], scatter_ellipse(spec.estimates_m, 0).mean_m.x(), 1e-15);
  EXPECT_TRUE(contains(figure.caption, "fewer than 10 are too few for an ellipse"));
  EXPECT_TRUE(contains(scatter_finding(spec), " m from their mean")) << scatter_finding(spec);
  // The frame holds an estimate beside the room; one far away is counted.
  const double before = panel.x.limits->high;
  spec.estimates_m[0](3, 0) = before + 0.2;
  const Figure beside = ellipse_map_figure(spec);
  EXPECT_GE(beside.panels[0].x.limits->high, before + 0.2);
  EXPECT_FALSE(notes_contain(beside, "outside the image"));
  spec.estimates_m[0](3, 0) = 1e3;
  EXPECT_TRUE(notes_contain(ellipse_map_figure(spec), "1 single estimate outside the image."));
}

/// Positions whose sums are exact.
Points rounded(const Points& positions_m) {
  constexpr double kParts = 64.0;
  return (kParts * positions_m.array()).round() / kParts;
}

TEST(EllipseMapFigure, HasAFindingOfErrorAndScatter) {
  EllipseMapSpec spec = sample_runs(20, kFewestForEllipse);
  spec.ground_truth_m = rounded(spec.ground_truth_m);
  for (Points& run : spec.estimates_m) {
    run = spec.ground_truth_m;
    run.col(0).array() += 0.5;
  }
  EXPECT_EQ(scatter_finding(spec),
            "mean positions 0.500 m off, 95\u00A0% ellipses of 0 m (half the long axis)");
  spec.estimates_m.pop_back();
  EXPECT_EQ(scatter_finding(spec), "mean positions 0.500 m off, estimates 0 m from their mean");
  EXPECT_EQ(scatter_finding(sample_runs(20, 1)), "");
}

TEST(EllipseMapFigure, NamesALandmarkEvenIfAllRunsAgree) {
  EllipseMapSpec spec = sample_runs(20, kFewestForEllipse);
  for (Points& run : spec.estimates_m) run = rounded(spec.estimates_m.front());
  const Figure figure = ellipse_map_figure(spec);
  EXPECT_TRUE(contains(figure.alt, "0 m at most, of " + spec.names.front() + ".")) << figure.alt;
}

TEST(EllipseMapFigure, SaysWhatItCannotShow) {
  EXPECT_TRUE(notes_contain(ellipse_map_figure(sample_runs(20, 0)), "No run gave a landmark"));
  EllipseMapSpec spec = sample_runs(20, 3);
  spec.estimates_m[1].conservativeResize(19, 2);
  EXPECT_THROW(ellipse_map_figure(spec), InvalidInput);
}

TEST(ShepardFit, OfProportionalDistancesIsPerfect) {
  const ShepardFit fit = shepard_fit({"", {1.0, 2.0, 3.0, NAN}, {2.0, 4.0, 6.0, 1.0}});
  EXPECT_EQ(fit.pairs, 3u);
  EXPECT_NEAR(fit.correlation, 1.0, 1e-12);
  EXPECT_NEAR(fit.slope, 2.0, 1e-12);
  EXPECT_NEAR(fit.stress, 0.0, 1e-7);
}

TEST(ShepardFit, OfNothingIsUnknown) {
  EXPECT_TRUE(std::isnan(shepard_fit({"", {}, {}}).correlation));
  EXPECT_TRUE(std::isnan(shepard_fit({"", {1.0, 2.0}, {0.0, 0.0}}).stress));
  EXPECT_THROW(shepard_fit({"", {1.0}, {}}), InvalidInput);
  EXPECT_THROW(shepard_fit({"", {1.0}, {INFINITY}}), InvalidInput);
  EXPECT_THROW(shepard_fit({"", {-1.0}, {1.0}}), InvalidInput);
}

TEST(ShepardFigure, CountsEveryPairOfAMap) {
  const Figure figure = shepard_figure(sample_distances(3, 50));
  ASSERT_EQ(figure.panels.size(), 3u);
  const auto cells = layers_of<Cells>(figure.panels[1]).at(0);
  double pairs = 0.0;
  for (const double value : cells.values)
    if (!std::isnan(value)) pairs += std::expm1(value);
  EXPECT_NEAR(pairs, 1225.0, 1e-6);
  EXPECT_TRUE(contains(figure.alt, "1225 pairs"));
}

TEST(ShepardFigure, AFailedMapDoesNotFlattenTheOthers) {
  ShepardSpec spec = sample_distances(4, 50);
  for (double& distance : spec.methods[1].mapped_m) distance *= 1e9;
  const Figure figure = shepard_figure(spec);
  EXPECT_LT(figure.panels[0].y.limits->high, 20.0);
  EXPECT_TRUE(notes_contain(figure, "outside the image"));
}

TEST(SpectrumFigure, StatesTheGapBetweenTheSecondAndTheThirdEigenvalue) {
  EXPECT_DOUBLE_EQ(spectral_gap({10.0, 8.0, 2.0, 1.0}), 4.0);
  EXPECT_DOUBLE_EQ(spectral_gap({1.0, 2.0, 6.0}), 3.0);  // The least make the map.
  EXPECT_TRUE(std::isnan(spectral_gap({1.0, 0.5})));
  EXPECT_TRUE(std::isnan(spectral_gap({1.0, 0.5, 0.0})));
}

TEST(SpectrumFigure, LeavesIterativeMethodsOutAndNamesThem) {
  const Figure figure = spectrum_figure(sample_spectra(6));
  EXPECT_EQ(figure.panels.size(), 4u);
  EXPECT_FALSE(contains(figure.panels[0].title, "smallest first"));
  EXPECT_TRUE(contains(spectrum_figure(sample_spectra(8)).panels.back().title, "smallest first"));
  EXPECT_TRUE(contains(figure.caption, "SMACOF and SMACOF, kNN"));
  EXPECT_EQ(labelled<Scatter>(figure.panels[0], "axis of the map").value().x.size(), 2u);
  EXPECT_EQ(labelled<Scatter>(figure.panels[0], "other eigenvalue").value().x.size(), 8u);
}

TEST(FilmStripFigure, ShowsAtMostTenMapsTheFirstAndTheLastAmongThem) {
  const Figure figure = film_strip_figure(sample_maps(23));
  ASSERT_EQ(figure.panels.size(), 10u);
  EXPECT_TRUE(figure.panels.front().title.starts_with("200 steps\nMPE "));
  EXPECT_TRUE(figure.panels.back().title.starts_with("4600 steps\nMPE "));
  EXPECT_TRUE(figure.shared_x && figure.shared_y);
}

TEST(FilmStripFigure, SaysWhichMapsLackLandmarks) {
  MapGridSpec spec = sample_maps(3);
  spec.maps[1].map.estimate.row(4).setConstant(NAN);
  EXPECT_TRUE(notes_contain(film_strip_figure(spec), "left out of: 400 steps"));
}

TEST(FilmStripFigure, RefusesNoMapsAndMapsInDifferentFrames) {
  EXPECT_THROW(film_strip_figure(sample_maps(0)), InvalidInput);
  MapGridSpec spec = sample_maps(2);
  spec.maps[1].map.frame = Frame::kSimilarity;
  EXPECT_THROW(map_pair_figure(spec), InvalidInput);
}

TEST(MapWallFigure, HasTheLimitsOfTheFirstMapsAndArrowsToThem) {
  MapGridSpec spec = sample_maps(3);
  const Figure whole = map_wall_figure(spec);
  EXPECT_FALSE(labelled<Segments>(whole.panels[0], "estimate outside"));
  // A map twice as large, of which no point is far off.
  spec.maps[2].map.estimate *= 2.0;
  spec.framing = 2;
  const Figure figure = map_wall_figure(spec);
  const Range x = figure.panels[0].x.limits.value(), y = figure.panels[0].y.limits.value();
  for (const Panel& panel : figure.panels) {
    EXPECT_EQ(panel.x.limits->high, x.high);
    EXPECT_EQ(panel.y.limits->low, y.low);
  }
  EXPECT_FALSE(labelled<Segments>(figure.panels[1], "estimate outside"));
  const auto arrows = labelled<Segments>(figure.panels[2], "estimate outside").value();
  EXPECT_GE(arrows.x1.size(), 10U);
  for (std::size_t i = 0; i < arrows.x1.size(); ++i) {
    EXPECT_LE(arrows.x1[i], x.high);
    EXPECT_LE(arrows.y1[i], y.high);
  }
  const auto inside = labelled<Scatter>(figure.panels[2], "estimate").value();
  EXPECT_EQ(inside.x.size() + arrows.x1.size(), 50U);
  EXPECT_LE(std::ranges::max(inside.x), x.high);
}

TEST(MapPairFigure, TitlesNameTheRunAndBothErrors) {
  MapGridSpec spec = sample_maps(2);
  spec.maps[0].title = "Median, layout 4";
  const Figure figure = map_pair_figure(spec);
  EXPECT_TRUE(contains(figure.panels[0].title, "Median, layout 4\nMPE "));
  EXPECT_TRUE(contains(figure.panels[0].title, "\nMOE "));
  EXPECT_EQ(figure.record_ids.size(), 2u);
}

TEST(EllipseMapFigure, HoldsItsEllipsesUnlessTheyAreFarTooLarge) {
  EllipseMapSpec spec;
  spec.id = "ellipses";
  spec.names = {"a", "b"};
  spec.ground_truth_m = Points(2, 2);
  spec.ground_truth_m << 0, 0, 10, 10;
  const auto scattered_by = [&](double reach) {
    spec.estimates_m.clear();
    for (int i = 0; i < 12; ++i) {
      const double off = reach * (i % 3 - 1);
      Points run = spec.ground_truth_m;
      run(1, 0) += off;
      spec.estimates_m.push_back(run);
    }
    return *ellipse_map_figure(spec).panels[0].x.limits;
  };
  const double before = scattered_by(0.01).high;
  // Half the axis of the ellipse is 2.45 times the standard deviation.
  EXPECT_NEAR(scattered_by(2.0).high,
              10.0 + 2.0 * std::sqrt(8.0 / 11.0) * std::sqrt(-2.0 * std::log(0.05)), 1e-9);
  EXPECT_FALSE(notes_contain(ellipse_map_figure(spec), "beyond the frame"));
  EXPECT_LT(scattered_by(1000.0).high, 2.0 * before);
  EXPECT_TRUE(notes_contain(ellipse_map_figure(spec),
                            "1 ellipse beyond the frame; half the longest axis, of b, is 2087 m."))
      << ellipse_map_figure(spec).notes.size();
}

TEST(AnchorCountFigure, HasAPanelASensorAndALineAPlacement) {
  const Figure figure = anchor_count_figure(sample_anchor_counts());
  ASSERT_EQ(figure.panels.size(), 2u);
  EXPECT_EQ(layers_of<Polyline>(figure.panels[0]).size(), 3u);
  EXPECT_EQ(layers_of<Band>(figure.panels[1]).size(), 3u);
  EXPECT_TRUE(figure.panels[0].x.whole);
  EXPECT_TRUE(contains(figure.alt, "corners and walls: least 0.140 at 20")) << figure.alt;
}

TEST(LevelCurveFigure, TakesItsAxisFromTheCaller) {
  const Figure figure = level_curve_figure(sample_levels(8));
  EXPECT_EQ(figure.panels[0].x.label, "standard deviation of bearing noise [°]");
  EXPECT_EQ(layers_of<Polyline>(figure.panels[0]).size(), 8u);
}

/// Three landmarks 3, 4 and 5 m apart, the third without a place in the map.
MapRecord right_triangle() {
  MapRecord map;
  map.id = "map";
  map.names = {"a", "b", "c"};
  map.estimate = Points::Constant(3, 2, NAN);
  map.estimate.topRows(2) << 0.0, 0.0, 3.1, 0.0;
  map.ground_truth_m.emplace(3, 2);
  *map.ground_truth_m << 0.0, 0.0, 3.0, 0.0, 3.0, 4.0;
  return map;
}

TEST(PairDistancesFigure, ShowsEachPairThatHasPlacesAndWhatItIsOff) {
  const MapRecord map = right_triangle();
  const std::vector<MeasuredPair> pairs = {{0, 1, 3.3, 1.0, 7}, {0, 2, 4.8, 1.0, 9}};
  const Figure figure = pair_distances_figure({"pairs", "Pairs", map, pairs});
  ASSERT_EQ(figure.panels.size(), 2u);
  const auto against = layers_of<Scatter>(figure.panels[0]);
  const auto off = layers_of<Scatter>(figure.panels[1]);
  ASSERT_EQ(against.size(), 2u);
  ASSERT_EQ(against[0].x.size(), 1u);  // The third landmark has no position in the map,
  ASSERT_EQ(against[1].x.size(), 2u);  // but one in the ground truth.
  EXPECT_DOUBLE_EQ(against[0].x[0], 3.1);
  EXPECT_DOUBLE_EQ(against[0].y[0], 3.3);
  EXPECT_NEAR(off[0].y[0], 0.2, 1e-12);
  EXPECT_DOUBLE_EQ(against[1].x[1], 5.0);
  EXPECT_NEAR(off[1].y[1], -0.2, 1e-12);
  EXPECT_EQ(against[1].marks[1].id, "ground-truth-1-3");
  EXPECT_TRUE(contains(figure.alt, "1 pair measured.")) << figure.alt;
  EXPECT_TRUE(contains(figure.alt, "within 0.250 m in the ground truth")) << figure.alt;
}

TEST(PairDistancesFigure, SaysThatNoPairHasAPlaceAndRefusesRowsThatAreNotThere) {
  const MapRecord map = right_triangle();
  const std::vector<MeasuredPair> none;
  const Figure figure = pair_distances_figure({"pairs", "Pairs", map, none});
  ASSERT_EQ(figure.notes.size(), 1u);
  EXPECT_EQ(figure.notes[0].text, "No measured pair has a position.");
  for (const MeasuredPair& wrong : {MeasuredPair{0, 3}, MeasuredPair{1, 1}, MeasuredPair{-1, 2}}) {
    const std::vector<MeasuredPair> pairs = {wrong};
    EXPECT_THROW(pair_distances_figure({"pairs", "Pairs", map, pairs}), InvalidInput);
  }
}

TEST(ParetoFront, HoldsWhatNoOtherBeatsInBoth) {
  const std::vector<CostedSetting> settings = {{"slow good", 10.0, 0.1}, {"fast bad", 0.1, 0.9},
                                               {"beaten", 11.0, 0.2},    {"middle", 1.0, 0.3},
                                               {"twin", 1.0, 0.3},       {"nan", 0.01, NAN}};
  EXPECT_EQ(pareto_front(settings), (std::vector<std::size_t>{1, 3, 0}));
}

TEST(ParetoFigure, NamesWhatWasNotTimedAndJoinsNoSinglePoint) {
  ParetoSpec spec = sample_costs(1);
  spec.untimed = {"SMACOF", "SDE"};
  const Figure figure = pareto_figure(spec);
  EXPECT_TRUE(layers_of<Polyline>(figure.panels[0]).empty());
  ASSERT_EQ(figure.notes.size(), 1u);
  EXPECT_EQ(figure.notes[0].text, "Not timed, and not shown: SMACOF and SDE.");
}

TEST(ParetoFigure, LeavesOutOfItsAxisAndItsFrontWhatDivergedUnlessAllDid) {
  ParetoSpec spec{.id = "cost",
                  .settings = {{"fastest", 0.1, 1e6}, {"A", 1.0, 0.3}, {"B", 2.0, 0.1}}};
  EXPECT_EQ(pareto_front(spec.settings), (std::vector<std::size_t>{1, 2}));
  const Figure figure = pareto_figure(spec);
  const Range limits = figure.panels[0].y.limits.value();
  EXPECT_LT(limits.high, 1.0);
  const Scatter diverged = labelled<Scatter>(figure.panels[0], kGreatErrorText).value();
  ASSERT_EQ(diverged.y.size(), 1U);
  EXPECT_LT(diverged.y[0], limits.high);
  EXPECT_GT(diverged.y[0], 0.3);
  EXPECT_TRUE(notes_contain(figure, "Diverged, over 1\u00A0km: fastest."));

  // Now the fastest is 101 times as far off as the others, which are alike.
  for (CostedSetting& one : spec.settings) one.mpe_m += 1e4;
  EXPECT_EQ(pareto_front(spec.settings), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_FALSE(labelled<Scatter>(pareto_figure(spec).panels[0], kGreatErrorText).has_value());
}

TEST(ParetoFigure, IsMarkedAsVarying) {
  const Figure figure = pareto_figure(sample_costs(10));
  EXPECT_TRUE(figure.varies);
  EXPECT_EQ(figure.panels[0].x.scale, Scale::kLog);
  EXPECT_TRUE(contains(figure.alt, "On the Pareto front:"));
  ParetoSpec spec = sample_costs(2);
  spec.settings[0].seconds = INFINITY;
  EXPECT_THROW(pareto_figure(spec), InvalidInput);
}

TEST(ParetoFigure, NamesEverySettingInAColumnOfAJournalWithRoomBetweenNames) {
  // Of the reproduction of Yairi 2007, visibility: in order of the marks, LLE has no room.
  const ParetoSpec spec{.id = "cost",
                        .title = "Cost",
                        .settings = {{"LPCA", 0.188e-3, 0.9665},
                                     {"SMACOF, equal weights", 1.58e-3, 0.3034},
                                     {"SMACOF, kNN weights, K = 7", 1.716e-3, 0.1572},
                                     {"KPCA, Gaussian, σ² = 5", 0.194e-3, 0.9732},
                                     {"KPCA, polynomial, d = 2", 0.223e-3, 1.0142},
                                     {"ISOMAP, K = 7", 0.348e-3, 0.1838},
                                     {"LLE, K = 8", 0.416e-3, 0.205},
                                     {"LEM, K = 8", 0.245e-3, 0.3763},
                                     {"HLLE, K = 9", 0.788e-3, 0.226},
                                     {"SDE, K = 5", 43.83e-3, 0.161}},
                        .untimed = {},
                        .record_ids = {}};
  const Theme theme = paper_theme(3.25);
  const Drawing drawing = lay_out(pareto_figure(spec), theme);
  std::vector<Box> names;
  for (const TextLine& line : texts_of(drawing, ItemClass::kMarkLabel))
    names.push_back(text_box(line));
  EXPECT_EQ(names.size(), spec.settings.size());
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = i + 1; j < names.size(); ++j) {
      const double space = 0.29 * theme.tick_font_pt;
      const bool are_on_a_line = std::abs(names[i].centre().y - names[j].centre().y) < space;
      const Box spaced{names[i].x0 - space, names[i].y0, names[i].x1 + space, names[i].y1};
      EXPECT_FALSE((are_on_a_line ? spaced : names[i]).overlaps(names[j])) << i << " and " << j;
    }
}

TEST(IdeaFigure, ShowsRoomHistoryAndMapWithArrowsBetween) {
  const IdeaSpec spec = sample_idea(Sensor::kVisibility);
  const Figure figure = idea_figure(spec);
  ASSERT_EQ(figure.panels.size(), 3u);
  EXPECT_EQ(figure.arrows, (std::vector<PanelArrow>{{0, "observe"}, {1, "embed"}}));
  const auto cells = layers_of<Cells>(figure.panels[1]).at(0);
  EXPECT_EQ(cells.columns, 100u);
  EXPECT_EQ(cells.rows(), 50u);
  EXPECT_EQ(cells.values[3 * 100 + 7], spec.history.values(3, 7));
  EXPECT_EQ(layers_of<Polyline>(figure.panels[0]).at(0).x.size(), 100u);
}

TEST(IdeaFigure, RefusesPartsThatDisagree) {
  IdeaSpec spec = sample_idea(Sensor::kBearing);
  spec.history.values.conservativeResize(49, Eigen::NoChange);
  EXPECT_THROW(idea_figure(spec), InvalidInput);
  spec = sample_idea(Sensor::kBearing);
  spec.steps = 0;
  EXPECT_THROW(idea_figure(spec), InvalidInput);
  spec = sample_idea(Sensor::kBearing);
  spec.path_m(0, 0) = NAN;
  EXPECT_THROW(idea_figure(spec), InvalidInput);
}

TEST(HeatMapFigure, PutsTheFirstLevelsAtTheLowerLeftAndSaysTheNumbers) {
  HeatMapSpec spec = sample_heat(3, 2);
  spec.values = {0.1, 0.2, 0.3, 0.4, NAN, 0.6};
  const Figure figure = heat_map_figure(spec);
  const Panel& panel = figure.panels[0];
  const Cells cells = layers_of<Cells>(panel).at(0);
  EXPECT_EQ(cells.columns, 3u);
  EXPECT_EQ(cells.values[3], 0.1);  // The uppermost row stands first.
  EXPECT_EQ(cells.text[2], "0.600");
  EXPECT_EQ(cells.colour_scale.limits, (Range{0.1, 0.6}));
  EXPECT_EQ(cells.colour_scale.bar_label, "MPE [m]");
  EXPECT_EQ(panel.x.names, spec.x_names);
  EXPECT_EQ(panel.y.names, spec.y_names);
  EXPECT_TRUE(contains(figure.alt, "Least: 0.100 m at landmarks 20, side of the room [m] 1.5"))
      << figure.alt;
}

TEST(HeatMapFigure, HatchesMissingCellsAndSaysSo) {
  HeatMapSpec spec = sample_heat(3, 2);
  EXPECT_TRUE(heat_map_figure(spec).notes.empty());
  spec.values[4] = NAN;
  const Figure figure = heat_map_figure(spec);
  EXPECT_TRUE(notes_contain(figure, "no run gave a value"));
  EXPECT_TRUE(contains(figure.caption, "1 cell"));
  const Segments hatching = layers_of<Segments>(figure.panels[0]).at(0);
  for (std::size_t i = 0; i < hatching.x0.size(); ++i)
    for (const auto& [x, y] :
         {std::pair{hatching.x0[i], hatching.y0[i]}, std::pair{hatching.x1[i], hatching.y1[i]}}) {
      EXPECT_LE(std::abs(x - 1.0), 0.5 + 1e-12);
      EXPECT_LE(std::abs(y - 1.0), 0.5 + 1e-12);
    }
}

TEST(HeatMapFigure, HasLogarithmicColoursWhereErrorsSpanMuch) {
  HeatMapSpec spec = sample_heat(2, 1);
  spec.values = {0.01, 1.0};
  const auto scale = [&] {
    return layers_of<Cells>(heat_map_figure(spec).panels[0]).at(0).colour_scale.scale;
  };
  EXPECT_EQ(scale(), Scale::kLog);
  spec.unit = "%";
  EXPECT_EQ(scale(), Scale::kLinear);
  spec.unit = "m";
  spec.values = {0.1, 1.0};
  EXPECT_EQ(scale(), Scale::kLinear);
}

TEST(HeatMapFigure, SaysWhichMapsDivergedAndLeavesTheirErrorsOutOfTheColours) {
  HeatMapSpec spec = sample_heat(3, 1);
  spec.unit = "m";
  spec.values = {0.2, 6594.0, 0.4};
  EXPECT_EQ(layers_of<Cells>(heat_map_figure(spec).panels[0]).at(0).text[1], "6594");
  spec.great_errors = true;
  const Figure figure = heat_map_figure(spec);
  const Cells cells = layers_of<Cells>(figure.panels[0]).at(0);
  EXPECT_EQ(cells.text[1], ">\u00A01\u00A0km");
  EXPECT_EQ(cells.colour_scale.limits, (Range{0.2, 0.4}));
  EXPECT_EQ(cells.colour_scale.scale, Scale::kLinear);
  EXPECT_TRUE(contains(figure.alt, "greatest: over 1\u00A0km at")) << figure.alt;
  const std::string finding = heat_map_finding(spec, "MPE");
  EXPECT_TRUE(contains(finding, "highest over 1\u00A0km at")) << finding;
  spec.values = {2000.0, 6594.0, 3000.0};
  EXPECT_NO_THROW(heat_map_figure(spec));
  EXPECT_EQ(heat_map_finding(spec, "MPE"), "MPE over 1\u00A0km everywhere");
}

TEST(HeatMapFinding, NamesTheFactorThatChangesTheValuesTwiceAsMuch) {
  HeatMapSpec spec = sample_heat(3, 3);
  const auto finding = [&](std::vector<double> values) {
    spec.values = std::move(values);
    return heat_map_finding(spec, "MPE");
  };
  EXPECT_EQ(finding({1.0, 1.1, 1.2, 2.0, 2.1, 2.2, 3.0, 3.1, 3.2}),
            "MPE depends more on side of the room than on landmarks, between 1.00\u00A0m and "
            "3.20\u00A0m");
  EXPECT_EQ(finding({1.0, 2.0, 3.0, 1.1, 2.1, 3.1, 1.2, 2.2, 3.2}),
            "MPE depends more on landmarks than on side of the room, between 1.00\u00A0m and "
            "3.20\u00A0m");
  // Ten times along the one and three times along the other, which logarithmic colours show.
  const std::vector<double> wide = {0.01, 0.03, 0.09, 0.1, 0.3, 0.9, 1.0, 3.0, 9.0};
  EXPECT_TRUE(contains(finding(wide), "depends more on side of the room")) << finding(wide);
  spec.unit = "%";
  EXPECT_TRUE(contains(finding(wide), "lowest MPE")) << finding(wide);
}

TEST(HeatMapFinding, SaysWhereTheValuesAreLeastAndGreatestWhereNoFactorIsClear) {
  HeatMapSpec spec = sample_heat(3, 3);
  const auto says_where = [&] {
    return heat_map_finding(spec, "MPE").starts_with("lowest MPE 1.00\u00A0m at 20 and 1.5\u00A0m");
  };
  spec.values = {1.0, 2.0, 3.0, 2.0, 3.0, 4.0, 3.0, 4.0, 5.0};
  EXPECT_TRUE(says_where()) << heat_map_finding(spec, "MPE");
  spec.values = {1.0, 1.1, 1.2, 2.0, NAN, 2.2, 3.0, 3.1, 3.2};
  EXPECT_TRUE(says_where()) << "a value is missing";
  spec.values.assign(9, 1.0);
  EXPECT_TRUE(says_where()) << "all are equal";
  spec.values = {1.0, 1.0, 1.0, 1.0001, 1.0001, 1.0001, 1.0002, 1.0002, 1.0002};
  EXPECT_TRUE(says_where()) << "all have the same digits";
  spec = sample_heat(3, 2);
  spec.values = {1.0, 1.1, 1.2, 2.0, 2.1, 2.2};
  EXPECT_TRUE(says_where()) << "of two levels";
}

TEST(HeatMapFigure, RefusesWhatIsNoMatrix) {
  HeatMapSpec spec = sample_heat(3, 2);
  spec.values.pop_back();
  EXPECT_THROW(heat_map_figure(spec), InvalidInput);
  spec = sample_heat(2, 2);
  spec.values.assign(4, NAN);
  EXPECT_THROW(heat_map_figure(spec), InvalidInput);
}

TEST(HeatMapFigure, WritesNumbersOnlyWhereAllOfThemFit) {
  const auto numbers_in = [](const HeatMapSpec& spec) {
    const Drawing drawing = lay_out(heat_map_figure(spec), report_theme());
    return std::ranges::count_if(
        drawing.items, [](const Item& item) { return item.item_class == ItemClass::kCellText; });
  };
  EXPECT_EQ(numbers_in(sample_heat(5, 4)), 20);
  EXPECT_EQ(numbers_in(sample_heat(30, 24)), 0);
}

TEST(HeatMapFigure, WritesSignificantDigitsOfSmallValues) {
  const auto texts = [](const HeatMapSpec& spec) {
    const Figure figure = heat_map_figure(spec);
    return std::get<Cells>(figure.panels.at(0).layers.back()).text;
  };
  HeatMapSpec spec = sample_heat(2, 2);
  spec.values = {1.23e-16, -4.5e-17, 0.0, 2e-16};
  spec.decimals = 6;
  EXPECT_EQ(texts(spec),
            (std::vector<std::string>{"0.000000", "2.0×10⁻¹⁶", "1.2×10⁻¹⁶", "−4.5×10⁻¹⁷"}));
  EXPECT_NE(heat_map_figure(spec).alt.find("greatest: 2.00×10⁻¹⁶ m"), std::string::npos);
  spec.values = {0.25, 1e-16, 0.0, 0.5};
  spec.decimals = 3;
  EXPECT_EQ(texts(spec), (std::vector<std::string>{"0.000", "0.500", "0.250", "≈ 0"}));
}

TEST(HeatMapFigure, HasTheThousandsOfItsNumbersApart) {
  HeatMapSpec spec = sample_heat(2, 1);
  spec.unit = "";
  spec.decimals = 0;
  const auto texts = [&] { return layers_of<Cells>(heat_map_figure(spec).panels[0]).at(0).text; };
  for (const double least : {204.0, 6204.0}) {  // Logarithmic and linear colours.
    spec.values = {least, 12345.0};
    EXPECT_EQ(texts().back(), "12,345");
  }
  EXPECT_EQ(texts().front(), "6,204");
  spec.values = {6204.0, 9345.0};
  EXPECT_EQ(texts(), (std::vector<std::string>{"6204", "9345"}));
}

TEST(HeatMapFigure, HasABarOfTheHeightOfItsFrameRightOfIt) {
  const Drawing drawing = lay_out(heat_map_figure(sample_heat(5, 4)), report_theme());
  const Box& frame = drawing.frames.at(0);
  Box bar{1e9, 1e9, -1e9, -1e9};
  for (const Item& item : drawing.items)
    if (const auto* shape = std::get_if<Shape>(&item.what);
        shape != nullptr && item.item_class == ItemClass::kLegendSample && shape->fill) {
      const Box box = bounds(shape->path);
      bar = {std::min(bar.x0, box.x0), std::min(bar.y0, box.y0), std::max(bar.x1, box.x1),
             std::max(bar.y1, box.y1)};
    }
  EXPECT_GT(bar.x0, frame.x1);
  EXPECT_LT(bar.x1, drawing.width);
  EXPECT_NEAR(bar.y0, frame.y0, 1e-9);
  EXPECT_NEAR(bar.y1, frame.y1, 1e-9);
}

}  // namespace
}  // namespace mapproof::test
