#include "render/figures/maps/path_map.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "render/figures/maps/covariance_ellipse.hpp"
#include "render/figures/maps/path_styles.hpp"
#include "tests/support/samples/drawn_panels.hpp"
#include "tests/support/samples/sample_slam.hpp"

namespace mapproof::test {
namespace {

const std::vector<SlamMethod> kShown = {SlamMethod::kDeadReckoning, SlamMethod::kSpectral,
                                        SlamMethod::kRefined};

Figure figure_of(const SlamRun& run) { return path_map_figure({"fig-2b", "Plaza 1", run, kShown}); }

TEST(PathMap, HasTheMapAboveAndTheErrorsBelow) {
  const Figure figure = figure_of(sample_drive("plaza-1", 2000, 1));
  ASSERT_EQ(figure.panels.size(), 2u);
  EXPECT_EQ(figure.columns, 1u);
  EXPECT_TRUE(figure.panels[0].equal_aspect);
  EXPECT_EQ(figure.panels[0].x.label, "x [m]");
  EXPECT_EQ(figure.panels[1].x.label, "time [s]");
  EXPECT_EQ(figure.panels[1].y.scale, Scale::kLog);
}

TEST(PathMap, DrawsTheGroundTruthBelowAndEachMethodInItsOwnColour) {
  const Panel map = figure_of(sample_drive("plaza-1", 2000, 1)).panels[0];
  const auto paths = layers_of<Polyline>(map);
  ASSERT_EQ(paths.size(), 4u);
  EXPECT_EQ(paths[0].label, "true path");
  EXPECT_GT(paths[0].width, 2.0 * paths[2].width);
  EXPECT_EQ(paths[0].colour, ThemeColour::kFaint);
  for (std::size_t i = 0; i < kShown.size(); ++i) {
    EXPECT_EQ(paths[i + 1].label, info(kShown[i]).label);
    EXPECT_EQ(paths[i + 1].colour, path_style(kShown[i]).colour);
    EXPECT_EQ(paths[i + 1].dash, path_style(kShown[i]).dash) << "as its errors below";
  }
}

TEST(PathMap, ThinsTenThousandPosesToWhatTheEyeCanSee) {
  const SlamRun run = sample_drive("plaza-1", 10000, 1);
  const Figure figure = figure_of(run);
  const auto ground_truth = labelled<Polyline>(figure.panels[0], "true path").value();
  EXPECT_LT(ground_truth.x.size(), 80u);  // Eleven lanes and their ends.
  EXPECT_EQ(ground_truth.x.front(), run.log.ground_truth->positions_m(0, 0));
  EXPECT_EQ(ground_truth.y.back(), run.log.ground_truth->positions_m(9999, 1));
  for (const auto& line : layers_of<Polyline>(figure.panels[1])) EXPECT_LE(line.x.size(), 80u);
}

TEST(PathMap, ShowsTheErrorsOfEachMethodWithMeanAndAlignment) {
  const SlamRun run = sample_drive("plaza-1", 2000, 1);
  const Panel errors = figure_of(run).panels[1];
  const auto line = labelled<Polyline>(errors, "dead reckoning: 9.83 m, unaligned");
  ASSERT_TRUE(line);
  // The median of each of 80 pieces of the drive, which lasts 1000 s.
  ASSERT_EQ(line->x.size(), 80U);
  EXPECT_NEAR(line->x.front(), 6.25, 0.5);
  std::vector<double> last(run.records[0].error_m.end() - 25, run.records[0].error_m.end());
  std::ranges::sort(last);
  EXPECT_NEAR(line->y.back(), last[12], 0.02 * last[12]);
  EXPECT_TRUE(labelled<Polyline>(errors, "refined, scale free: 0.123 m, rigid"));
  const auto expected = labelled<Polyline>(errors, "expected by the covariance").value();
  EXPECT_NEAR(expected.y[0], 2.0 * 0.15 * std::sqrt(2.0), 1e-12);
}

TEST(PathMap, EnlargesEllipsesByAFactorThatItTells) {
  const SlamRun run = sample_drive("plaza-1", 2000, 1);
  const Figure figure = figure_of(run);
  const auto ellipses = labelled<Ellipses>(figure.panels[0], "refined, scale free").value();
  const Ellipse own = covariance_ellipse(run.records[5].estimate.landmark_cov_m2[2]);
  EXPECT_NEAR(ellipses.a[2], 5.0 * own.a, 1e-12);
  EXPECT_NEAR(ellipses.b[2], 5.0 * own.b, 1e-12);
  EXPECT_TRUE(labelled<Ellipses>(figure.panels[0], "95 % ellipse, 5 × as large")) << "the legend";
  EXPECT_TRUE(contains(figure.caption, "enlarged 5 times"));
  EXPECT_TRUE(contains(figure.caption, "the true path (the wide band)")) << "grey in one theme";
}

TEST(PathMap, CutsNoEllipseOfALandmarkAtTheFrame) {
  SlamRun run = sample_drive("plaza-1", 2000, 1);
  const Panel usual = figure_of(run).panels[0];
  run.records[5].estimate.landmarks_m.row(0) << usual.x.limits->low, usual.y.limits->high;
  const Panel map = figure_of(run).panels[0];
  const auto ellipses = labelled<Ellipses>(map, "refined, scale free").value();
  ASSERT_EQ(ellipses.x[0], usual.x.limits->low);
  for (std::size_t i = 0; i < ellipses.x.size(); ++i)
    for (double angle = 0.0; angle < 6.3; angle += 0.1) {
      const double a = ellipses.a[i] * std::cos(angle), b = ellipses.b[i] * std::sin(angle);
      const double cos = std::cos(ellipses.rotation_rad[i]),
                   sin = std::sin(ellipses.rotation_rad[i]);
      const double x = ellipses.x[i] + a * cos - b * sin, y = ellipses.y[i] + a * sin + b * cos;
      EXPECT_TRUE(map.x.limits->low < x && x < map.x.limits->high) << i;
      EXPECT_TRUE(map.y.limits->low < y && y < map.y.limits->high) << i;
    }
}

TEST(PathMap, CutsAnEllipseFarLargerThanTheMapAndSaysSo) {
  SlamRun run = sample_drive("plaza-1", 2000, 1);
  const auto width = [](const Figure& figure) {
    const Range x = *figure.panels[0].x.limits;
    return x.high - x.low;
  };
  const double usual = width(figure_of(run));
  EXPECT_FALSE(notes_contain(figure_of(run), "beyond the frame"));
  run.records[5].estimate.landmark_cov_m2[2] = Eigen::Matrix2d::Identity() * 1e6;
  const Figure figure = figure_of(run);
  EXPECT_LE(width(figure), 2.0 * usual);
  EXPECT_TRUE(notes_contain(figure,
                            "refined, scale free: 1 ellipse beyond the frame; half the "
                            "longest axis, of " +
                                run.log.landmarks[2] + ", is 2448 m."));
}

/// What pages hide with an entry of the legend.
std::string curve_of(const Mark& mark) {
  for (const auto& [key, value] : mark.data)
    if (key == "curve") return value;
  return "";
}

TEST(PathMap, TellsPagesWhichEntryOfTheLegendEachMarkBelongsTo) {
  const Figure figure = figure_of(sample_drive("plaza-1", 2000, 1));
  for (const Panel& panel : figure.panels) {
    for (const auto& line : layers_of<Polyline>(panel)) EXPECT_EQ(curve_of(line.mark), line.label);
    for (const auto& points : layers_of<Scatter>(panel))
      for (const Mark& mark : points.marks) EXPECT_EQ(curve_of(mark), points.label);
    for (const auto& ellipses : layers_of<Ellipses>(panel))
      for (const Mark& mark : ellipses.marks) EXPECT_EQ(curve_of(mark), ellipses.label);
  }
}

TEST(PathMap, MarksLandmarksAsKnownOnlyWhereAMethodWasGivenThem) {
  const SlamRun walk = sample_walk();
  const Panel with =
      path_map_figure({"fig-1a", "", walk, {SlamMethod::kSpectralKnown, SlamMethod::kSpectral}})
          .panels[0];
  EXPECT_EQ(labelled<Scatter>(with, "landmark, known")->x.size(), 4u);
  EXPECT_EQ(labelled<Scatter>(with, "landmark, true")->x.size(), 2u);
  const Panel without = path_map_figure({"fig-1a", "", walk, {SlamMethod::kSpectral}}).panels[0];
  EXPECT_FALSE(labelled<Scatter>(without, "landmark, known"));
  EXPECT_EQ(labelled<Scatter>(without, "landmark, true")->x.size(), 6u);
}

TEST(PathMap, ClaimsNoErrorWithoutAGroundTruth) {
  SlamRun run = sample_drive("plaza-1", 2000, 1);
  run.log.ground_truth.reset();
  run.log.true_landmarks.reset();
  for (SlamRecord& record : run.records) record.errors.clear(), record.error_m.clear();
  const Figure figure = figure_of(run);
  EXPECT_EQ(figure.panels.size(), 1u);
  EXPECT_FALSE(contains(figure.alt, "error"));
  EXPECT_FALSE(contains(figure.caption, "true"));
}

TEST(PathMap, NamesAPathThatLeavesTheImageAndKeepsTheImage) {
  SlamRun run = sample_drive("plaza-1", 2000, 1);
  run.records[0].estimate.path.positions_m *= 100.0;
  const Figure figure = figure_of(run);
  EXPECT_TRUE(notes_contain(figure, "Outside the image: dead reckoning."));
  EXPECT_LT(figure.panels[0].x.limits->high, 150.0);
}

TEST(PathMap, NamesMethodsWithoutAPathAndWhy) {
  SlamRun run = sample_drive("plaza-1", 200, 1);
  run.records[3].estimate = {};
  run.records[3].error_m.clear();
  run.records[3].estimate.statuses = {
      status_with_message(StatusCode::kDegenerateGeometry, "The path is a line.")};
  const Figure figure = figure_of(run);
  EXPECT_TRUE(notes_contain(figure, "spectral, 4-D: The path is a line."));
  EXPECT_FALSE(labelled<Polyline>(figure.panels[0], "spectral, 4-D"));
}

TEST(PathMap, RefusesPartsThatDisagree) {
  const auto refused = [](auto change) {
    SlamRun run = sample_drive("plaza-1", 100, 1);
    change(run);
    EXPECT_THROW(figure_of(run), InvalidInput);
  };
  refused([](SlamRun& run) { run.records[0].error_m.pop_back(); });
  refused([](SlamRun& run) { run.log.landmarks.pop_back(); });
  refused([](SlamRun& run) { run.known = {4}; });
  refused([](SlamRun& run) { run.records[3].estimate.position_cov_rows[0] = 100; });
  refused([](SlamRun& run) { run.records[3].estimate.landmark_cov_m2.pop_back(); });
}

TEST(CovarianceEllipse, HasTheEigenvaluesAsHalfAxes) {
  Eigen::Matrix2d C;
  C << 2.5, 1.5, 1.5, 2.5;  // 4 along the diagonal, 1 across.
  const Ellipse ellipse = covariance_ellipse(C);
  EXPECT_NEAR(ellipse.a / ellipse.b, 2.0, 1e-12);
  EXPECT_NEAR(ellipse.b, std::sqrt(-2.0 * std::log(0.05)), 1e-12);
  EXPECT_NEAR(ellipse.rotation_rad, std::atan(1.0), 1e-12);
  EXPECT_EQ(covariance_ellipse(-C).a, 0.0);
}

}  // namespace
}  // namespace mapproof::test
