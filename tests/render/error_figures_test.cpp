#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "render/figures/curves/best_line.hpp"
#include "render/figures/curves/error_curve.hpp"
#include "render/figures/curves/method_series.hpp"
#include "render/figures/unit_scale.hpp"
#include "render/plot/short_names.hpp"
#include "tests/support/samples/drawn_panels.hpp"
#include "tests/support/samples/sample_studies.hpp"

namespace mapproof::test {
namespace {

TEST(SeriesStyle, NoTwoOfTheFirst350AreAlikeAndAnyTenDifferInColour) {
  std::set<std::tuple<ThemeColour, Dash, Marker>> styles;
  std::set<std::pair<Dash, Marker>> grey;
  for (std::size_t i = 0; i < 350; ++i) {
    const SeriesStyle style = series_style(i);
    EXPECT_TRUE(styles.insert({style.colour, style.dash, style.marker}).second) << i;
    grey.insert({style.dash, style.marker});
    if (i == 9) {
      EXPECT_EQ(grey.size(), 10u);  // In grey.
    }
  }
}

TEST(ErrorLinesFigure, CountsSingleRunsOf0ThatALogarithmicAxisDoesNotHave) {
  ErrorLinesSpec spec;
  spec.id = "errors";
  ErrorPanel& panel = spec.panels.emplace_back();
  panel.lines = {{.label = "one", .key = "one", .x = {1.0, 2.0}, .mean = {0.1, 9.0}}};
  panel.points = {{"runs", "one", 1.0, 0.0}, {"runs", "one", 1.0, 0.2}};
  const Figure figure = error_lines_figure(spec);
  EXPECT_EQ(figure.panels[0].y.scale, Scale::kLog);
  ASSERT_EQ(figure.notes.size(), 1U);
  EXPECT_EQ(figure.notes[0].text, "1 value lies below the frame.");
}

TEST(ErrorLinesFigure, NamesLinesOfOneLabelBesideTheirLastPoints) {
  ErrorLinesSpec spec;
  spec.id = "errors";
  spec.panels.emplace_back().lines = {
      {.label = "one", .key = "a", .x = {1.0, 2.0}, .mean = {1.0, NAN}, .end_label = "K = 5"},
      {.label = "one", .key = "b", .x = {1.0, 2.0}, .mean = {1.0, 2.0}, .end_label = "K = 6"},
      {.label = "other", .key = "c", .x = {1.0, 2.0}, .mean = {1.0, 3.0}}};
  const Figure figure = error_lines_figure(spec);
  const auto* ends = std::get_if<PointLabels>(&figure.panels[0].layers.back());
  ASSERT_NE(ends, nullptr);
  EXPECT_EQ(ends->text, (std::vector<std::string>{"K = 5", "K = 6"}));
  EXPECT_EQ(ends->x, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(ends->y, (std::vector<double>{1.0, 2.0}));
}

TEST(ErrorLinesFigure, NamesInItsAltTextThePointsAsTheAxisDoes) {
  ErrorLinesSpec spec;
  spec.id = "errors";
  ErrorPanel& panel = spec.panels.emplace_back();
  panel.x = {.label = "nightly run: date", .names = {"7: 11-22", "8: 11-23", "9: 11-24"}};
  panel.lines = {{.label = "one", .key = "a", .x = {0.0, 1.0, 2.0}, .mean = {1.0, 2.0, 3.0}}};
  const Figure figure = error_lines_figure(spec);
  EXPECT_TRUE(contains(figure.alt, "one: least 1.00 at 7: 11-22, 3.00 at 9: 11-24.")) << figure.alt;
}

TEST(ErrorAxis, IsLogarithmicOnlyWhereTheMeansSpanMuch) {
  EXPECT_EQ(error_axis({0.1, 1.0}, {}).scale, Scale::kLinear);
  EXPECT_EQ(error_axis({0.1, 1.0}, {}, 6.0).scale, Scale::kLog);
  EXPECT_EQ(error_axis({0.0, 9.0}, {}, 6.0).scale, Scale::kLinear);
  EXPECT_EQ(error_axis({NAN}, {}).limits, (Range{0.0, 1.0}));
  // A single run may be 0 where no mean is.
  EXPECT_EQ(error_axis({0.1, 9.0}, {}, 20.0, {0.0, 0.2}).scale, Scale::kLog);
  EXPECT_GT(error_axis({0.1, 9.0}, {}, 20.0, {0.0, 0.2}).limits.low, 0.0);
  EXPECT_EQ(error_axis({0.1, 1.0}, {}, 20.0, {0.0, 0.2}).limits.low, 0.0);
  EXPECT_EQ(error_axis({0.1, 9.0}, {}, 20.0, {-0.2}).scale, Scale::kLinear);
}

TEST(ErrorAxis, DoesNotBeginAt0WhereAllValuesLieInItsUppermostPart) {
  EXPECT_EQ(error_axis({0.2, 1.0}, {}).limits.low, 0.0);
  const Range near_one = error_axis({0.99, 1.0}, {0.985, 1.0}).limits;
  EXPECT_GT(near_one.low, 0.98);
  EXPECT_LT(near_one.low, 0.985);
  EXPECT_LT(near_one.high, 1.01);
  EXPECT_EQ(error_axis({1.0, 1.0}, {}).limits.low, 0.0);  // No difference to be seen.
}

TEST(ErrorAxis, HoldsIntervalsAsFarAsTheyTakeNoMoreOfItThanTheMeans) {
  EXPECT_GT(error_axis({0.1, 3.0}, {0.05, 20.0}).limits.high, 20.0);
  const Range far = error_axis({0.1, 3.0}, {0.05, 1e6}).limits;
  EXPECT_GT(far.high, 90.0);
  EXPECT_GT(std::log(3.0 / 0.1), 0.4 * std::log(far.high / far.low));
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
  const auto series = series_of_methods({"isomap-K6", "kpca-gaussian-sigma2-0.5", "mine"});
  EXPECT_EQ(series[0], method_series(Method::kIsomap));
  EXPECT_EQ(series[1], method_series(Method::kKpcaGaussian));
  EXPECT_GE(series[2], kMethodStyles);
  // The rule that takes one map whatever the criteria say.
  EXPECT_EQ(series_of_methods({"stress", "fixed"})[1], method_series(Method::kIsomap));
}

TEST(SeriesOfMethods, DifferForTwoSettingsOfAMethodUnderTwoLabels) {
  const auto alike = series_of_methods({"isomap-K6", "isomap-K8"}, {"ISOMAP", "ISOMAP"});
  EXPECT_EQ(alike[1], alike[0]);
  const auto series = series_of_methods({"isomap-K6", "isomap-K8", "lpca"});
  EXPECT_EQ(series[0], method_series(Method::kIsomap));
  EXPECT_EQ(series[2], method_series(Method::kLpca));
  EXPECT_NE(series_style(series[1]).colour, series_style(series[0]).colour);
  EXPECT_NE(series_style(series[1]).colour, series_style(series[2]).colour);
}

TEST(SeriesOfMethods, AreOneOfTwoParametersThatNoFigureShowsTogether) {
  const auto series_in = [](const std::set<std::string>& first,
                            const std::set<std::string>& other) {
    return series_of_methods({"isomap-K6", "isomap-K9"}, {"ISOMAP, K = 6", "ISOMAP, K = 9"},
                             {first, other});
  };
  const auto apart = series_in({"visibility"}, {"bearing"});
  EXPECT_EQ(apart[0], apart[1]);
  const auto together = series_in({"visibility"}, {"visibility", "bearing"});
  EXPECT_NE(together[0], together[1]);
}

TEST(SeriesOfMethods, OfOneStudyDoNotDependOnItsOtherMethods) {
  const std::size_t random = series_of_methods({"random"})[0];
  EXPECT_EQ(series_of_methods({"stress", "random", "isomap"})[1], random);
  EXPECT_GE(random, kMethodStyles);
}

std::size_t colours_of(const std::vector<std::size_t>& series) {
  std::set<ThemeColour> colours;
  for (const std::size_t one : series) colours.insert(series_style(one).colour);
  return colours.size();
}

TEST(SeriesOfMethods, OfTheFirstTenOfAStudyHaveTenColours) {
  EXPECT_EQ(
      colours_of(series_of_methods({"visibility", "visibility-order", "bearing", "bearing-order",
                                    "range", "range-order", "equal", "reliable", "joint"})),
      9U);
  std::vector<std::string> ids = {"isomap", "kpca-polynomial-d2", "lpca"};
  for (int i = 0; i < 7; ++i) ids.push_back("mine-" + std::to_string(i));
  EXPECT_EQ(colours_of(series_of_methods(ids)), 10U);
  std::vector<std::size_t> mapping;
  for (const MethodInfo& method : all_methods())
    if (!method.approximates) mapping.push_back(method_series(method.method));
  EXPECT_EQ(colours_of(mapping), 10U);
}

TEST(SeriesOfMethods, OfMoreThanTenComeAgainWithOtherDashesAndMarkers) {
  std::vector<std::string> ids;
  for (int i = 0; i < 25; ++i) ids.push_back("mine-" + std::to_string(i));
  std::set<std::tuple<ThemeColour, Dash, Marker>> styles;
  for (const std::size_t one : series_of_methods(ids)) {
    const SeriesStyle style = series_style(one);
    styles.insert({style.colour, style.dash, style.marker});
  }
  EXPECT_EQ(styles.size(), 25U);
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

ErrorLine of_means(const std::string& label, std::vector<double> mean) {
  ErrorLine line{.label = label, .key = "key", .mean = std::move(mean)};
  for (std::size_t i = 0; i < line.mean.size(); ++i) line.x.push_back(static_cast<double>(i) + 1.0);
  return line;
}

TEST(BestLine, IsNamedWithItsValueAtTheEnd) {
  const std::vector<ErrorLine> lines = {three_points("A", {3, 2, 0.25}, 0.01),
                                        three_points("B", {1, 1, 1}, 0.01)};
  EXPECT_EQ(best_at_end(lines, {}, "after {} steps"),
            "A has the lowest MPE after 3 steps, 0.250\u00A0m");
  EXPECT_EQ(best_at_end(lines, {"share", "%", false}, "at {}"),
            "B has the highest share at 3, 1.00\u00A0%");
}

TEST(BestLine, IsNamedWithThoseWhoseIntervalsOverlapItsOwn) {
  const std::vector<ErrorLine> lines = {three_points("A", {3, 2, 0.25}, 0.1),
                                        three_points("B", {1, 1, 0.3}, 0.1),
                                        three_points("C", {1, 1, 0.9}, 0.1)};
  EXPECT_EQ(best_at_end(lines, {}, "after {} steps"),
            "A and B have the lowest MPE after 3 steps, 0.250\u00A0m and 0.300\u00A0m");
}

TEST(BestLine, OfManyThatAreEqualIsTheSpanOfTheirValues) {
  std::vector<ErrorLine> lines;
  for (const char* label : {"A", "B", "C", "D"})
    lines.push_back(
        three_points(label, {1, 1, 0.19 + 0.01 * static_cast<double>(lines.size())}, 0.1));
  EXPECT_EQ(best_at_end(lines, {}, "after {} steps"),
            "after 3 steps, all 4 methods have an MPE of 0.190\u00A0m to 0.220\u00A0m");
  EXPECT_EQ(best_at_end({lines[0], lines[1]}, {}, "after {} steps"),
            "after 3 steps, both methods have an MPE of 0.190\u00A0m to 0.200\u00A0m");
  lines.push_back(three_points("LEM, K = 6", {1, 1, 0.9}, 0.1));
  EXPECT_EQ(best_at_end(lines, {}, "after {} steps"),
            "after 3 steps, 4 of 5 methods have an MPE of 0.190\u00A0m to 0.220\u00A0m, LEM "
            "0.900\u00A0m");
}

TEST(BestLine, OfAFamilyIsCalledSo) {
  std::vector<ErrorLine> lines = {three_points("A", {3, 2, 0.25}, 0.01),
                                  three_points("B", {1, 1, 1}, 0.01)};
  LineQuantity mpe;
  mpe.family = "these 2";
  EXPECT_EQ(best_at_end(lines, mpe, "after {} steps"),
            "of these 2, A has the lowest MPE after 3 steps, 0.250\u00A0m");
  mpe.family = "the 2 on a neighbour graph";
  for (ErrorLine& line : lines) line.mean.back() = 0.25;
  lines.push_back(three_points("C", {1, 1, 0.25}, 0.01));
  EXPECT_EQ(best_at_end(lines, mpe, "after {} steps"),
            "after 3 steps, all of the 2 on a neighbour graph have an MPE of 0.250\u00A0m");
}

TEST(BestLine, TiesWithNothingThatDiverged) {
  const ErrorLine a = three_points("A", {0.1, 0.1, 0.1}, 0.01),
                  b = three_points("B", {0.3, 0.3, 0.3}, 0.01),
                  c = three_points("C", {1e4, 1e8, 1e6}, 1e9);
  EXPECT_EQ(best_over({a, b, c}, {}, {"noise"}), "A has the lowest MPE throughout");
  EXPECT_EQ(best_over({a, c}, {}, {"noise"}), "A has the lowest MPE throughout");
  EXPECT_EQ(best_of_points({{a, b, c}}, {}), "A has the lowest MPE at all points");
  EXPECT_EQ(best_over({b, three_points("B too", {0.3, 0.3, 0.3}, 0.01), c}, {}, {"noise"}),
            "B and B too have the lowest MPE throughout");
  // By how much says nothing.
  EXPECT_EQ(best_over({c, three_points("D", {1e5, 1e5, 1e5}, 1.0)}, {}, {"noise"}), "");
  LineQuantity distance;
  distance.great_errors = false;
  EXPECT_EQ(best_over({a, c}, distance, {"noise"}), "");
}

TEST(DivergedWords, NameOneLineAndCountSeveral) {
  const ErrorLine a = of_means("A", {1, 2}), b = of_means("B, K = 5", {1e4, 1e5}),
                  c = of_means("C", {1, 1e5});
  EXPECT_EQ(diverged_words({a}, {}), "");
  EXPECT_EQ(diverged_words({a, b}, {}), "B over 1\u00A0km");
  EXPECT_EQ(diverged_words({a, b, b}, {}), "B over 1\u00A0km") << "of two panels";
  EXPECT_EQ(diverged_words({a, c}, {}), "C over 1\u00A0km at some points");
  EXPECT_EQ(diverged_words({a, b, c}, {}), "2 methods over 1\u00A0km at some points");
  EXPECT_EQ(diverged_words({b}, {}), "") << "the range itself says it";
  EXPECT_EQ(diverged_words({a, b}, {.great_errors = false}), "");
}

TEST(BestLine, IsJudgedByThePairedTestWhereThereIsOne) {
  using enum PairedWithBest;
  ErrorLine a = three_points("A", {1, 2, 3}, 0.3), b = three_points("B", {1.1, 2.1, 3.1}, 0.3);
  a.paired = {kBest, kBest, kBest};
  b.paired = {kWorse, kWorse, kWorse};
  EXPECT_EQ(best_over({a, b}, {}, {"noise"}), "A has the lowest MPE throughout");
  EXPECT_EQ(best_of_points({{a, b}}, {}), "A has the lowest MPE at all points");
  b.paired = {kWorse, kAlike, kUntested};
  EXPECT_EQ(best_over({a, b}, {}, {"noise"}), "A has the lowest MPE wherever they differ");
  EXPECT_EQ(best_over({a, b, three_points("C", {4, 4, 4}, 0.1)}, {}, {"noise"}),
            "A has the lowest MPE at noise\u00A0=\u00A01; elsewhere differences are not "
            "significant");
  // Means of other runs may have another best: then intervals judge.
  b.paired = {kBest, kBest, kBest};
  a.paired = {kWorse, kWorse, kWorse};
  EXPECT_EQ(best_over({a, b}, {}, {"noise"}), "");
  ErrorLine far = three_points("B", {4, 4, 4}, 0.1);
  a.paired = {kBest, kBest, kBest};
  far.paired = {kWorse, kWorse, kAlike};
  EXPECT_EQ(best_of_points({{a, far}}, {}),
            "A has the lowest MPE at all 3 points; differences are not significant at 1");
}

TEST(BestLine, OfAllIsJudgedByTheTestOfOnePointOfEachLine) {
  using enum PairedWithBest;
  ErrorLine a = three_points("A", {1, 2, 3}, 0.3), b = three_points("B", {3, 1.2, 3}, 0.3);
  EXPECT_EQ(best_of_all({a, b}, {}, {"K"}), "") << "intervals overlap";
  a.paired = {kBest, kUntested, kUntested};
  b.paired = {kUntested, kWorse, kUntested};
  EXPECT_EQ(best_of_all({a, b}, {}, {"K"}), "A has the lowest MPE, 1.00\u00A0m at K\u00A0=\u00A01");
  b.paired[1] = kAlike;
  EXPECT_EQ(best_of_all({a, b}, {}, {"K"}), "");
}

TEST(BestLine, TiesAtTheEndAreCounted) {
  const ErrorLine a = three_points("A", {1, 2, 3}, 0.3), b = three_points("B", {1, 2, 3.1}, 0.3),
                  c = three_points("C", {1, 2, 9}, 0.3);
  EXPECT_EQ(ties_at_end({a, b, c}, {}), 2U);
  EXPECT_EQ(ties_at_end({c}, {}), 1U);
  EXPECT_EQ(ties_at_end({}, {}), 0U);
}

TEST(BestLine, IsNoneWhereIntervalsOrShownDigitsTie) {
  EXPECT_EQ(best_over({three_points("A", {1, 2, 3}, 0.3), three_points("B", {1.5, 2.5, 3.5}, 0.3)},
                      {}, {"noise"}),
            "");
  EXPECT_EQ(best_over({three_points("A", {1, 2, 3}, 0.2), three_points("B", {1.5, 2.5, 3.5}, 0.2)},
                      {}, {"noise"}),
            "A has the lowest MPE throughout");
  const ErrorLine a = of_means("A", {0.99691, 1, 2}), b = of_means("B", {0.99696, 3, 4});
  EXPECT_EQ(best_over({a, b}, {}, {"noise"}), "A has the lowest MPE wherever they differ");
  EXPECT_EQ(best_over({a, b, of_means("C", {2, 3, 4})}, {}, {"noise"}),
            "A has the lowest MPE at noise\u00A0=\u00A02 and 3; elsewhere it ties with others");
  EXPECT_EQ(best_over({of_means("A", {0.99691, 1}), of_means("B", {0.99696, 1.001})}, {}, {"K"}),
            "");
  EXPECT_EQ(best_of_points({{a, b}}, {}), "A has the lowest MPE at 2 of 3 points");
  EXPECT_EQ(best_of_all({a, b}, {}, {"K"}), "");
}

TEST(BestLine, OverAnAxisIsOneOrChanges) {
  const ErrorLine a = three_points("A", {1, 2, 3}, 0.1), b = three_points("B", {2, 2.5, 1}, 0.1);
  EXPECT_EQ(best_over({a, b}, {}, line_axis("noise [°]")), "A has the lowest MPE at 1°, B at 3°");
  EXPECT_EQ(best_over({a, b}, {}, line_axis("noise [m]")),
            "A has the lowest MPE at noise\u00A0=\u00A01\u00A0m, B at 3\u00A0m");
  EXPECT_EQ(best_over({a, three_points("C", {4, 4, 4}, 0.1)}, {}, {"noise"}),
            "A has the lowest MPE throughout");
  EXPECT_EQ(best_over({a, three_points("C", {4, 1, 4}, 0.1)}, {}, line_axis("noise [°]")),
            "A has the lowest MPE at 1° and 3°, but not between");
  EXPECT_EQ(best_over({a, a}, {}, {"noise"}), "");  // Neither is better.
  EXPECT_EQ(best_over({}, {}, {"noise"}), "");
  EXPECT_EQ(best_of_all({a, three_points("C", {4, 4, 4}, 0.1)}, {}, {"K"}),
            "A has the lowest MPE, 1.00\u00A0m at K\u00A0=\u00A01");
  EXPECT_EQ(best_of_all({a, b}, {}, {"K"}), "");  // B's best is as good.
  EXPECT_EQ(best_of_all({a}, {}, {"K"}), "the lowest MPE of A is 1.00\u00A0m at K\u00A0=\u00A01");
}

TEST(BestLine, AtBothEndsIsNotDeniedTheBestBetween) {
  const ErrorLine a = of_means("A", {1, 3, 1, 3, 1}), b = of_means("B", {2, 2, 2, 2, 2});
  EXPECT_EQ(best_over({a, b}, {}, line_axis("noise [°]")),
            "A has the lowest MPE at 1° and 5°, but not throughout");
  const ErrorLine c = of_means("C", {1, 3, 2, 3, 1});  // As good as B at 3.
  EXPECT_EQ(best_over({c, b}, {}, line_axis("noise [°]")),
            "C has the lowest MPE at 1° and 5°, but not throughout");
}

TEST(BestLine, WhereverTheyDifferCountsThePointsAtWhichManyAreBest) {
  std::vector<ErrorLine> lines = {of_means("A", {2, 1})};
  for (const char* label : {"B", "C", "D", "E"}) lines.push_back(of_means(label, {1, 2}));
  EXPECT_EQ(best_over(lines, {}, line_axis("noise [°]")),
            "A has the lowest MPE at 2°, but not throughout");
  lines[0].mean[0] = kNaN;  // The others are all equal there.
  EXPECT_EQ(best_over(lines, {}, line_axis("noise [°]")),
            "A has the lowest MPE wherever they differ");
}

TEST(BestLine, IsNotTheBestWhereverTheyDifferWhereItsMeanIsBeaten) {
  // B is lower at 2 and 3, where the intervals are wide.
  ErrorLine a = three_points("A", {1, 26, 53}, 0.1), b = three_points("B", {2, 5, 36}, 0.1);
  a.high = {1.1, 56, 83};
  a.low = {0.9, -4, 23};
  EXPECT_EQ(best_over({a, b}, {}, line_axis("side [m]")),
            "A has the lowest MPE at side\u00A0=\u00A01\u00A0m; elsewhere intervals overlap");
  b.mean = {2, 27, 54};
  EXPECT_EQ(best_over({a, b}, {}, line_axis("side [m]")),
            "A has the lowest MPE wherever they differ");
}

TEST(BestLine, TiesWithTheBestNotWithWhatTiesWithIt) {
  const ErrorLine a = three_points("A", {1, 1, 1}, 0.1),
                  b = three_points("B", {1.15, 1.15, 1.15}, 0.1);
  const ErrorLine c = three_points("C", {1.3, 1.3, 1.3}, 0.1),
                  d = three_points("D", {4, 4, 4}, 0.1);
  EXPECT_EQ(best_over({a, c, d}, {}, {"noise"}), "A has the lowest MPE throughout");
  EXPECT_EQ(best_over({a, b, c, d}, {}, {"noise"}), "A and B have the lowest MPE throughout");
  EXPECT_EQ(best_over({a, b, c}, {}, {"noise"}), "A and B have the lowest MPE throughout");
  EXPECT_EQ(best_over({a, b}, {}, {"noise"}), "");
  // Another one ties with A at each.
  const ErrorLine e = three_points("E", {1.15, 4, 1.15}, 0.1),
                  f = three_points("F", {4, 1.15, 4}, 0.1);
  EXPECT_EQ(best_over({a, e, f}, {}, {"noise"}), "A ties for the lowest MPE throughout");
}

TEST(BestLine, OfOneThatTiesThroughoutButIsDrawnAboveAnotherNamesBoth) {
  // H ties with K first, and with L at the end.
  const ErrorLine h = three_points("H", {1.15, 1.15, 1.15}, 0.1),
                  k = three_points("K", {1, 1, 4}, 0.1), l = three_points("L", {4, 4, 1.3}, 0.1);
  EXPECT_EQ(best_over({h, k, l}, {}, line_axis("noise [°]")),
            "K has the lowest mean MPE up to 2°, H at 3°");
  const ErrorLine late = three_points("K", {1, 4, 1}, 0.1),
                  other = three_points("L", {4, 1.3, 4}, 0.1);
  EXPECT_EQ(best_over({h, late, other}, {}, line_axis("noise [°]")),
            "K has the lowest mean MPE at 1° and 3°, where it ties with others");
}

TEST(BestLine, IsNotThroughoutWhereOnlyItsOwnWideIntervalTiesIt) {
  // W is the highest at the end.
  ErrorLine w = three_points("W", {1.05, 1.1, 9}, 0.1), n = three_points("N", {1, 1, 1.15}, 0.1);
  const ErrorLine o = three_points("O", {4, 4, 1}, 0.1), p = three_points("P", {4, 4, 4}, 0.1);
  w.low.back() = 0.5;
  w.high.back() = 17.5;
  EXPECT_EQ(best_over({w, n, p}, {}, {"noise"}), "N ties for the lowest MPE throughout");
  w.mean.front() = 0.95;
  EXPECT_EQ(best_over({w, n, o, p}, {}, {"noise"}), "") << "each leads once";
  for (ErrorLine* line : {&w, &n}) {
    line->x.push_back(4);
    line->mean.push_back(line == &w ? 1.15 : 1);
    line->low.push_back(line->mean.back() - 0.1);
    line->high.push_back(line->mean.back() + 0.1);
  }
  EXPECT_EQ(best_over({w, n, o, p}, {}, line_axis("noise [°]")),
            "N has the lowest mean MPE at 2° and 4°, where it ties with others");
}

/// Of methods that are called by a letter each: those that a title begins with.
std::string letters_before(const std::string& title, const std::string& end) {
  std::string letters;
  for (const char one : title.substr(0, title.find(end)))
    if (one >= 'A' && one <= 'D') letters += one;
  return letters;
}

TEST(BestLine, ThroughoutIsNeverFarAboveTheBestAtAnyPoint) {
  Random random(5);
  int stated = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<ErrorLine> lines;
    for (const char* label : {"A", "B", "C", "D"})
      lines.push_back(
          three_points(label, {random.uniform(1, 2), random.uniform(1, 2), random.uniform(1, 2)},
                       random.uniform(0.02, 0.5)));
    const std::string title = best_over(lines, {}, {"noise"});
    if (!title.ends_with(" the lowest MPE throughout")) continue;
    ++stated;
    const std::string named = letters_before(title, " the lowest");
    for (std::size_t x = 0; x < 3; ++x) {
      const ErrorLine& best =
          *std::ranges::min_element(lines, {}, [x](const ErrorLine& line) { return line.mean[x]; });
      double least_named = HUGE_VAL;
      for (const ErrorLine& line : lines) {
        if (named.find(line.label) == std::string::npos) continue;
        least_named = std::min(least_named, line.mean[x]);
        EXPECT_LE(line.low[x], best.high[x]) << title;
        EXPECT_LE(line.mean[x], best.mean[x] + best.high[x] - best.low[x]) << title;
      }
      EXPECT_LE(least_named, 1.01 * best.mean[x]) << title << ": by the digits shown";
    }
  }
  EXPECT_GT(stated, 20);
}

TEST(BestLine, IsNobodyWhereAllTieEvenIfFewAreKnownThere) {
  const ErrorLine a = three_points("A", {1, 1, 1}, 0.1), b = three_points("B", {1, 1, 1}, 0.1);
  ErrorLine c = three_points("C", {1, 1, kNaN}, 0.1), d = three_points("D", {1.1, 1.1, kNaN}, 0.1);
  EXPECT_EQ(best_over({a, b, c, d}, {}, {"noise"}), "");
}

TEST(BestLine, EndsTieWhereTheirIntervalsOverlap) {
  EXPECT_TRUE(ends_tie(three_points("A", {1, 5, 1.15}, 0.1)));
  EXPECT_FALSE(ends_tie(three_points("A", {1, 1, 1.25}, 0.1)));
}

TEST(BestLine, IsPluralIfItStandsForSeveralWhateverItsLabel) {
  const ErrorLine a = of_means("Map and scan matching", {1, 1}), b = of_means("B", {2, 2});
  LineQuantity mpe;
  EXPECT_EQ(best_over({a, b}, mpe, {"noise"}),
            "Map and scan matching has the lowest MPE throughout");
  EXPECT_EQ(best_of_points({{a, b}}, mpe),
            "Map and scan matching has the lowest MPE at all points");
  mpe.plural = {a.label};
  EXPECT_EQ(best_over({a, b}, mpe, {"noise"}),
            "Map and scan matching have the lowest MPE throughout");
  EXPECT_EQ(best_of_points({{a, b}}, mpe),
            "Map and scan matching have the lowest MPE at all points");
}

TEST(ShortNames, AreOfWholePartsOfLabelsOfOurs) {
  EXPECT_EQ(short_name("Pairwise-complete, kNN-SMACOF"), "Pairwise, kNN");
  EXPECT_EQ(short_name("bearing alone, its order"), "bearing, its order");
  EXPECT_EQ(short_name("bearing alone, its order 2.00"), "bearing, its order 2.00");
  EXPECT_EQ(short_name("white noise, 1 % of the range, plain SVD"), "white noise, 1 %, plain SVD");
  EXPECT_EQ(short_name("SMACOF, equal weights, from scratch and 2 others"),
            "SMACOF, scratch and 2 others");
  for (const char* label : {"noise of the range", "Robust PCA with missing data",
                            "A, incrementally", "kNN-SMACOF", "Pairwise-completed"})
    EXPECT_EQ(short_name(label), label);
}

TEST(ShapedLabel, KeepsWhatTellsItFromTheOthers) {
  const Theme theme;
  const std::vector<std::string> others = {"SMACOF, kNN weights, K = 5",
                                           "SMACOF, kNN weights, K = 7", "ISOMAP, K = 7"};
  const double most = shape_text("SMACOF kNN, K = 7", theme.font.get()).advance - 0.5;
  EXPECT_EQ(shape_label_within(theme, others[1], most, {others[1], others[2]}).text, "SMACOF kNN");
  const std::string a = shape_label_within(theme, others[0], most, others).text;
  const std::string b = shape_label_within(theme, others[1], most, others).text;
  EXPECT_NE(a, b);
  EXPECT_TRUE(b.ends_with("K = 7")) << b;
}

TEST(BestLine, IsNoneWhereAllAreEqual) {
  const ErrorLine a = three_points("A", {1, 2, 3}, 0.1), b = three_points("B", {1, 3, 2}, 0.1);
  EXPECT_EQ(best_over({a, b}, {}, line_axis("noise [°]")), "A has the lowest MPE at 2°, B at 3°");
  const ErrorLine c = three_points("C", {1, 1.5, 1}, 0.1);
  EXPECT_EQ(best_over({a, b, c}, {}, {"noise"}), "C has the lowest MPE wherever they differ");
}

TEST(BestLine, HasNoParameterThatTellsNoTwoApart) {
  const ErrorLine a = three_points("SMACOF, kNN weights, K = 7", {1, 2, 3}, 0.1);
  const ErrorLine b = three_points("ISOMAP, K = 5", {4, 4, 4}, 0.1);
  EXPECT_EQ(best_over({a, b}, {}, {"noise"}), "SMACOF kNN has the lowest MPE throughout");
  const ErrorLine c = three_points("SMACOF, kNN weights, K = 5", {4, 4, 4}, 0.1);
  EXPECT_EQ(best_over({a, c}, {}, {"noise"}), "SMACOF kNN, K = 7 has the lowest MPE throughout");
}

TEST(BestLine, NamesWithCommasAreInQuotesWhereThereAreSeveral) {
  const ErrorLine a = three_points("PPCA, kNN-SMACOF", {1, 1, 1}, 0.1);
  const ErrorLine b = three_points("PCA, kNN-SMACOF", {1.01, 1.01, 1.01}, 0.1);
  const ErrorLine c = three_points("C", {4, 4, 4}, 0.1);
  EXPECT_EQ(best_over({a, b, c}, {}, {"noise"}),
            "\u201cPPCA, kNN-SMACOF\u201d and \u201cPCA, kNN-SMACOF\u201d have the lowest MPE "
            "throughout");
  EXPECT_EQ(best_over({a, c}, {}, {"noise"}), "PPCA, kNN-SMACOF has the lowest MPE throughout");
}

TEST(BestLine, CountsNamesThatWouldTakeTheMostOfATitle) {
  const ErrorLine a = three_points("PCA with missing data, kNN-SMACOF", {1, 1, 1}, 0.1);
  const ErrorLine b = three_points("PPCA, expected squares, kNN-SMACOF", {1.01, 1.01, 1.01}, 0.1);
  const ErrorLine c = three_points("C", {4, 4, 4}, 0.1);
  EXPECT_EQ(best_over({a, b, c}, {}, {"noise"}), "2 of 3 methods have the lowest MPE throughout");
}

TEST(BestLine, OfSeveralPanelsIsBestAtMostPoints) {
  const ErrorLine a = three_points("A", {1, 2, 3}, 0.1), b = three_points("B", {2, 3, 1}, 0.1);
  EXPECT_EQ(best_of_points({{a, b}, {a, b}}, {}), "A has the lowest MPE at 4 of 6 points");
  EXPECT_EQ(best_of_points({{a, three_points("C", {4, 4, 4}, 0.1)}}, {}),
            "A has the lowest MPE at all points");
}

TEST(BestLine, OfSeveralPanelsCountsThePointsWhereItLeadsWithinTheIntervals) {
  const ErrorLine a = three_points("A", {1, 2, 3}, 0.1);
  const ErrorLine near_once = three_points("B", {1.15, 3, 4}, 0.1);
  EXPECT_EQ(best_of_points({{a, near_once}, {a, near_once}}, {}),
            "A has the lowest MPE at all 6 points; intervals overlap at 2");
  const ErrorLine beats_once = three_points("B", {1.15, 1, 4}, 0.1),
                  far = three_points("B", {4, 4, 4}, 0.1);
  EXPECT_EQ(best_of_points({{a, beats_once}, {a, far}}, {}),
            "A has the lowest MPE at 5 of 6 points; intervals overlap at 1");
  const ErrorLine alike_once = three_points("B", {1, 3, 4}, 0.1);
  EXPECT_EQ(best_of_points({{a, alike_once}}, {}), "A has the lowest MPE at 2 of 3 points");
  const ErrorLine near_twice = three_points("B", {1.15, 2.15, 4}, 0.1);
  EXPECT_EQ(best_of_points({{a, near_twice}}, {}), "");
}

TEST(ScaledUnit, HasNeitherPowersNorManyZeros) {
  const auto words = [](const char* unit, double greatest) {
    const ScaledUnit scaled = scaled_unit(unit, greatest);
    return fmt::format("{:.3g} {}", scaled.factor * greatest, scaled.unit);
  };
  EXPECT_EQ(words("m", 0.0098), "0.0098 m") << "as tables and texts have it";
  EXPECT_EQ(words("m", 0.00098), "0.98 mm");
  EXPECT_EQ(words("m", 0.5), "0.5 m");
  EXPECT_EQ(words("rad", 6.04e-4), "0.604 mrad");
  EXPECT_EQ(words("s", 0.032), "32 ms");
  EXPECT_EQ(words("s", 4.7e-4), "470 µs");
  EXPECT_EQ(words("ms", 0.0201), "20.1 µs");
  EXPECT_EQ(words("ms", 999.0), "999 ms");
  EXPECT_EQ(words("ms", 1495.0), "1.5 s");
  EXPECT_EQ(words("µs", 300.0), "300 µs");
  EXPECT_EQ(words("µs", 1495.0), "1.5 ms");
  EXPECT_EQ(words("µs", 2.5e6), "2.5 s");
  EXPECT_EQ(words("ppm", 4.6e-9), "4.6 10⁻¹⁵");
  EXPECT_EQ(words("ppm", 12.0), "12 ppm");
  EXPECT_EQ(words("%", 1e-9), "1e-09 %");
}

TEST(ScaledUnit, OfAnMpeIsM) {
  EXPECT_EQ(scaled_unit(known_quantity("mpe_m"), 1e-5).unit, "m");
  EXPECT_EQ(scaled_unit(Quantity{.label = "ATE", .unit = "m"}, 1e-5).unit, "mm");
}

TEST(ScaledUnit, ThatIsAPowerIsKnownAsOne) {
  EXPECT_EQ(power_of(scaled_unit("ppm", 4.6e-9).unit), -15);
  EXPECT_EQ(power_of("mm"), std::nullopt);
}

TEST(ShortNames, LeaveParametersOut) {
  EXPECT_EQ(without_parameters("SMACOF kNN, K = 7"), "SMACOF kNN");
  EXPECT_EQ(without_parameters("SDE, K = 8, whole 3.50"), "SDE, whole 3.50");
  EXPECT_EQ(without_parameters("white noise, 1 %"), "white noise, 1 %");
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
  spec.great_errors = false;
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

TEST(ErrorLinesFigure, SaysInANoteWhatDivergedAndDoesNotWidenItsFrameByIt) {
  ErrorLinesSpec spec;
  spec.id = "lines";
  spec.panels.resize(1);
  spec.panels[0].lines = {three_points("A", {0.1, 0.2, 0.3}, 0.05),
                          three_points("B", {1e5, 0.4, 1e9}, 0.05),
                          three_points("C", {2e6, 3e6, 4e6}, 1e9)};
  spec.panels[0].lines[1].key = "b";
  spec.panels[0].lines[2].key = "c";
  const Figure figure = error_lines_figure(spec);
  EXPECT_EQ(figure.panels[0].y.scale, Scale::kLinear);
  EXPECT_LT(figure.panels[0].y.limits->high, 1.0);
  ASSERT_FALSE(figure.notes.empty());
  EXPECT_EQ(figure.notes.back().text, "Diverged, over 1\u00A0km: B at 2 of 3 points and C.");
  EXPECT_EQ(figure.alt.find("e+"), std::string::npos) << figure.alt;
  const Scatter above = layers_of<Scatter>(figure.panels[0]).back();
  const std::pair<std::string, std::string> over{"over", "1000"};
  EXPECT_NE(std::ranges::find(above.marks.at(0).data, over), above.marks.at(0).data.end());
  // Where all are that large, they are distances of that size.
  spec.panels[0].lines = {three_points("C", {2e6, 3e6, 4e6}, 1.0)};
  EXPECT_GT(error_lines_figure(spec).panels[0].y.limits->high, 4e6);
  spec.great_errors = false;
  EXPECT_TRUE(error_lines_figure(spec).notes.empty());
}

TEST(ErrorLinesFigure, CountsTheIntervalsThatEndAboveItsFrame) {
  ErrorLinesSpec spec;
  spec.id = "lines";
  spec.panels.resize(1);
  spec.panels[0].lines = {three_points("A", {0.1, 1.0, 3.0}, 0.05)};
  EXPECT_TRUE(error_lines_figure(spec).notes.empty());
  spec.panels[0].lines[0].high[1] = 1e6;
  const Figure figure = error_lines_figure(spec);
  ASSERT_EQ(figure.notes.size(), 1U);
  EXPECT_EQ(figure.notes[0].text, "1 interval ends above the frame.");
}

TEST(ErrorLinesFigure, CountsTheIntervalsThatEndBelowALogarithmicFrame) {
  ErrorLinesSpec spec;
  spec.id = "lines";
  spec.panels.resize(1);
  ErrorLine line = three_points("A", {0.1, 1.0, 3.0}, 0.05);
  line.low = {0.001, -2.0, 0.05};
  spec.panels[0].lines = {line};
  const Figure figure = error_lines_figure(spec);
  ASSERT_EQ(figure.notes.size(), 1U);
  EXPECT_EQ(figure.notes[0].text, "2 intervals end below the frame.");
  spec.log_from = 100.0;  // A linear axis holds them all.
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
