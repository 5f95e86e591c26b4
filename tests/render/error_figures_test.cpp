#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "render/figures/curves/error_curve.hpp"
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

TEST(SeriesOf, TakesWhatIsAskedForUnlessTwoWouldStyleAlike) {
  using Asked = std::vector<std::optional<std::size_t>>;
  using Series = std::vector<std::size_t>;
  EXPECT_EQ(series_of(Asked{7, 2, 5}), (Series{7, 2, 5}));
  EXPECT_EQ(series_of(Asked{7, 2, 7}), (Series{0, 1, 2}));
  EXPECT_EQ(series_of(Asked{7, std::nullopt}), (Series{0, 1}));
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
