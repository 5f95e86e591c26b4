#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "render/figures/curves/best_line.hpp"
#include "render/figures/curves/error_curve.hpp"
#include "render/figures/curves/method_series.hpp"
#include "tests/support/samples/drawn_panels.hpp"
#include "tests/support/samples/sample_studies.hpp"

namespace mapproof::test {
namespace {

TEST(SeriesStyle, NoTwoOfTheFirstTwentyOneAreAlike) {
  std::set<std::tuple<ThemeColour, Dash, Marker>> styles;
  std::set<std::pair<Dash, Marker>> grey;
  for (std::size_t i = 0; i < 21; ++i) {
    const SeriesStyle style = series_style(i);
    EXPECT_TRUE(styles.insert({style.colour, style.dash, style.marker}).second) << i;
    grey.insert({style.dash, style.marker});
    if (i == 9) {
      EXPECT_EQ(grey.size(), 10u);  // In grey.
    }
  }
}

TEST(ErrorAxis, IsLogarithmicOnlyWhereTheMeansSpanMuch) {
  EXPECT_EQ(error_axis({0.1, 1.0}, {}).scale, Scale::kLinear);
  EXPECT_EQ(error_axis({0.1, 1.0}, {}, 6.0).scale, Scale::kLog);
  EXPECT_EQ(error_axis({0.0, 9.0}, {}, 6.0).scale, Scale::kLinear);
  EXPECT_EQ(error_axis({NAN}, {}).limits, (Range{0.0, 1.0}));
}

TEST(ErrorAxis, DoesNotBeginAt0WhereAllValuesLieInItsUppermostPart) {
  EXPECT_EQ(error_axis({0.2, 1.0}, {}).limits.low, 0.0);
  const Range near_one = error_axis({0.99, 1.0}, {0.985, 1.0}).limits;
  EXPECT_GT(near_one.low, 0.98);
  EXPECT_LT(near_one.low, 0.985);
  EXPECT_LT(near_one.high, 1.01);
  EXPECT_EQ(error_axis({1.0, 1.0}, {}).limits.low, 0.0);  // No difference to be seen.
}

TEST(SeriesOf, KeepsWhatIsAskedForAndGivesOthersStylesThatAreLeft) {
  using Asked = std::vector<std::optional<std::size_t>>;
  using Series = std::vector<std::size_t>;
  EXPECT_EQ(series_of(Asked{7, 2, 5}), (Series{7, 2, 5}));
  EXPECT_EQ(series_of(Asked{7, 2, 7}), (Series{7, 2, kMethodStyles}));
  EXPECT_EQ(series_of(Asked{7, std::nullopt}), (Series{7, kMethodStyles}));
  EXPECT_EQ(series_of(Asked{std::nullopt, std::nullopt}), (Series{0, 1}));
}

TEST(SeriesOfMethods, AreThoseOfMappingMethodsWhateverTheirParameter) {
  const auto series =
      series_of_methods({"isomap", "isomap-K6", "kpca-gaussian-sigma2-0.5", "mine"});
  EXPECT_EQ(series[0], method_series(Method::kIsomap));
  EXPECT_EQ(series[1], series[0]);
  EXPECT_EQ(series[2], method_series(Method::kKpcaGaussian));
  EXPECT_GE(series[3], kMethodStyles);
}

TEST(SeriesOfMethods, OfOneStudyDoNotDependOnItsOtherMethods) {
  const std::size_t fixed = series_of_methods({"fixed"})[0];
  EXPECT_EQ(series_of_methods({"stress", "fixed", "isomap"})[1], fixed);
  EXPECT_GE(fixed, kMethodStyles);
}

TEST(SeriesOfMethods, OfUnknownMethodsAreTheFirst) {
  EXPECT_EQ(series_of_methods({"ekf", "fastslam"}), (std::vector<std::size_t>{0, 1}));
}

ErrorLine three_points(const std::string& label, std::vector<double> mean, double half_width) {
  ErrorLine line{.label = label, .key = "key", .x = {1, 2, 3}, .mean = std::move(mean)};
  for (const double value : line.mean) {
    line.low.push_back(value - half_width);
    line.high.push_back(value + half_width);
  }
  return line;
}

TEST(BestLine, IsNamedWithItsValueAtTheEnd) {
  const std::vector<ErrorLine> lines = {three_points("A", {3, 2, 0.25}, 0.01),
                                        three_points("B", {1, 1, 1}, 0.01)};
  EXPECT_EQ(best_at_end(lines, {}, "after {} steps"),
            "A has the lowest MPE after 3 steps, 0.25\u00A0m");
  EXPECT_EQ(best_at_end(lines, {"share", "%", false}, "at {}"),
            "B has the highest share at 3, 1.0\u00A0%");
}

TEST(BestLine, IsNamedWithThoseWhoseIntervalsOverlapItsOwn) {
  const std::vector<ErrorLine> lines = {three_points("A", {3, 2, 0.25}, 0.1),
                                        three_points("B", {1, 1, 0.3}, 0.1),
                                        three_points("C", {1, 1, 0.9}, 0.1)};
  EXPECT_EQ(best_at_end(lines, {}, "after {} steps"),
            "A and B have the lowest MPE after 3 steps, from 0.25\u00A0m");
}

TEST(BestLine, OverAnAxisIsOneOrChanges) {
  const ErrorLine a = three_points("A", {1, 2, 3}, 0.1), b = three_points("B", {2, 2.5, 1}, 0.1);
  EXPECT_EQ(best_over({a, b}, {}, line_axis("noise [°]")),
            "A has the lowest MPE at noise = 1°, B at 3°");
  EXPECT_EQ(best_over({a, three_points("C", {4, 4, 4}, 0.1)}, {}, {"noise"}),
            "A has the lowest MPE throughout");
  EXPECT_EQ(best_over({a, a}, {}, {"noise"}), "");  // Neither is better.
  EXPECT_EQ(best_over({}, {}, {"noise"}), "");
  EXPECT_EQ(best_of_all({a, b}, {}, {"K"}), "A has the lowest MPE, 1.0\u00A0m at K = 1");
  EXPECT_EQ(best_of_all({a}, {}, {"K"}), "the lowest MPE of A is 1.0\u00A0m at K = 1");
}

TEST(ErrorLinesFigure, EndsItsAxisAtTheCeilingAndCountsWhatLiesAbove) {
  ErrorLinesSpec spec;
  spec.id = "lines";
  ErrorPanel& panel = spec.panels.emplace_back();
  panel.lines.push_back({.label = "one",
                         .key = "one",
                         .x = {1, 2, 3},
                         .mean = {1e11, 30.0, 0.2},
                         .low = {},
                         .high = {}});
  panel.points.push_back({"printed", "one", 2.0, 1e6, Marker::kSquare});
  spec.ceiling = 50.0;
  const Figure figure = error_lines_figure(spec);
  EXPECT_LT(figure.panels[0].y.limits->high, 100.0);
  ASSERT_EQ(figure.notes.size(), 1U);
  EXPECT_EQ(figure.notes[0].text, "2 values lie above the frame.");
  // The line does not lead to what is not there; a mark inside the frame says where it would.
  const Polyline line = layers_of<Polyline>(figure.panels[0]).at(0);
  EXPECT_TRUE(std::isnan(line.y[0]));
  EXPECT_EQ(line.y[2], 0.2);
  const Scatter above = layers_of<Scatter>(figure.panels[0]).back();
  EXPECT_EQ(above.x, std::vector{1.0});
  EXPECT_LT(above.y.at(0), figure.panels[0].y.limits->high);
  EXPECT_GT(above.y.at(0), 30.0);
  spec.ceiling = 1e12;
  EXPECT_TRUE(error_lines_figure(spec).notes.empty());
}

TEST(ErrorByParameterFigure, HasAPanelForEachKindOfParameter) {
  const Figure figure = error_by_parameter_figure(sample_parameters());
  ASSERT_EQ(figure.panels.size(), 3u);
  EXPECT_TRUE(figure.shared_y);
  EXPECT_EQ(figure.panels[0].x.label, "K");
  EXPECT_EQ(figure.panels[1].x.scale, Scale::kLog);
  EXPECT_EQ(layers_of<Polyline>(figure.panels[0]).size(), 6u);
}

TEST(ErrorByParameterFigure, MarksOurOptimumOnTheLineAndThePapersAtItsPrintedValue) {
  const ErrorByParameterSpec spec = sample_parameters();
  const Panel panel = error_by_parameter_figure(spec).panels[0];
  const auto ours = labelled<Scatter>(panel, "our optimum").value();
  EXPECT_EQ(ours.x.at(0), 6.0);
  EXPECT_EQ(ours.y.at(0), spec.groups[0].methods[0].line.mean[2]);
  const auto paper = labelled<Scatter>(panel, "the paper's optimum").value();
  EXPECT_EQ(paper.x.at(0), 5.0);
  EXPECT_EQ(paper.y.at(0), 0.206);
}

TEST(ErrorByParameterFigure, SaysBothOptimaInWords) {
  const Figure figure = error_by_parameter_figure(sample_parameters());
  EXPECT_TRUE(contains(figure.alt, "SDE: 0.167 at K = 5, in the paper 0.138 at K = 7."))
      << figure.alt;
}

TEST(ErrorByParameterFigure, RefusesLinesWhosePartsDisagree) {
  ErrorByParameterSpec spec = sample_parameters();
  spec.groups[0].methods[0].line.mean.pop_back();
  EXPECT_THROW(error_by_parameter_figure(spec), InvalidInput);
  spec = sample_parameters();
  spec.groups[0].methods[1].line.key = spec.groups[0].methods[0].line.key;
  EXPECT_THROW(error_by_parameter_figure(spec), InvalidInput);
}

TEST(ErrorByParameterFigure, LeavesAnOptimumWithoutAnErrorOut) {
  ErrorByParameterSpec spec = sample_parameters();
  spec.groups.resize(1);
  spec.groups[0].methods.resize(1);
  const auto optimum = [&spec] {
    return labelled<Scatter>(error_by_parameter_figure(spec).panels[0], "our optimum");
  };
  EXPECT_TRUE(optimum().has_value());
  spec.groups[0].methods[0].ours = ParameterValue{99.0, NAN};
  EXPECT_FALSE(optimum().has_value());
}

}  // namespace
}  // namespace mapproof::test
