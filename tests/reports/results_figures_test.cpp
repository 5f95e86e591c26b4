#include "reports/sections/results/results_figures.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/slug.hpp"
#include "core/base/text/unit_text.hpp"
#include "reports/sections/results/given_figures.hpp"
#include "reports/sections/results/results_comparison.hpp"
#include "reports/sections/results/results_conventions.hpp"
#include "reports/sections/results/results_data_sets.hpp"
#include "reports/sections/results/results_report.hpp"
#include "tests/reports/results_rows.hpp"

namespace mapproof {
namespace {

TEST(ResultsFigures, HaveIdsThatLongNamesDoNotMakeTooLong) {
  const std::string block(80, 'a'), what(60, 'b');
  EXPECT_EQ(id_below("study", "mpe_m"), "study-mpe-m");
  EXPECT_EQ(id_below(block, what).size(), kLongestId);
  EXPECT_NE(id_below(block, what), id_below(block, what + "b"));
}

TEST(ResultsFigures, OfDataSetsShowEachMethodInEachOfThem) {
  ResultsStudy study = Rows()
                           .add("even", "a1", 0.2)
                           .add("even", "b1", 0.1)
                           .add("uneven", "a1", 0.05)
                           .add("uneven", "b1", 0.9)
                           .add("uneven", "c1", 0.8)
                           .study(false);
  study.runs = {{"a1", "a1"}, {"b1", "b1"}, {"c1", "c1"}};
  const ResultsView view(study);
  const StudyFigures figures = results_figures(view, compare_methods(view));
  const Figure& figure = figures.groups.at(0).figures.at(0);
  EXPECT_EQ(figure.id, data_sets_figure_id(view.blocks()[0], mpe()));
  EXPECT_TRUE(figure.title.ends_with("uneven has the lowest MPE on 2 of 3 data sets"))
      << figure.title;
  const Panel& panel = figure.panels.at(0);
  EXPECT_EQ(panel.x.names, (std::vector<std::string>{"a1", "b1", "c1"}));
  ASSERT_EQ(panel.layers.size(), 2U);
  const auto& even = std::get<Scatter>(panel.layers[0]);
  EXPECT_EQ(even.label, "even");
  EXPECT_EQ(even.y, (std::vector<double>{0.2, 0.1}));
  const auto& uneven = std::get<Scatter>(panel.layers[1]);
  for (std::size_t i = 0; i < uneven.x.size(); ++i)
    EXPECT_EQ(std::lround(uneven.x[i]), static_cast<long>(i)) << "beside its data set's tick";
  EXPECT_LT(even.x[0], uneven.x[0]);
  const Report report = results_report(
      {.view = view, .comparisons = compare_methods(view), .figures = figures, .provenance = {}});
  EXPECT_EQ(report.opening.main_figure, figure.id);
}

/// Two sensors by two methods, on two data sets.
Rows crossed_rows() {
  Rows rows;
  double value = 0.1;
  for (const char* run : {"a1", "b1"})
    for (const char* method : {"Near, A", "Near, B", "Far, A", "Far, B"})
      rows.add(method, run, value += 0.1);
  return rows;
}

TEST(ResultsFigures, OfDataSetsHaveAColourPerFirstPartOfANameAndAFormPerSecondOne) {
  ResultsStudy study = crossed_rows().study(false);
  study.runs = {{"a1", "a1"}, {"b1", "b1"}};
  const ResultsView view(study);
  const Figure figure = results_figures(view, compare_methods(view)).groups.at(0).figures.at(0);
  const std::vector<Layer>& layers = figure.panels.at(0).layers;
  ASSERT_EQ(layers.size(), 8U) << "four methods, two forms and two colours of the legend";
  std::map<std::string, const Scatter*> dots;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& one = std::get<Scatter>(layers[i]);
    EXPECT_EQ(one.label, "") << "not in the legend";
    dots[one.marks.at(0).data.at(0).second] = &one;
  }
  EXPECT_EQ(dots.at("Near, A")->colour, dots.at("Near, B")->colour);
  EXPECT_NE(dots.at("Near, A")->colour, dots.at("Far, A")->colour);
  EXPECT_EQ(dots.at("Near, A")->marker, dots.at("Far, A")->marker);
  EXPECT_NE(dots.at("Near, A")->marker, dots.at("Near, B")->marker);
  EXPECT_EQ(std::get<Scatter>(layers[4]).marker, dots.at("Near, A")->marker);
  EXPECT_EQ(std::get<Segments>(layers[7]).label, "Near");
  EXPECT_EQ(std::get<Segments>(layers[7]).colour, dots.at("Near, A")->colour);
}

TEST(ResultsFigures, OfDataSetsKeepTheStylesOfMethodsThatHaveCurvesOrNoCrossedNames) {
  const auto labelled = [](Rows rows) {
    ResultsStudy study = rows.study(false);
    study.runs = {{"a1", "a1"}, {"b1", "b1"}};
    const ResultsView view(study);
    std::size_t count = 0;
    for (const FigureGroup& group : results_figures(view, compare_methods(view)).groups)
      for (const Figure& figure : group.figures)
        if (figure.id.find("-data-sets-") != std::string::npos)
          for (const Layer& layer : figure.panels.at(0).layers)
            if (const auto* dots = std::get_if<Scatter>(&layer)) count += !dots->label.empty();
    return count;
  };
  Rows rows = crossed_rows();
  EXPECT_EQ(labelled(rows), 2U) << "the forms";
  EXPECT_EQ(labelled(rows.add("Near", "a1", 0.1).add("Near", "b1", 0.1)), 5U);
}

TEST(ResultsFigures, GroundTruthIsASolidThinLineBelowTheEstimate) {
  GivenPath path;
  path.id = "p";
  path.path.time_s = Eigen::Vector3d(0.0, 1.0, 2.0);
  path.path.positions_m = Points::Zero(3, 2);
  path.path.positions_m(1, 0) = path.path.positions_m(2, 1) = 1.0;
  path.ground_truth = path.path;
  const auto figure_of = [&] {
    return given_figures(Rows().add("m", "a", 1.0).study(), {}, {path}).figures.at(0);
  };
  const Figure plain = figure_of();
  const auto& ground_truth = std::get<Polyline>(plain.panels[0].layers[0]);
  const auto& estimate = std::get<Polyline>(plain.panels[0].layers[1]);
  EXPECT_EQ(ground_truth.label, "ground truth");
  EXPECT_EQ(ground_truth.dash, Dash::kSolid);
  EXPECT_LT(ground_truth.width, estimate.width);
  EXPECT_NE(plain.caption.find("nothing was aligned"), std::string::npos);
  path.alignment = Alignment::kSimilarity;
  path.rms_m = 0.25;
  EXPECT_NE(figure_of().caption.find("aligned by rotation, translation and scale. RMS distance "
                                     "from the ground truth: 0.25 m."),
            std::string::npos);
}

TEST(ResultsFigures, ACurveOverNumbersElseADistribution) {
  Rows curve, plain;
  for (const char* run : {"a", "b", "c", "d", "e"})
    for (const char* method : {"m", "n", "o"}) {
      plain.add(method, run, run[0] - 'a' + 0.1 * (method[0] - 'm') + 1.0);
      for (const double noise : {0.1, 0.2})
        curve.add(method, run, noise * (method[0] - 'l'), {{"noise", noise}});
    }
  const ResultsStudy first = curve.study(), second = plain.study();
  const ResultsView with_axis(first), without(second);
  const StudyFigures curves = results_figures(with_axis, compare_methods(with_axis));
  ASSERT_EQ(curves.groups.size(), 1U);
  ASSERT_EQ(curves.groups[0].figures.size(), 2U);
  EXPECT_EQ(curves.groups[0].figures[0].panels[0].x.label, "noise");
  EXPECT_EQ(curves.groups[0].figures[1].id, "test-s-ranks-mpe-m");
  const StudyFigures distributions = results_figures(without, compare_methods(without));
  EXPECT_EQ(distributions.groups[0].figures[0].panels[0].y.label, "runs at or below [%]");
}

TEST(ResultsFigures, FewRunsAreEachADotAndNoDistribution) {
  Rows rows;
  for (const auto& [run, value] : {std::pair("a", 1.0), {"b", 3.0}, {"c", 2.0}})
    rows.add("m", run, value).add("n", run, value + 10.0);
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  const Figure figure = results_figures(view, {}).groups.at(0).figures.at(0);
  EXPECT_TRUE(
      figure.title.ends_with(": the median MPE is between 2.00\u00A0m and 12.0\u00A0m, too "
                             "few runs to rank the methods"))
      << figure.title;
  const Panel& panel = figure.panels.at(0);
  EXPECT_EQ(panel.y.names, (std::vector<std::string>{"n", "m"})) << "the best one uppermost";
  ASSERT_EQ(panel.layers.size(), 4U) << "runs and median of two methods";
  EXPECT_EQ(std::get<Scatter>(panel.layers[2]).x, (std::vector<double>{1.0, 3.0, 2.0}));
  EXPECT_EQ(std::get<Scatter>(panel.layers[3]).x, (std::vector<double>{2.0}));
}

TEST(ResultsFigures, ADistributionOfManyRunsKeepsTheSharesOfFiveHundredOfThem) {
  Rows rows;
  for (int run = 1; run <= 1237; ++run) rows.add("m", std::to_string(run), run);
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  const StudyFigures figures = results_figures(view, compare_methods(view));
  ASSERT_EQ(figures.groups.size(), 1U);
  std::set<double> steps;
  for (const Layer& layer : figures.groups[0].figures[0].panels[0].layers) {
    const auto* line = std::get_if<Polyline>(&layer);
    if (line == nullptr) continue;
    for (std::size_t i = 1; i < line->x.size(); i += 2) {
      steps.insert(line->x[i]);
      EXPECT_NEAR(line->y[i], 100.0 * line->x[i] / 1237.0, 1e-9);
    }
  }
  EXPECT_EQ(steps.size(), 500U);
  EXPECT_EQ(*steps.rbegin(), 1237.0);
}

/// Two methods over two factors of numbers; `o` has no value at the last level of both.
ResultsStudy grid_study() {
  Rows rows;
  for (const char* run : {"a", "b"})
    for (const double noise : {0.1, 0.2, 0.3})
      for (const double size : {5.0, 10.0}) {
        const std::vector<Level> at = {{"noise", noise}, {"size", size}};
        rows.add("m", run, noise * size, at);
        rows.add("o", run, noise == 0.3 && size == 10.0 ? kNaN : noise + size, at);
      }
  return rows.study();
}

TEST(ResultsFigures, TwoFactorsOfNumbersGiveAHeatMapPerMethod) {
  const ResultsStudy study = grid_study();
  const ResultsView view(study);
  const FigureGroup group = heat_maps(view, study.setups[0]);
  EXPECT_EQ(group.id, "test-s-grid");
  ASSERT_EQ(group.figures.size(), 2U);
  EXPECT_EQ(group.figures[0].id, "test-s-grid-mpe-m-m");
  const Panel& panel = group.figures[0].panels[0];
  EXPECT_EQ(panel.x.label, "noise");
  EXPECT_EQ(panel.x.names, (std::vector<std::string>{"0.1", "0.2", "0.3"}));
  EXPECT_EQ(panel.y.names, (std::vector<std::string>{"5", "10"}));
  const auto& cells = std::get<Cells>(panel.layers.back());
  EXPECT_DOUBLE_EQ(cells.values[0], 1.0);  // Noise 0.1 at size 10, in the upper row.
  EXPECT_DOUBLE_EQ(cells.values[5], 1.5);
  EXPECT_EQ(group.figures[1].notes.size(), 1U) << "a missing cell is said";
  const auto& others = std::get<Cells>(group.figures[1].panels[0].layers.back());
  EXPECT_EQ(cells.colour_scale.limits, others.colour_scale.limits) << "one scale for all methods";
}

TEST(ResultsFigures, HaveIdsOfTheirOwnWhereMethodsDifferByCaseAlone) {
  Rows rows;
  for (const char* run : {"a", "b"})
    for (const double noise : {0.1, 0.2, 0.3})
      for (const double size : {5.0, 10.0})
        for (const auto& [method, error] : {std::pair("EKF", 1.0), std::pair("ekf", 2.0)})
          rows.add(method, run, error * noise * size, {{"noise", noise}, {"size", size}});
  const ResultsStudy study = rows.study();
  std::set<std::string> ids;
  std::size_t count = 0;
  for (const FigureGroup& group : results_figures(ResultsView(study), {}).groups)
    for (const Figure& figure : group.figures) ids.insert(figure.id), ++count;
  EXPECT_GE(count, 4U);
  EXPECT_EQ(ids.size(), count);
}

TEST(ResultsFigures, OneFactorOrATextGivesNoHeatMap) {
  Rows one, text;
  for (const double noise : {0.1, 0.2})
    for (const char* light : {"day", "noon"}) {
      one.add("m", std::string("a") + light, noise, {{"noise", noise}});
      text.add("m", "a1", noise, {{"noise", noise}, {"light", std::string(light)}});
    }
  for (const ResultsStudy& study : {one.study(), text.study()}) {
    const ResultsView view(study);
    EXPECT_TRUE(heat_maps(view, study.setups[0]).empty());
  }
}

TEST(ResultsFigures, ALevelOf0IsNoHindranceToALogarithmicAxis) {
  Rows rows;
  for (const double noise : {0.0, 0.1, 1.0, 10.0})
    rows.add("m", "a", noise + 1.0, {{"noise", noise}});
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  const StudyFigures figures = results_figures(view, {});
  const Figure& figure = figures.groups.at(0).figures.at(0);
  EXPECT_EQ(figure.panels[0].x.scale, Scale::kLog);
  EXPECT_NE(figure.caption.find("level 0"), std::string::npos);
}

TEST(ResultsFigures, AnAxisIsLogarithmicOnlyWhereMostRunsAreAbove0) {
  const auto scale_of = [](const std::string& quantity, const std::string& runs_of_0) {
    Rows rows(quantity);
    rows.declare(study_quantity(quantity, "Shortfall", "m", Better::kLower));
    for (const std::string run : {"a", "b", "c", "d", "e", "f"})
      for (const double noise : {0.1, 0.2})
        rows.add("m", run, runs_of_0.find(run) == std::string::npos ? 0.1 : 0.0, {{"noise", noise}})
            .add("n", run, 9.0 + noise, {{"noise", noise}});
    const ResultsStudy study = rows.study();
    return results_figures(ResultsView(study), {}).groups.at(0).figures.at(0).panels.at(0).y.scale;
  };
  EXPECT_EQ(scale_of("shortfall_m", "abc"), Scale::kLinear) << "the best of a run falls short by 0";
  EXPECT_EQ(scale_of("shortfall_m", "a"), Scale::kLog) << "one run is 0 by chance";
  EXPECT_EQ(scale_of("regret_m", ""), Scale::kLog) << "whatever the name";
}

TEST(ResultsFigures, WhatIsTheSameEverywhereHasNone) {
  Rows rows;
  for (const double noise : {0.1, 0.2})
    for (const char* method : {"m", "n"}) rows.add(method, "a", 3.0, {{"noise", noise}});
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  EXPECT_TRUE(results_figures(view, {}).groups.empty());
  EXPECT_EQ(why_no_figure(view, view.blocks()[0], mpe()),
            "MPE: there is no curve, since the mean is 3.00\u00A0m at every level, for every method.");
}

TEST(ResultsFigures, WhatOneLevelAloneHasIsNotCalledTheSameAtEveryLevel) {
  Rows rows("step_error");
  rows.declare(study_quantity("step_error", "Error of the step", "", Better::kLower));
  rows.add("m", "a", 5.0, {{"noise", 0.1}}).add("m", "b", 6.0, {{"noise", 0.1}});
  rows.add("m", "c", 6.0, {{"noise", 0.1}}).add("m", "a", kNaN, {{"noise", 0.2}});
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  EXPECT_EQ(why_no_figure(view, view.blocks()[0], view.quantity("step_error")),
            "Error of the step: there is no curve, since one level alone has values (noise 0.1): "
            "the mean is 5.67.");
}

TEST(ResultsFigures, OfRanksNeedAsManyGroupsAsAnInterval) {
  const auto has_ranks = [](const std::string& runs) {
    Rows rows;
    for (const char run : runs)
      for (const char method : {'m', 'n', 'o', 'p', 'q', 'r', 's'})
        rows.add(std::string(1, method), std::string(1, run), 1.0 * method + 0.1 * run,
                 {{"noise", 0.1}});
    for (const char run : runs) rows.add("m", std::string(1, run), 1.0, {{"noise", 0.0}});
    const ResultsStudy study = rows.study();
    const ResultsView view(study);
    const std::vector<Figure> figures =
        results_figures(view, compare_methods(view)).groups.at(0).figures;
    return std::ranges::any_of(
        figures, [](const Figure& figure) { return figure.id == "test-s-ranks-mpe-m"; });
  };
  EXPECT_FALSE(has_ranks("abc"));
  EXPECT_TRUE(has_ranks("abcde"));
}

TEST(ResultsFigures, ManyLinesMayLackValuesAtALevel) {
  Rows rows;
  for (const char* run : {"a", "b", "c", "d", "e"})
    for (const char* method : {"m", "n", "o", "p", "q", "r", "s"}) {
      rows.add(method, run, method[0] < 'p' ? 1.0 : 2.0, {{"steps", 100.0}});
      if (method[0] < 'r') rows.add(method, run, 3.0, {{"steps", 200.0}});
    }
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  const StudyFigures figures = results_figures(view, {});
  std::vector<std::string> labels;
  for (const Layer& layer : figures.groups.at(0).figures.at(0).panels.at(0).layers)
    if (const auto* line = std::get_if<Polyline>(&layer)) labels.push_back(line->label);
  EXPECT_EQ(labels, (std::vector<std::string>{"m and 2 others", "p and q", "r and s"}));
}

TEST(ResultsFigures, WhatDivergedSpoilsNeitherTitleNorAxis) {
  Rows curves, runs;
  for (const std::string run : {"a", "b", "c", "d", "e", "f"}) {
    const double some = 0.001 * (run[0] - 'a'), drift = std::pow(10.0, 3 + run[0] - 'a');
    for (const double keyframes : {100.0, 200.0}) {
      const std::vector<Level> at = {{"keyframes", keyframes}};
      curves.add("ekf", run, 0.1 + some, at).add("graph", run, 0.02 + some, at);
      curves.add("odometry", run, drift, at);
    }
    runs.add("ekf", run, 0.1 + some).add("graph", run, 0.02 + some).add("odometry", run, drift);
  }
  for (Rows& rows : {std::ref(curves), std::ref(runs)}) {
    const ResultsStudy study = rows.study();
    const ResultsView view(study);
    const Figure figure = results_figures(view, {}).groups.at(0).figures.at(0);
    EXPECT_NE(figure.title.find("graph has the lowest"), std::string::npos) << figure.title;
    const Panel& panel = figure.panels.at(0);
    EXPECT_LT((&rows == &curves ? panel.y : panel.x).limits->high, 1.0 + kGreatestError_m);
    ASSERT_FALSE(figure.notes.empty());
    EXPECT_TRUE(figure.notes.back().text.starts_with("Diverged, over 1\u00A0km: odometry"))
        << figure.notes.back().text;
  }
}

TEST(ResultsFigures, WhatDivergedWidensNoAxisOfDots) {
  Rows few, sets;
  for (const std::string run : {"a1", "b1", "c1"}) {
    const double some = 0.1 + 0.01 * (run[0] - 'a');
    for (Rows* rows : {&few, &sets})
      rows->add("ekf", run, some).add("graph", run, 2.0 * some).add("odometry", run, 1e6 * some);
  }
  ResultsStudy of_sets = sets.study(false);
  of_sets.runs = {{"a1", "a1"}, {"b1", "b1"}, {"c1", "c1"}};
  for (const ResultsStudy& study : {few.study(), of_sets}) {
    const ResultsView view(study);
    const Figure figure = results_figures(view, {}).groups.at(0).figures.at(0);
    const Panel& panel = figure.panels.at(0);
    const Axis& axis = study.results.are_repeats ? panel.x : panel.y;
    ASSERT_TRUE(axis.limits) << figure.title;
    EXPECT_LT(axis.limits->high, 1.0);
    ASSERT_FALSE(figure.notes.empty()) << figure.title;
    EXPECT_EQ(figure.notes.back().text, "Diverged, over 1\u00A0km: odometry.");
    EXPECT_EQ(figure.title.find("e+"), std::string::npos) << figure.title;
    EXPECT_EQ(figure.title.find("between 0.110\u00A0m and 0.220\u00A0m; odometry over 1\u00A0km") !=
                  std::string::npos,
              study.results.are_repeats)
        << figure.title;
  }
}

TEST(ResultsFigures, TitlesWithTheRangeOfFewRunsSayWhatDiverged) {
  Rows rows;
  for (const double noise : {0.1, 0.2})
    for (const char* run : {"a1", "b1"})
      rows.add("ekf", run, noise, {{"noise", noise}})
          .add("odometry", run, 1e7 * noise, {{"noise", noise}});
  const ResultsStudy study = rows.study();
  const std::string title =
      results_figures(ResultsView(study), {}).groups.at(0).figures.at(0).title;
  EXPECT_TRUE(
      title.ends_with(": MPE between 0.100\u00A0m and 0.200\u00A0m; odometry over "
                      "1\u00A0km; too few runs to rank the methods"))
      << title;
}

TEST(ResultsFigures, TitlesJudgeAsThePairedTestsOfTheSentences) {
  // Runs differ far more than methods do; "graph" is the better one in every other run.
  const auto study_of = [](const std::vector<std::string>& methods) {
    Rows rows;
    for (const std::string run : {"a", "b", "c", "d", "e", "f", "g", "h"})
      for (const double noise : {0.1, 0.2})
        for (const std::string& method : methods) {
          const double run_error = 0.1 * (run[0] - 'a' + 1), noise_error = 0.001 * (run[0] % 3);
          const double own = method == "ekf"      ? 0.0
                             : method == "filter" ? 0.02 + noise_error
                             : run[0] % 2 == 0    ? 0.05
                                                  : -0.04;
          rows.add(method, run, noise + run_error + own, {{"noise", noise}});
        }
    return rows.study();
  };
  for (const auto& [methods, is_apart] :
       {std::pair(std::vector<std::string>{"ekf", "filter"}, true),
        std::pair(std::vector<std::string>{"ekf", "graph"}, false)}) {
    const ResultsStudy study = study_of(methods);
    const ResultsView view(study);
    const std::vector<MethodComparison> comparisons = compare_methods(view);
    const std::string sentence = sentence_of(comparisons.at(0), view);
    EXPECT_EQ(sentence.find("(a significant difference") != std::string::npos, is_apart)
        << sentence;
    const std::string title = results_figures(view, comparisons).groups.at(0).figures.at(0).title;
    EXPECT_EQ(title.find("ekf has the lowest MPE throughout") != std::string::npos, is_apart)
        << title;
  }
}

TEST(ResultsFigures, ManyLinesHaveIntervalsOrANoteWhereTheseAre) {
  for (const auto& [methods, has_bands] : {std::pair(12, true), std::pair(21, false)}) {
    Rows rows;
    for (const std::string run : {"a", "b", "c", "d", "e"})
      for (int method = 0; method < methods; ++method)
        for (const double noise : {0.1, 0.2})
          rows.add("m" + std::to_string(method), run, noise + 0.01 * method + 0.1 * (run[0] % 3),
                   {{"noise", noise}});
    const ResultsStudy study = rows.study();
    const Figure figure = results_figures(ResultsView(study), {}).groups.at(0).figures.at(0);
    const auto bands = std::ranges::count_if(figure.panels.at(0).layers, [](const Layer& layer) {
      return std::holds_alternative<Band>(layer);
    });
    EXPECT_EQ(bands, has_bands ? methods : 0);
    EXPECT_EQ(figure.caption.find("bars: its 95 % interval") != std::string::npos, has_bands)
        << figure.caption;
    EXPECT_EQ(std::ranges::any_of(
                  figure.notes,
                  [](const Note& note) { return note.text.starts_with("The table has the 95"); }),
              !has_bands);
  }
}

TEST(ResultsFigures, LinesOnEachOtherAreOneThatSaysOfHowMany) {
  Rows rows;
  for (const char* run : {"a", "b", "c", "d", "e"})
    for (const double steps : {100.0, 200.0})
      for (const char* method : {"m", "n", "o", "p", "q", "r"})
        rows.add(method, run, method[0] < 'p' ? steps : 20.0, {{"steps", steps}});
  ResultsStudy study = rows.study();
  for (Label& method : study.methods)
    method.label = method.id + (method.id < "p" ? ", K = 6, from scratch" : ", incremental");
  study.methods.back().label = "r";  // Has no end that the others have.
  const ResultsView view(study);
  const StudyFigures figures = results_figures(view, {});
  std::vector<std::string> labels;
  for (const Layer& layer : figures.groups[0].figures[0].panels[0].layers)
    if (const auto* line = std::get_if<Polyline>(&layer)) labels.push_back(line->label);
  EXPECT_EQ(labels, (std::vector<std::string>{"K = 6, from scratch (3 methods)",
                                              "p, incremental and 2 others"}));
}

TEST(ResultsWords, KeepTheCaseOfNamesInASentence) {
  EXPECT_EQ(in_sentence("Regret with anchors"), "regret with anchors");
  EXPECT_EQ(in_sentence("Error of 3 poses"), "error of 3 poses");
  for (const std::string name :
       {"", "T", "MPE", "F1 of loop closures", "F-score", "RoC area", "P95 latency", "T error"})
    EXPECT_EQ(in_sentence(name), name);
  EXPECT_EQ(in_sentence("MOE, reflection allowed"), "MOE (reflection allowed)");
}

TEST(ResultsWords, OfAValueHaveItsUnitUnlessThatIsAPowerOfTen) {
  EXPECT_EQ(value_words(0.25, "m", true), "0.250\u00A0m");
  EXPECT_EQ(value_words(2e3, "m", true), "over 1\u00A0km");
  EXPECT_NE(value_words(2e3, "m", false), value_words(2e3, "m", true));
  EXPECT_EQ(value_words(250.0, "10⁻³", false), "0.250");

  // A comparison's sentence uses the same words.
  Rows rows("share");
  rows.add("m", "a", 250.0).add("m", "b", 250.0).add("n", "a", 500.0).add("n", "b", 500.0);
  rows.declare(study_quantity("share", "Share", "10⁻³", Better::kLower));
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  const std::vector<MethodComparison> comparisons = compare_methods(view);
  ASSERT_EQ(comparisons.size(), 1U);
  const std::string sentence = sentence_of(comparisons[0], view);
  EXPECT_NE(sentence.find(", 0.250; "), std::string::npos) << sentence;
}

/// The first figure of methods m and n over two levels, of runs that are groups of their own, half
/// of them above the mean.
Figure figure_of_two(const std::string& quantity, double half_spread, int runs = 2) {
  Rows rows(quantity);
  for (const double noise : {0.1, 0.2})
    for (const char* method : {"m", "n"})
      for (int run = 0; run < runs; ++run)
        rows.add(method, std::string(1, static_cast<char>('a' + run)),
                 100.0 * noise + (method[0] == 'n' ? 5.0 : 0.0) +
                     (run % 2 == 0 ? -half_spread : half_spread),
                 {{"noise", noise}});
  rows.declare(study_quantity(quantity, "Coverage", "%", Better::kHigher));
  const ResultsStudy study = rows.study();
  return results_figures(ResultsView(study), {}).groups.at(0).figures.at(0);
}

TEST(ResultsFigures, TitlesRankNoMethodsOfFewerRunsThanAnIntervalNeeds) {
  for (const double half_spread : {0.1, 3.0})
    EXPECT_TRUE(
        figure_of_two("share_percent", half_spread)
            .title.ends_with(
                ": coverage between 10.0\u00A0% and 25.0\u00A0%, too few runs to rank the methods"))
        << figure_of_two("share_percent", half_spread).title;
  const Figure enough = figure_of_two("share_percent", 1.0, 6);
  EXPECT_TRUE(enough.title.ends_with("n has the highest coverage throughout")) << enough.title;
}

TEST(ResultsFigures, TitlesHaveEachEndOfARangeInTheUnitThatKeepsItShort) {
  for (const bool has_axis : {true, false}) {
    Rows rows("frame_us");
    rows.declare(study_quantity("frame_us", "time per frame", "µs", Better::kLower));
    for (const std::string run : {"a", "b", "c"})
      for (const double noise : {0.1, 0.2}) {
        if (!has_axis && noise > 0.1) continue;
        const std::vector<Level> at =
            has_axis ? std::vector<Level>{{"noise", noise}} : std::vector<Level>{};
        const double some = 0.1 * (run[0] - 'b');
        rows.add("fast", run, 300.0 + some, at).add("slow", run, 1496.0 + some, at);
      }
    const ResultsStudy study = rows.study();
    const std::string title =
        results_figures(ResultsView(study), {}).groups.at(0).figures.at(0).title;
    EXPECT_NE(title.find("between 300\u00A0µs and 1.50\u00A0ms"), std::string::npos) << title;
  }
}

TEST(ResultsFigures, TitlesJudgeTheWholeLineOfAMethodAlone) {
  const auto title_of = [](const std::vector<double>& values) {
    Rows rows;
    for (std::size_t i = 0; i < values.size(); ++i)
      for (const char* run : {"a", "b"})
        rows.add("m", run, values[i], {{"noise", 0.1 * static_cast<double>(i + 1)}});
    const ResultsStudy study = rows.study();
    const std::string title =
        with_plain_spaces(results_figures(ResultsView(study), {}).groups.at(0).figures.at(0).title);
    return title.substr(title.rfind("MPE "));
  };
  EXPECT_EQ(title_of({0.5, 0.4, 0.3}), "MPE falls from 0.500 m to 0.300 m");
  EXPECT_EQ(title_of({0.3, 0.3, 0.5}), "MPE rises from 0.300 m to 0.500 m");
  EXPECT_EQ(title_of({0.5, 0.2, 0.1, 0.4}),
            "MPE falls from 0.500 m to 0.100 m at noise = 0.3, then rises to 0.400 m");
  EXPECT_EQ(title_of({0.2, 0.6, 0.2}),
            "MPE rises from 0.200 m to 0.600 m at noise = 0.2, then falls to 0.200 m");
  EXPECT_EQ(title_of({0.5, 0.2, 0.4, 0.1}),
            "MPE goes from 0.500 m to 0.100 m, between 0.100 m and 0.500 m");
}

TEST(ResultsFigures, TheSampleOfSingleRunsOfSeveralMethodsIsGrey) {
  const Figure figure = figure_of_two("share_percent", 1.0);
  const auto& sample = std::get<Scatter>(figure.panels[0].layers.at(0));
  EXPECT_EQ(sample.label, "single runs");
  EXPECT_EQ(sample.colour, ThemeColour::kMuted);
}

TEST(ResultsFigures, CoverageIsComparedWithItsAim) {
  const Figure figure = figure_of_two("mean_covered_percent", 1.0);
  const auto& aim = std::get<Polyline>(figure.panels[0].layers.at(0));
  EXPECT_EQ(aim.y, (std::vector<double>{95.0, 95.0}));
  EXPECT_GE(figure.panels[0].y.limits->high, 95.0);
  EXPECT_TRUE(
      figure_of_two("mean_covered_percent", 1.0)
          .title.ends_with("coverage between 10.0\u00A0% and 25.0\u00A0%, aimed at 95\u00A0%"))
      << figure_of_two("mean_covered_percent", 1.0).title;
}

TEST(ResultsFigures, ALineAt0IsMissedOnlyIfItWasLeftOut) {
  // Five alike lines are joined, and none is at 0.
  Rows rows("gap_s");
  for (const char* run : {"a", "b"})
    for (const double noise : {0.1, 0.2, 0.3, 0.4})
      for (const char* method : {"m", "n", "o", "p", "q"})
        rows.add(method, run, method[0] < 'p' ? noise : 2.0 * noise, {{"noise", noise}});
  rows.declare(study_quantity("gap_s", "Lag", "s", Better::kLower));
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  const Figure figure = results_figures(view, {}).groups.at(0).figures.at(0);
  EXPECT_EQ(figure.caption.find("compared with"), std::string::npos) << figure.caption;
}

TEST(ResultsFigures, ADistributionsMedianIsThatOfItsRuns) {
  const auto title_of = [](int runs) {
    Rows rows;
    for (int run = 1; run <= runs; ++run) rows.add("m", std::to_string(run), run);
    const ResultsStudy study = rows.study();
    const ResultsView view(study);
    return results_figures(view, {}).groups.at(0).figures.at(0).title;
  };
  // Of an even number the mean of both; of very many not the end of a step of several.
  EXPECT_NE(title_of(6).find("the median MPE is 3.50\u00A0m"), std::string::npos) << title_of(6);
  EXPECT_NE(title_of(10).find("the median MPE is 5.50\u00A0m"), std::string::npos) << title_of(10);
}

TEST(ResultsFigures, EveryQuantityHasOneOrASentence) {
  const auto why = [](Rows& rows, bool are_repeats = true) {
    const ResultsStudy study = rows.study(are_repeats);
    const ResultsView view(study);
    const std::string sentence = why_no_figure(view, view.blocks()[0], mpe());
    EXPECT_EQ(sentence.empty(), !results_figures(view, {}).groups.empty());
    return sentence;
  };
  Rows single, lost, varied, repeated, many;
  single.add("m", "a", 3.0);
  EXPECT_EQ(why(single),
            "MPE: there is no figure of the distribution over runs, since no method has two values "
            "at one level.");
  for (const double noise : {0.1, 0.2}) {
    lost.add("m", "a", kNaN, {{"noise", noise}});
    varied.add("m", "a", noise, {{"noise", noise}});
  }
  EXPECT_EQ(why(lost), "MPE: there is no curve, since no run gave a value.");
  EXPECT_EQ(why(varied), "");
  EXPECT_EQ(why(repeated.add("m", "a", 3.0).add("m", "b", 3.0)),
            "MPE: there is no figure of the distribution over runs, which have fewer than 3 "
            "different values.");
  EXPECT_EQ(why(repeated.add("m", "c", 4.0).add("m", "d", 5.0)),
            "MPE: there is no figure of the runs of one method, which are too few for a "
            "distribution.");
  Rows two = repeated;
  EXPECT_EQ(why(two.add("n", "a", 3.0)), "");
  EXPECT_EQ(why(repeated.add("m", "e", 6.0)), "");
  for (const char* terrain : {"a", "b", "c", "d", "e"})
    many.add("m", "a", 1.0, {{"terrain", std::string(terrain)}})
        .add("m", "b", 2.0, {{"terrain", std::string(terrain)}});
  EXPECT_EQ(why(many),
            "MPE: there is no figure of the distribution over runs, which shows 4 levels at most.");
}

}  // namespace
}  // namespace mapproof
