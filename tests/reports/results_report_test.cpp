#include "reports/sections/results/results_report.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "reports/sections/results/results_comparison.hpp"
#include "reports/sections/results/results_conventions.hpp"
#include "reports/sections/results/results_figures.hpp"
#include "reports/sections/results/results_tables.hpp"
#include "tests/reports/results_rows.hpp"

namespace mapproof {
namespace {

TEST(ResultsReport, OfRecordedDataOpensWithTheBestMethodOverAllSets) {
  ResultsStudy study = Rows()
                           .add("even", "a1", 0.2)
                           .add("even", "b1", 0.1)
                           .add("even", "c1", 0.3)
                           .add("uneven", "a1", 0.05)
                           .add("uneven", "b1", 0.9)
                           .add("uneven", "c1", 0.8)
                           .add("once", "a1", 0.01)
                           .study(false);
  study.runs = {{"a1", "a1"}, {"b1", "b1"}, {"c1", "c1"}};
  const ResultsView view(study);
  const Report report = results_report(
      {.view = view, .comparisons = compare_methods(view), .figures = {}, .provenance = {}});
  const Highlights::Item& first = report.opening.numbers.items.at(0);
  EXPECT_EQ(first.value, "0.200\u00a0m");
  EXPECT_EQ(first.label, "median MPE of the best method");
  EXPECT_EQ(first.detail, "even, over 3 data sets");
}

TEST(ResultsReport, CrownsNoMethodForItsCoverageAndSaysItsPoses) {
  Rows rows;
  rows.add("few", "a1", 0.024).add("many", "a1", 0.0135);
  ResultsStudy study = rows.study();
  const Quantity associated =
      study_quantity("associated_percent", "associated poses", "%", Better::kHigher);
  EXPECT_FALSE(is_crowned(associated));
  EXPECT_TRUE(is_crowned(mpe()));
  const ResultsView view(study);
  const Report report = results_report({.view = view,
                                        .comparisons = compare_methods(view),
                                        .figures = {},
                                        .provenance = {},
                                        .poses = {{"few", 32}, {"many", 785}}});
  const Highlights::Item& best = report.opening.numbers.items.at(0);
  EXPECT_TRUE(best.label.starts_with("best MPE, ")) << best.label;
  EXPECT_EQ(best.detail, "many (785 poses); few (32 poses) 0.0240\u00a0m");
}

TEST(ResultsReport, GivesNumbersOfTilesAndSentencesInTheUnitThatKeepsThemShort) {
  Rows rows("scan_s");
  rows.declare(study_quantity("scan_s", "time per scan", "s", Better::kLower));
  rows.add("fast", "a1", 2.01e-5).add("slow", "a1", 0.0015).add("slower", "a1", 0.014);
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  const Report report = results_report(
      {.view = view, .comparisons = compare_methods(view), .figures = {}, .provenance = {}});
  EXPECT_EQ(report.opening.numbers.items.at(0).value, "20.1\u00a0µs");
  const std::string sentence = report.opening.findings.at(0).phrases.at(0).text;
  EXPECT_NE(sentence.find(", 20.1\u00a0µs; slow follows with 1.50\u00a0ms"), std::string::npos)
      << sentence;
}

TEST(ResultsReport, WarnsOfPathsOfWhichFewPosesAreAssociated) {
  const auto warns = [](double percent) {
    Rows rows("associated_percent");
    rows.declare(study_quantity("associated_percent", "associated poses", "%", Better::kHigher));
    const ResultsStudy study = rows.add("m", "a1", percent).add("m", "b1", 99.0).study(true);
    const ResultsView view(study);
    const Report report = results_report(
        {.view = view, .comparisons = compare_methods(view), .figures = {}, .provenance = {}});
    return report.opening.wrong.phrases.at(0).text.find("only 75.1\u00A0% (m, a1) of the poses") !=
           std::string::npos;
  };
  EXPECT_TRUE(warns(75.14));
  EXPECT_FALSE(warns(90.0));
}

TEST(ResultsReport, WarnsOnceOfAMethodThatDivergedAndCountsWhere) {
  for (const double levels : {1.0, 3.0}) {
    Rows rows;
    for (const double level : {1.0, 2.0, 3.0})
      rows.add("ekf", "a1", 0.1, {{"noise", level}})
          .add("odometry", "a1", level <= levels ? 1e8 : 2.0, {{"noise", level}});
    const ResultsStudy study = rows.study();
    const ResultsView view(study);
    const Report report = results_report(
        {.view = view, .comparisons = compare_methods(view), .figures = {}, .provenance = {}});
    const Highlights::Item& tile = report.opening.numbers.items.back();
    EXPECT_EQ(tile.label, "warning");
    EXPECT_EQ(tile.value, "1");
    EXPECT_TRUE(tile.detail.starts_with("the mean MPE of odometry is over 1\u00A0km ("))
        << tile.detail;
    EXPECT_TRUE(tile.detail.ends_with(levels == 1.0 ? "noise 1)" : "noise 1; and 2 more)"))
        << tile.detail;
    EXPECT_EQ(report.opening.wrong.phrases.at(0).text, ": " + tile.detail + ".");
  }
}

/// Two methods of five runs, each in a group of its own, by two quantities.
ResultsStudy study_of_two_quantities() {
  Rows rows;
  for (const char* run : {"a", "b", "c", "d", "e"})
    rows.add("m", run, 0.01 * run[0]).add("n", run, 0.03 * run[0]);
  ResultsStudy study = rows.study();
  for (const Result& row : std::vector(study.results.rows)) {
    study.results.rows.push_back(row);
    study.results.rows.back().quantity = "moe_percent";
  }
  study.quantities.push_back("moe_percent");
  sort_results(study.results);
  return study;
}

TEST(ResultsReport, StatesWhyMethodsAreNotCompared) {
  ResultsStudy study = study_of_two_quantities();
  const auto last_words = [&] {
    const ResultsView view(study);
    std::vector<MethodComparison> comparisons = compare_methods(view);
    std::erase_if(comparisons, [](const MethodComparison& one) {
      return one.groups < 2 || one.quantity->id != "mpe_m";
    });
    const Report report =
        results_report({.view = view, .comparisons = comparisons, .figures = {}, .provenance = {}});
    return std::get<Paragraph>(report.sections.at(report.sections.size() - 2).blocks.back())
        .phrases.at(0)
        .text;
  };
  EXPECT_EQ(last_words(),
            "MOE: the methods are not compared, since tests are made by MPE alone, which the "
            "study judges by first.");
  for (Result& row : study.results.rows) row.group = "a";
  EXPECT_EQ(last_words(),
            "MPE; MOE: the methods are not compared, since one group of runs shows nothing about "
            "chance.");
  for (Result& row : study.results.rows)
    if (row.method == Name("n")) row.run = "n" + row.run.get();
  EXPECT_EQ(last_words(),
            "MPE; MOE: the methods are not compared, since no two have values in the same runs.");
}

TEST(ResultsReport, OpensWithTheFigureOfItsHeadline) {
  const ResultsStudy study = study_of_two_quantities();
  const ResultsView view(study);
  StudyFigures figures = results_figures(view, {});
  const auto report = [&](const std::string& quantity) {
    return results_report({.view = view,
                           .comparisons = {},
                           .figures = figures,
                           .provenance = {},
                           .headline = {.label = "mean", .value = "1", .detail = ""},
                           .headline_figures = figures_of_quantity(view, quantity)});
  };
  EXPECT_EQ(report("mpe_m").opening.main_figure, "test-s-mpe-m");
  EXPECT_EQ(report("moe_percent").opening.main_figure, "test-s-moe-percent");
  EXPECT_EQ(report("moe_percent").opening.numbers.items.at(0).section, "test-s");
  // One of several setups stands in the summary, to which the number leads.
  figures.groups.insert(figures.groups.begin(),
                        {summary_id("test"), "Summary", "", {Figure{.id = "test-s-mpe-m"}}});
  const Report over_all = report("mpe_m");
  EXPECT_EQ(over_all.opening.numbers.items.at(0).section, "test-summary");
  EXPECT_EQ(over_all.sections.at(0).id, "test-summary");
  EXPECT_TRUE(std::holds_alternative<Gallery>(over_all.sections.at(0).blocks.back()));
}

TEST(ResultsReport, SaysWhatTheMapsAreComparedWith) {
  const ResultsStudy study = study_of_two_quantities();
  const ResultsView view(study);
  const Report report = results_report({.view = view,
                                        .comparisons = {},
                                        .figures = {},
                                        .provenance = {},
                                        .compared_with = "the map of all landmarks"});
  EXPECT_EQ(report.opening.compared_with.phrases.at(0).text, ": the map of all landmarks.");
}

TEST(ResultsReport, ComparesMethodsWithEachOtherWhereNothingElseIsStated) {
  ResultsStudy study = study_of_two_quantities();
  const auto compared = [&] {
    const ResultsView view(study);
    return results_report({.view = view, .comparisons = {}, .figures = {}, .provenance = {}})
        .opening.compared_with.phrases.at(0)
        .text;
  };
  EXPECT_EQ(compared(), ": each other, 2 methods over 5 runs.");
  std::erase_if(study.results.rows, [](const auto& row) { return row.method != "m"; });
  study.methods.resize(1);
  EXPECT_EQ(compared(), ": nothing; the study has one method and no ground truth.");
}

TEST(ResultsReport, NamesTheWarningsOfRunsOnTheFirstScreen) {
  ResultsStudy study = study_of_two_quantities();
  study.results.outcomes = {{condition("s"), "m", "a", {"uncertified", "not_euclidean"}},
                            {condition("s"), "m", "b", {}},
                            {condition("s"), "n", "a", {"uncertified"}},
                            {condition("s"), "n", "b", {}}};
  const ResultsView view(study);
  const Report report =
      results_report({.view = view, .comparisons = {}, .figures = {}, .provenance = {}});
  EXPECT_EQ(report.opening.wrong.phrases.at(0).text,
            ": 2 of 4 outcomes of methods have warnings: uncertified (2) and not Euclidean (1).");
  EXPECT_EQ(report.opening.numbers.items.back().label, "warning");
  EXPECT_EQ(
      report.opening.warnings,
      std::vector<std::string>{"2 of 4 outcomes of methods have warnings: uncertified (2) and "
                               "not Euclidean (1)"});
}

TEST(ResultsReport, MarksTheTileOfFewAssociatedPoses) {
  const auto falls_short = [](double percent) {
    Rows rows("associated_percent");
    rows.declare(study_quantity("associated_percent", "associated poses", "%", Better::kHigher));
    const ResultsStudy study = rows.add("m", "a1", percent).study();
    const ResultsView view(study);
    const Report report =
        results_report({.view = view, .comparisons = {}, .figures = {}, .provenance = {}});
    return report.opening.numbers.items.at(0).falls_short;
  };
  EXPECT_TRUE(falls_short(75.1));
  EXPECT_FALSE(falls_short(99.0));
}

TEST(ResultsReport, OfOneRunHasNoMeansAndNoTests) {
  Rows rows;
  for (const double noise : {0.1, 0.2, 0.3, 0.4})
    rows.add("few", "a1", 0.024 + noise, {{"noise", noise}})
        .add("many", "a1", 0.0135 + noise * noise, {{"noise", noise}});
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  const std::vector<MethodComparison> comparisons = compare_methods(view);
  ASSERT_FALSE(comparisons.empty());
  EXPECT_EQ(sentence_of(comparisons[0], view).find("mean"), std::string::npos);
  std::vector<Table> all = results_tables(view, view.blocks()[0]);
  all.push_back(comparison_table(view, comparisons[0]));
  for (const Table& table : all) {
    EXPECT_TRUE(table.notes.empty() || table.notes[0].find("group") == std::string::npos)
        << table.notes[0];
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      EXPECT_TRUE(std::ranges::any_of(
          table.rows,
          [&](const Row& row) { return !std::holds_alternative<MissingCell>(row.cells[i]); }))
          << table.id << ": " << table.columns[i].title;
  }
  EXPECT_EQ(all.back().columns.size(), 2U);
  const StudyFigures figures = results_figures(view, comparisons);
  EXPECT_EQ(figures.groups.at(0).figures.at(0).caption.find("mean over runs"), std::string::npos);
}

TEST(ResultsReport, WarnsOfPathsWithFarFewerPosesThanAnother) {
  const ResultsStudy study = Rows().add("few", "a1", 0.024).add("many", "a1", 0.0135).study();
  const ResultsView view(study);
  const auto warns = [&](long long few) {
    const Report report = results_report({.view = view,
                                          .comparisons = compare_methods(view),
                                          .figures = {},
                                          .provenance = {},
                                          .poses = {{"few", few}, {"many", 785}}});
    const std::string warning = fmt::format("few has {} poses, many 785", few);
    return report.opening.wrong.phrases.at(0).text.find(warning) != std::string::npos;
  };
  EXPECT_TRUE(warns(32));
  EXPECT_TRUE(warns(392));
  EXPECT_FALSE(warns(393));
}

TEST(ResultsReport, OfOneMethodOpensWithItsMeans) {
  const ResultsStudy study = Rows().add("m", "a1", 0.2).add("m", "b1", 0.1).study(true);
  const ResultsView view(study);
  const Report report = results_report(
      {.view = view, .comparisons = compare_methods(view), .figures = {}, .provenance = {}});
  const Highlights::Item& first = report.opening.numbers.items.at(0);
  EXPECT_EQ(first.value, "0.150\u00a0m");
  EXPECT_EQ(first.label, "MPE");
  EXPECT_EQ(first.detail, "m");
}

/// One method in each setup at these levels of noise and of light.
ResultsStudy study_of_setups(const std::vector<std::string>& setups) {
  ResultsStudy study;
  study.name = "test";
  for (const std::string& setup : setups)
    for (const char* run : {"a", "b"})
      for (const double noise : {0.2, 0.4})
        for (const char* light : {"day", "dusk"})
          study.results.rows.push_back(
              {.at = condition(setup, {{"light", std::string(light)}, {"noise", noise}}),
               .method = "m",
               .quantity = "mpe_m",
               .run = run,
               .group = run,
               .subject = "",
               .value = (setup == setups.front() ? 0.001 : 1.0) * noise});
  study.results.are_repeats = true;
  sort_results(study.results);
  EXPECT_EQ(complete(study), "");
  return study;
}

TEST(ResultsReport, PutsTheSectionsOfSeveralSetupsUnderTheirNames) {
  const auto sections_of = [](const ResultsStudy& study) {
    const ResultsView view(study);
    std::vector<std::string> sections;
    for (const Section& section :
         results_report({.view = view, .comparisons = {}, .figures = {}, .provenance = {}})
             .sections)
      sections.push_back(section.group + " | " + section.title);
    return sections;
  };
  EXPECT_EQ(
      sections_of(study_of_setups({"indoors", "outdoors"})),
      (std::vector<std::string>{"indoors | overview by light", "indoors | light day",
                                "indoors | light dusk", "outdoors | overview by light",
                                "outdoors | light day", "outdoors | light dusk", " | Provenance"}));
  EXPECT_EQ(sections_of(study_of_setups({"indoors"})).at(1), " | indoors, light day");
}

TEST(ResultsFigures, OfAnOverviewHaveTheLabelOfEqualAxesOnce) {
  ResultsStudy study = study_of_setups({"indoors", "outdoors"});
  std::erase_if(study.results.rows, [](const Result& row) {
    return row.at == condition("outdoors", {{"light", "dusk"}, {"noise", 0.4}});
  });
  for (const Result& row : std::vector(study.results.rows)) {
    study.results.rows.push_back(row);
    study.results.rows.back().method = "other";
    study.results.rows.back().value *= 2.0;
  }
  sort_results(study.results);
  study.methods.push_back({"other", "other"});
  const ResultsView view(study);
  const StudyFigures figures = results_figures(view, {});
  ASSERT_EQ(figures.groups.at(0).id, "test-overview-indoors");
  EXPECT_TRUE(figures.groups.at(0).figures.at(0).shared_x);
  ASSERT_EQ(figures.groups.at(1).id, "test-overview-outdoors");
  EXPECT_FALSE(figures.groups.at(1).figures.at(0).shared_x) << "of other levels";
}

TEST(ResultsTables, HaveOnePrecisionForAQuantity) {
  const ResultsStudy study = study_of_setups({"indoors", "outdoors"});
  const ResultsView view(study);
  EXPECT_EQ(view.decimals(mpe()), 5) << "those of two digits of 0.0002, the least and best";
  std::vector<Table> tables;
  for (const ResultsBlock& block : view.blocks())
    for (Table& table : results_tables(view, block)) tables.push_back(std::move(table));
  for (const ResultsOverview& overview : view.overviews())
    for (Table& table : overview_tables(view, overview)) tables.push_back(std::move(table));
  ASSERT_EQ(tables.size(), 6U);
  for (const Table& table : tables)
    for (const Cell& cell : table.rows.at(0).cells)
      if (const auto* number = std::get_if<NumberCell>(&cell)) {
        EXPECT_EQ(number->decimals, view.decimals(mpe())) << table.id;
      }
}

TEST(ResultsTables, HaveTwoDigitsOfTheLeastMeanWhereItIsTheBest) {
  const auto decimals = [](const char* quantity) {
    const ResultsStudy study =
        Rows(quantity).add("best", "a1", 0.3).add("m", "a1", 30.0).add("n", "a1", 153.2).study();
    return ResultsView(study).decimals(known_quantity(quantity));
  };
  EXPECT_EQ(decimals("mpe_m"), 2);
  EXPECT_EQ(decimals("fit_held_out_nats"), 1) << "the least is the worst";
}

TEST(ResultsTables, HaveTwoDecimalsOfMoeAtMost) {
  const ResultsStudy study =
      Rows("moe_percent").add("m", "a1", 0.0022).add("n", "a1", 45.934).study();
  const ResultsView view(study);
  EXPECT_EQ(view.decimals(known_quantity("moe_percent")), 2);
}

TEST(ResultsReport, OpensWithFiguresOfPathsInTheOrderOfTheirRuns) {
  const ResultsStudy study = Rows().add("m", "a1", 0.2).add("m", "b1", 0.1).study(true);
  const ResultsView view(study);
  StudyFigures figures;
  for (const char* id : {"curves", "errors-first", "maps", "errors-second", "errors-third"})
    figures.groups.push_back(
        {.id = std::string("test-") + id,
         .title = id,
         .words = "",
         .figures = {{.id = std::string("test-") + id + "-1", .title = id, .panels = {Panel{}}}}});
  const Report report = results_report(
      {.view = view, .comparisons = compare_methods(view), .figures = figures, .provenance = {}});
  std::vector<std::string> shown = report.opening.figure_ids;
  if (!report.opening.main_figure.empty()) shown.insert(shown.begin(), report.opening.main_figure);
  EXPECT_EQ(shown,
            (std::vector<std::string>{"test-errors-first-1", "test-errors-second-1",
                                      "test-errors-third-1", "test-maps-1", "test-curves-1"}));
}

}  // namespace
}  // namespace mapproof
