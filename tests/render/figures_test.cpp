#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/text/number_text.hpp"
#include "render/figures/curves/error_curve.hpp"
#include "render/figures/maps/map.hpp"
#include "render/figures/maps/map_ellipses.hpp"
#include "render/figures/maps/pair_distances.hpp"
#include "render/figures/score_text.hpp"
#include "tests/support/samples/sample_figures.hpp"

namespace mapproof::test {
namespace {

/// The layer of a type and label; fails the test if it is not there.
template <typename Kind>
Kind layer_of(const Figure& figure, const std::string& label) {
  for (const Layer& layer : figure.panels.at(0).layers)
    if (const auto* found = std::get_if<Kind>(&layer); found != nullptr && found->label == label)
      return *found;
  ADD_FAILURE() << "no layer " << label;
  return {};
}

bool has_note(const Figure& figure, const std::string& part) {
  return std::ranges::any_of(
      figure.notes, [&](const Note& note) { return note.text.find(part) != std::string::npos; });
}

TEST(MapFigure, JoinsEachEstimateToItsGroundTruth) {
  const MapRecord map = sample_map(50, 0.1, 1);
  const Figure figure = map_figure(map, "map");
  const auto lines = layer_of<Segments>(figure, "error");
  ASSERT_EQ(lines.x0.size(), 50u);
  EXPECT_EQ(lines.x0[7], (*map.ground_truth_m)(7, 0));
  EXPECT_EQ(lines.y1[7], map.estimate(7, 1));
  EXPECT_EQ(layer_of<Scatter>(figure, "anchor").x.size(), 4u);
  EXPECT_EQ(layer_of<Scatter>(figure, "true position").x.size(), 46u);
  EXPECT_EQ(layer_of<Scatter>(figure, "estimate").x.size(), 50u);
}

TEST(MapFigure, DrawsAnEvenPartOfManyLandmarksAndSaysSo) {
  const MapRecord map = sample_map(12'000, 0.1, 1);
  const Figure figure = map_figure(map, "map");
  const auto drawn = layer_of<Scatter>(figure, "estimate");
  // Every twelfth, and of the others the anchors and those of the largest errors.
  EXPECT_GE(drawn.x.size(), 1000u);
  EXPECT_LE(drawn.x.size(), 1000u + map.anchors.size() + 5u);
  EXPECT_EQ(layer_of<Scatter>(figure, "anchor").x.size(), map.anchors.size());
  EXPECT_TRUE(has_note(figure, "one in 12 of 12,000 landmarks"));
  EXPECT_FALSE(has_note(map_figure(sample_map(5000, 0.1, 1), "map"), "one in"));
}

TEST(MeasuredMap, DrawsTheSameEllipsesAsTheMapOfOneCommand) {
  const MapRecord map = sample_map(5, 0.1, 1);
  MapUncertainty uncertainty{.squared_radius = 9.5, .replicates = 20, .maps = 20, .block_steps = 4};
  uncertainty.covariances.assign(5, Eigen::Matrix2d::Identity() * 1e-4);
  Figure of_command = map_figure(map, "map");
  add_ellipses(map, uncertainty, of_command);
  const Figure of_study = measured_map_figure(
      {.id = "map", .title = "", .map = map, .pairs = {}, .uncertainty = uncertainty});
  const auto drawn = layer_of<Ellipses>(of_study, "95 % ellipse");
  ASSERT_EQ(drawn.a.size(), 5u);
  EXPECT_NEAR(drawn.a[0], std::sqrt(9.5) * 1e-2, 1e-15);
  EXPECT_EQ(drawn.a, layer_of<Ellipses>(of_command, "95 % ellipse").a);
}

TEST(MapEllipses, AreCountedInANoteWhereTheFrameCutsThem) {
  MapRecord map = sample_map(5, 0.1, 1);
  MapUncertainty uncertainty{.squared_radius = 9.0, .replicates = 20, .maps = 20, .block_steps = 4};
  uncertainty.covariances.assign(5, Eigen::Matrix2d::Identity() * 1e-4);
  const auto drawn = [&] {
    Figure figure = map_figure(map, "map");
    add_ellipses(map, uncertainty, figure);
    return figure;
  };
  EXPECT_FALSE(has_note(drawn(), "beyond the frame"));
  uncertainty.covariances[3] *= 1e8;
  const std::string cut =
      "1 ellipse beyond the frame; half the longest axis, of " + map.names[3] + ", is 300";
  EXPECT_TRUE(has_note(drawn(), cut + " m."));
  map.frame = Frame::kSimilarity;
  EXPECT_TRUE(has_note(drawn(), cut + ".")) << "no unit";
}

TEST(MapFigure, SaysItsScoreInTheCaption) {
  MapRecord map = sample_map(50, 0.1, 1);
  map.score = Score{0.2190, 4.7, 0.2, 4.7};
  const Figure figure = map_figure(map, "map");
  EXPECT_TRUE(figure.caption.starts_with(
      "ISOMAP, K = 6, visibility, 2000 steps: MPE 0.219 m, MOE 4.70\u00A0%."))
      << figure.caption;
  EXPECT_TRUE(has_note(figure, "MPE 0.219 m"));
  EXPECT_EQ(figure.record_ids, std::vector<std::string>{map.id});
}

TEST(MapFigure, SaysOnlyErrorsThatAreKnown) {
  for (const Frame frame : {Frame::kGroundTruth, Frame::kSimilarity}) {
    MapRecord map = sample_map(20, 0.1, 1);
    map.frame = frame;
    map.score = Score{NAN, NAN, 0.31, 4.2};
    const Figure figure = map_figure(map, "map");
    EXPECT_TRUE(has_note(figure, "0.310 m after the best affine fit to all landmarks"));
    for (const std::string& words : {figure.caption, figure.alt, figure.notes.at(0).text}) {
      EXPECT_NE(words.find("MOE 4.20\u00A0% up to a mirror"), std::string::npos) << words;
      EXPECT_EQ(words.find("nan"), std::string::npos) << words;
      EXPECT_EQ(words.find("unknown"), std::string::npos) << words;
    }
  }
}

TEST(MapFigure, LabelsTheWorstLandmarksThatAreNoAnchors) {
  MapRecord map = sample_map(50, 0.0, 1);
  map.anchors = {4};
  map.estimate(4, 0) += 0.9;  // An anchor.
  map.estimate(9, 0) += 0.8;
  map.estimate(2, 0) += 0.5;
  const MapView view = view_of(map);
  EXPECT_EQ(view.worst, (std::vector<Eigen::Index>{9, 2}));
  EXPECT_NE(map_figure(map, "map")
                .caption.find(" Worst but for anchors: L10 (0.800 m) and L03 (0.500 m)."),
            std::string::npos);
  map.anchors.clear();
  EXPECT_NE(map_figure(map, "map").caption.find(" Worst: L05 (0.900 m), L10 (0.800 m) and"),
            std::string::npos);
}

TEST(MapFigure, ExplainsOnlyTheMarksThatItHas) {
  MapRecord map = sample_map(20, 0.1, 1);
  map.anchors = {0, 5};
  const auto caption = [&] { return map_figure(map, "map").caption; };
  const auto has = [&](const char* words) { return caption().find(words) != std::string::npos; };
  EXPECT_TRUE(
      has("Open circles: true positions; dots: estimates, joined by their errors; "
          "squares: anchors."))
      << caption();
  for (Eigen::Index i = 0; i < 20; ++i)
    if (i != 0 && i != 5) map.ground_truth_m->row(i).setConstant(NAN);
  EXPECT_TRUE(
      has("Dots: estimates; squares: given positions of anchors, joined to their "
          "estimates."))
      << caption();
  map = sample_map(20, 0.1, 1);
  map.anchors.clear();
  EXPECT_TRUE(has("joined by their errors.")) << caption();
}

TEST(MapFigure, ListsLandmarksWithoutAPlaceAndDrawsTheRest) {
  MapRecord map = sample_map(20, 0.1, 1);
  map.estimate.row(3).setConstant(NAN);
  map.ground_truth_m->row(5).setConstant(NAN);
  const Figure figure = map_figure(map, "map");
  EXPECT_TRUE(has_note(figure, "Not on the map: L04."));
  EXPECT_EQ(layer_of<Scatter>(figure, "estimate").x.size(), 19u);
  EXPECT_EQ(layer_of<Segments>(figure, "error").x0.size(), 18u);
}

TEST(MapFigure, ShowsAnEstimateFarOutsideAsAnArrowAndSaysSo) {
  MapRecord map = sample_map(50, 0.05, 1);
  map.estimate.row(20) << 101.0, -40.0;
  const Figure figure = map_figure(map, "map");
  EXPECT_TRUE(has_note(figure, "Arrows: 1 estimate outside the image, up to"));
  const auto arrows = layer_of<Segments>(figure, "estimate outside");
  ASSERT_EQ(arrows.x1.size(), 1u);
  EXPECT_TRUE(arrows.arrow);
  EXPECT_LT(arrows.x1[0], 4.0);
  EXPECT_EQ(arrows.marks[0].data.at(2), (std::pair<std::string, std::string>{"x", "101"}));
  EXPECT_LT(figure.panels[0].x.limits->high, 4.0);
}

TEST(MapFigure, DrawsStatusesAndKeepsThemInTheCaption) {
  MapRecord map = sample_map(20, 0.1, 1);
  map.statuses = {status_with_message(StatusCode::kBridged, "The graph was in 2 pieces."),
                  status_with_message(StatusCode::kNotConverged, "not converged")};
  const Figure figure = map_figure(map, "map");
  EXPECT_TRUE(has_note(figure, "The graph was in 2 pieces."));
  EXPECT_TRUE(has_note(figure, "not converged"));
  EXPECT_NE(figure.caption.find("The graph was in 2 pieces."), std::string::npos);
}

TEST(MapFigure, WithoutAGroundTruthSaysThatTheFrameIsArbitrary) {
  MapRecord map = sample_map(20, 0.1, 1);
  map.frame = Frame::kSimilarity;
  map.anchors.clear();
  const Figure figure = map_figure(map, "map");  // A ground truth in another frame is not drawn.
  EXPECT_TRUE(has_note(figure, "translation, rotation, scale and reflection are arbitrary"));
  EXPECT_NE(figure.caption.find("arbitrary"), std::string::npos);
  EXPECT_EQ(figure.panels[0].x.label.find("[m]"), std::string::npos);
  for (const Layer& layer : figure.panels[0].layers)
    EXPECT_FALSE(std::holds_alternative<Segments>(layer));
}

TEST(MapFigure, RefusesARecordWhosePartsDisagree) {
  MapRecord map = sample_map(20, 0.1, 1);
  map.names.pop_back();
  EXPECT_THROW(map_figure(map, "map"), InvalidInput);
  map = sample_map(20, 0.1, 1);
  map.anchors.push_back(20);
  EXPECT_THROW(map_figure(map, "map"), InvalidInput);
  map = sample_map(20, 0.1, 1);
  map.estimate(0, 0) = INFINITY;
  EXPECT_THROW(map_figure(map, "map"), InvalidInput);
  map = sample_map(20, 0.1, 1);
  map.ground_truth_m->conservativeResize(19, 2);
  EXPECT_THROW(map_figure(map, "map"), InvalidInput);
}

TEST(ErrorCurveFigure, HasALineAndABandForEachCurve) {
  const Figure figure = error_curve_figure(sample_curves(3, 1));
  EXPECT_EQ(figure.panels[0].layers.size(), 6u);
  const auto line = layer_of<Polyline>(figure, "SMACOF, equal weights");
  EXPECT_EQ(line.mark.id, "method-2-mean");
  EXPECT_EQ(line.y, sample_curves(3, 1).curves[1].mean);
  EXPECT_EQ(figure.panels[0].x.label, "observations (steps)");
  EXPECT_EQ(figure.panels[0].y.scale, Scale::kLinear);
  EXPECT_EQ(figure.panels[0].y.limits->low, 0.0);
}

TEST(ErrorCurveFigure, CurvesDifferInMarkerAndDashNotInColourAlone) {
  const Figure figure = error_curve_figure(sample_curves(7, 1));
  std::vector<std::pair<Marker, Dash>> styles;
  for (const Layer& layer : figure.panels[0].layers)
    if (const auto* line = std::get_if<Polyline>(&layer))
      styles.emplace_back(line->marker, line->dash);
  for (std::size_t i = 0; i < styles.size(); ++i)
    for (std::size_t j = i + 1; j < styles.size(); ++j) EXPECT_NE(styles[i].first, styles[j].first);
}

TEST(ErrorCurveFigure, TurnsLogarithmicWhenTheSpanIsLarge) {
  ErrorCurveSpec spec = sample_curves(2, 1);
  for (double& value : spec.curves[0].mean) value *= 100.0;
  spec.curves[1].low[0] = -1.0;  // A band may reach below what a log axis can show.
  const Figure figure = error_curve_figure(spec);
  EXPECT_EQ(figure.panels[0].y.scale, Scale::kLog);
  EXPECT_EQ(problem(figure), "");
}

TEST(ErrorCurveFigure, TellsTheEndsOfEachCurveInWords) {
  ErrorCurveSpec spec = sample_curves(1, 1);
  spec.curves[0].mean.front() = 0.8;
  spec.curves[0].mean.back() = NAN;
  spec.curves[0].mean[10] = 0.2;
  EXPECT_NE(error_curve_figure(spec).alt.find("LPCA: 0.800 at 50, 0.200 at 1800."),
            std::string::npos);
}

TEST(ErrorCurveFigure, RefusesCurvesWhosePartsDisagree) {
  ErrorCurveSpec spec = sample_curves(2, 1);
  spec.curves[1].mean.pop_back();
  EXPECT_THROW(error_curve_figure(spec), InvalidInput);
  spec = sample_curves(2, 1);
  spec.curves[1].key = spec.curves[0].key;
  EXPECT_THROW(error_curve_figure(spec), InvalidInput);
  spec = sample_curves(2, 1);
  spec.curves[0].low.clear();
  EXPECT_THROW(error_curve_figure(spec), InvalidInput);
}

TEST(ScoreWords, TakeTheErrorsWithoutAnchorsOnlyWhereTheUsualAreUnknown) {
  EXPECT_EQ(score_text({0.219, 4.7, 0.2, 4.7}), "MPE 0.219 m, MOE 4.70\u00A0%");
  // Every landmark an anchor: no other is left to average over.
  EXPECT_EQ(
      score_text({NAN, 95.0, 0.31, 5.0}),
      "MPE 0.310 m after the best affine fit to all landmarks, MOE 5.00\u00A0% up to a mirror");
  EXPECT_EQ(score_text({NAN, NAN, NAN, 4.2}), "MOE 4.20\u00A0% up to a mirror");
  EXPECT_EQ(score_text({NAN, NAN, NAN, NAN}), "");
  EXPECT_EQ(title_with_error("A map", Score{0.219, 4.7, 0.2, 4.7}),
            "A map: 0.219 m off in the mean");
  EXPECT_EQ(title_with_error("A map", Score{NAN, 95.0, 0.31, 5.0}),
            "A map: 0.310 m off after the best affine fit");
  EXPECT_EQ(title_with_error("A map", Score{NAN, NAN, NAN, 4.2}), "A map");
  EXPECT_EQ(title_with_error("A map", std::nullopt), "A map");
}

TEST(ScoreWords, NameTheAnchorThatAMapMissesMost) {
  MapRecord record;
  record.names = {"a", "b", "c"};
  record.estimate.resize(3, 2);
  record.estimate << 0, 0, 4, 1, 2, 1;
  EXPECT_FALSE(worst_anchor(record));
  record.ground_truth_m = record.estimate;
  (*record.ground_truth_m)(1, 1) += 0.3;
  (*record.ground_truth_m)(2, 1) += 2.0;  // No anchor.
  record.anchors = {0, 1};
  ASSERT_TRUE(worst_anchor(record));
  EXPECT_EQ(worst_anchor(record)->name, "b");
  EXPECT_NEAR(worst_anchor(record)->share_percent, 7.5, 1e-9);  // 0.3 m of 4 m.
  EXPECT_FALSE(worst_anchor(record)->is_contradicted);
  EXPECT_EQ(title_with_error("A map", record), "A map: up to 0.300 m off at 2 anchors (b)");
  (*record.ground_truth_m)(1, 1) += 0.2;
  EXPECT_TRUE(worst_anchor(record)->is_contradicted);
  record.score = Score{0.219, 4.7, 0.2, 4.7};
  EXPECT_EQ(title_with_error("A map", record), "A map: 0.219 m off in the mean");
  record.frame = Frame::kSimilarity;  // No metres.
  EXPECT_FALSE(worst_anchor(record));
}

TEST(ScoreWords, NameNoAnchorOfThreeThatAnyMapMeets) {
  MapRecord record;
  record.names = {"a", "b", "c", "d"};
  record.estimate.resize(4, 2);
  record.estimate << 0, 0, 4, 1, 2, 3, 1, 1;
  record.ground_truth_m = record.estimate;
  (*record.ground_truth_m)(1, 1) += 1e-15;
  record.anchors = {0, 1, 2};
  EXPECT_FALSE(worst_anchor(record));
  EXPECT_EQ(title_with_error("A map", record), "A map");
  record.anchors = {0, 1, 2, 3};
  EXPECT_TRUE(worst_anchor(record));
}

}  // namespace
}  // namespace mapproof::test
