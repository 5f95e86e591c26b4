#include "reports/sections/results/results_view.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "core/base/not_finite.hpp"
#include "core/statistics/paired_change.hpp"
#include "reports/sections/results/results_comparison.hpp"
#include "reports/sections/results/results_figures.hpp"
#include "reports/sections/results/results_report.hpp"
#include "reports/sections/results/results_tables.hpp"
#include "tests/reports/results_rows.hpp"

namespace mapproof {
namespace {

std::map<std::string, double> by_name(const ValuesByRun& values) {
  return {values.begin(), values.end()};
}

TEST(ResultsView, MeansRestOnRunsAndIntervalsOnGroups) {
  // Two groups of two equal runs: the t interval of two means, 1 and 3.
  const ResultsStudy study = Rows()
                                 .add("m", "a1", 1.0)
                                 .add("m", "a2", 1.0)
                                 .add("m", "b1", 3.0)
                                 .add("m", "b2", 3.0)
                                 .study();
  const ResultsView view(study);
  ASSERT_EQ(view.blocks().size(), 1U);
  const ResultsBlock& block = view.blocks()[0];
  EXPECT_EQ(view.runs(), 4U);
  EXPECT_EQ(view.groups(), 2U);
  const auto lines = view.lines(block, mpe());
  ASSERT_EQ(lines.size(), 1U);
  const auto mean = view.mean(block.conditions[0], lines[0], mpe());
  ASSERT_TRUE(mean && mean->half_width);
  EXPECT_DOUBLE_EQ(mean->mean, 2.0);
  EXPECT_NEAR(*mean->half_width, 12.7062047362, 1e-8);  // t of one degree, standard error 1.
}

TEST(ResultsView, AnAxisIsTheNumericFactorWithTheMostLevels) {
  Rows rows;
  for (const double noise : {0.1, 0.2, 0.3})
    for (const double size : {5.0, 10.0})
      for (const char* light : {"day", "noon"})
        rows.add("m", "a1", noise,
                 {{"noise", noise}, {"size", size}, {"light", std::string(light)}});
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  ASSERT_EQ(view.blocks().size(), 4U);
  for (const ResultsBlock& block : view.blocks()) {
    EXPECT_EQ(block.factor, "noise");
    EXPECT_EQ(block.levels.size(), 3U);
    EXPECT_TRUE(block.has_axis());
  }
  EXPECT_EQ(view.blocks()[0].title, "s, light day, size 5");
  EXPECT_EQ(view.blocks()[0].id, "test-s-light-day-size-5");
}

TEST(ResultsView, IdsOfLevelsTellTheirSign) {
  Rows rows;
  for (const double tilt : {-5.0, 5.0, -0.5, 1e-7, 1e20})
    for (const double noise : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6})
      rows.add("m", "a1", noise * tilt, {{"noise", noise}, {"tilt_deg", tilt}});
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  std::vector<std::string> ids;
  for (const ResultsBlock& block : view.blocks()) ids.push_back(block.id);
  EXPECT_EQ(ids, (std::vector<std::string>{"test-s-tilt-deg-minus-5", "test-s-tilt-deg-minus-0-5",
                                           "test-s-tilt-deg-1e-minus-07", "test-s-tilt-deg-5",
                                           "test-s-tilt-deg-1e20"}));
}

TEST(ResultsComparison, IdsOfTextsTellTheirSign) {
  Rows rows;
  for (const char* offset : {"+5 V", "-5 V", "5 V"})
    rows.add("m", "a1", 1.0, {{"offset", std::string(offset)}})
        .add("n", "a1", 2.0, {{"offset", std::string(offset)}});
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  std::vector<std::string> ids;
  for (const MethodComparison& comparison : compare_methods(view)) ids.push_back(comparison.id);
  EXPECT_EQ(ids, (std::vector<std::string>{"test-s-plus-5-v", "test-s-minus-5-v", "test-s-5-v"}));
}

TEST(ResultsView, SubjectsOfARunAreOneValueAndLostRunsAreCounted) {
  const ResultsStudy study = Rows()
                                 .add("m", "a1", 1.0, {}, "L1")
                                 .add("m", "a1", 3.0, {}, "L2")
                                 .add("m", "b1", kNaN)
                                 .study();
  const ResultsView view(study);
  const ResultsBlock& block = view.blocks()[0];
  const RunNumbers numbers = view.numbers(block.conditions[0], view.lines(block, mpe())[0], mpe());
  EXPECT_EQ(by_name(numbers.values), (std::map<std::string, double>{{"a1", 2.0}}));
  EXPECT_EQ(numbers.lost, 1);
}

TEST(ResultsView, ARunThatLostOneSubjectIsLost) {
  const ResultsStudy study = Rows()
                                 .add("m", "a1", 1.0, {}, "L1")
                                 .add("m", "a1", kNaN, {}, "L2")
                                 .add("m", "b1", 2.0, {}, "L1")
                                 .add("m", "b1", 4.0, {}, "L2")
                                 .study();
  const ResultsView view(study);
  const ResultsBlock& block = view.blocks()[0];
  const RunNumbers numbers = view.numbers(block.conditions[0], view.lines(block, mpe())[0], mpe());
  EXPECT_EQ(by_name(numbers.values), (std::map<std::string, double>{{"b1", 3.0}}));
  EXPECT_EQ(numbers.lost, 1);
}

TEST(ResultsView, RunsThatAreNoRepeatsHaveLinesOfTheirOwnAndNoTests) {
  const ResultsStudy study =
      Rows().add("m", "a1", 1.0).add("m", "b1", 3.0).add("n", "a1", 2.0).study(false);
  const ResultsView view(study);
  const auto lines = view.lines(view.blocks()[0], mpe());
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[1].label, "m, b1");
  EXPECT_TRUE(compare_methods(view).empty());
  const std::vector<Table> tables = results_tables(view, view.blocks()[0]);
  ASSERT_EQ(tables.size(), 1U);
  EXPECT_EQ(tables[0].rows.size(), 3U);
  EXPECT_EQ(tables[0].columns.size(), 2U) << "no intervals";
}

TEST(ResultsComparison, IsThePairedTestOverGroupsCorrectedForTheMethods) {
  Rows rows;
  const std::vector<double> a = {1.0, 1.2, 0.9, 1.1, 1.3}, b = {1.1, 1.25, 1.2, 1.1, 1.6},
                            c = {2.0, 2.1, 1.9, 2.2, 2.4};
  std::vector<double> b_less_a, c_less_a;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::string run(1, static_cast<char>('a' + static_cast<int>(i)));
    rows.add("m1", run, a[i]).add("m2", run, b[i]).add("m3", run, c[i]);
    b_less_a.push_back(b[i] - a[i]);
    c_less_a.push_back(c[i] - a[i]);
  }
  rows.add("m4", "a", 0.5);  // In one group alone.
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  const auto comparisons = compare_methods(view);
  ASSERT_EQ(comparisons.size(), 1U);
  const MethodComparison& found = comparisons[0];
  EXPECT_EQ(found.left_out, std::vector<std::string>{"m4"});
  EXPECT_EQ(found.groups, 5);
  ASSERT_EQ(found.methods.size(), 3U);
  EXPECT_FALSE(found.methods[0].change);
  EXPECT_DOUBLE_EQ(found.methods[1].change->p, paired_change(b_less_a).p);
  EXPECT_DOUBLE_EQ(found.methods[2].change->shift, paired_change(c_less_a).shift);
  EXPECT_DOUBLE_EQ(found.methods[2].corrected_p, 2.0 * paired_change(c_less_a).p);
  ASSERT_TRUE(found.ranks);
  EXPECT_DOUBLE_EQ(found.ranks->mean_ranks[0], 1.1);  // One tie with m2.
  EXPECT_DOUBLE_EQ(found.ranks->mean_ranks[2], 3.0);
  EXPECT_EQ(sentence_of(found, view).substr(0, 55),
            "s: m1 has the lowest mean MPE, 1.10\u00A0m; m2 follows with");
  EXPECT_TRUE(sentence_of(found, view).ends_with("; not compared, since values are missing: m4."))
      << sentence_of(found, view);
}

TEST(ResultsView, CountsTheRunsAndGroupsOfEachSetup) {
  ResultsStudy study = Rows()
                           .add("m", "a1", 1.0)
                           .add("n", "a1", 2.0)
                           .add("m", "a2", 3.0)
                           .add("m", "b1", 4.0)
                           .study();
  // One run elsewhere, which has the name of a run of the first setup.
  Result elsewhere = study.results.rows.front();
  elsewhere.at = condition("yard");
  study.results.rows.push_back(elsewhere);
  study.setups.push_back({"yard", "Yard"});
  const ResultsView view(study);
  EXPECT_EQ(view.runs(), 3U);
  EXPECT_EQ(view.counts_of("s").runs, 3U);
  EXPECT_EQ(view.counts_of("s").groups, 2U);
  EXPECT_EQ(view.counts_of("yard").runs, 1U);
  EXPECT_EQ(view.counts_of("yard").groups, 1U);
  EXPECT_EQ(view.counts_of("nowhere").runs, 0U);
}

TEST(ResultsComparison, PairsAreOfTheRunsThatAllComparedMethodsHave) {
  // n lacks the run a2, where m is much worse: paired, they differ by 1 in all groups.
  const ResultsStudy study = Rows()
                                 .add("m", "a1", 1.0)
                                 .add("m", "a2", 90.0)
                                 .add("m", "b1", 3.0)
                                 .add("m", "c1", 3.0)
                                 .add("m", "d1", 3.0)
                                 .add("m", "e1", 5.0)
                                 .add("n", "a1", 2.0)
                                 .add("n", "b1", 4.0)
                                 .add("n", "c1", 4.0)
                                 .add("n", "d1", 4.0)
                                 .add("n", "e1", 6.0)
                                 .study();
  const ResultsView view(study);
  const auto comparisons = compare_methods(view);
  ASSERT_EQ(comparisons.size(), 1U);
  const MethodComparison& found = comparisons[0];
  EXPECT_EQ(found.runs, 5);
  EXPECT_EQ(found.groups, 5);
  EXPECT_FALSE(found.has_all_runs);
  EXPECT_EQ(found.methods[0].method, 0U) << "over the common runs m is the better one";
  EXPECT_DOUBLE_EQ(found.methods[0].mean, 3.0);
  EXPECT_DOUBLE_EQ(found.methods[1].change->shift, 1.0);
  EXPECT_NE(sentence_of(found, view).find("over the 5 runs that all of these methods have"),
            std::string::npos);
}

TEST(ResultsComparison, OfFewerGroupsThanAnIntervalNeedsHasNoTest) {
  Rows rows;
  for (const char* run : {"a", "b", "c"})
    rows.add("m", run, 1.0).add("n", run, 2.0 + 0.01 * run[0]).add("o", run, 3.0);
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  const MethodComparison found = compare_methods(view).at(0);
  EXPECT_FALSE(found.methods[1].change);
  EXPECT_FALSE(found.ranks);
  EXPECT_FALSE(has_rank_diagram(found));
  EXPECT_TRUE(
      sentence_of(found, view).ends_with("; too few runs to test the difference, in 3 groups."))
      << sentence_of(found, view);
  EXPECT_EQ(why_not_compared(view, view.blocks()[0], mpe()),
            "3 groups of runs are too few for a test");
}

TEST(ResultsComparison, WithAllRunsItsMeansAreThoseOfTheTable) {
  // Three runs in one group and one in the other: the mean over runs, not over groups.
  Rows rows;
  for (const char* run : {"a1", "a2", "a3", "b1"})
    rows.add("m", run, run[0] == 'a' ? 1.0 : 5.0).add("n", run, run[0] == 'a' ? 2.0 : 9.0);
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  const MethodComparison found = compare_methods(view).at(0);
  EXPECT_TRUE(found.has_all_runs);
  const ResultsBlock& block = view.blocks()[0];
  const auto mean = view.mean(block.conditions[0], view.lines(block, mpe())[0], mpe());
  EXPECT_DOUBLE_EQ(found.methods[0].mean, mean->mean);
  EXPECT_DOUBLE_EQ(found.methods[0].mean, 2.0);
}

TEST(ResultsComparison, PassesOverLevelsWithoutPairsAndSaysSo) {
  Rows rows;
  for (const char* run : {"a", "b", "c"})
    for (const double noise : {0.1, 0.2, 0.4})
      for (const char* method : {"m", "n"})
        rows.add(method, run, noise < 0.3 ? noise + method[0] + run[0] : kNaN, {{"noise", noise}});
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  const MethodComparison found = compare_methods(view).at(0);
  EXPECT_EQ(where_of(found),
            "s, noise 0.2 (no two methods have values in the same runs at noise 0.4)");
  MethodComparison many = found;
  many.passed_over = {"noise 1", "noise 2", "noise 3", "noise 4"};
  EXPECT_TRUE(where_of(many).ends_with(" at noise 1, noise 2 and 2 more levels)"))
      << where_of(many);
  EXPECT_TRUE(std::isfinite(found.methods[0].mean));
}

TEST(ResultsComparison, IsOfEachLevelWhereLevelsAreTexts) {
  Rows rows;
  for (const char* run : {"a", "b", "c"})
    for (const char* terrain : {"grass", "road", "Road!"})
      for (const char* method : {"m", "n", "o"})
        rows.add(method, run, method[0] + 0.1 * run[0], {{"terrain", std::string(terrain)}});
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  const auto comparisons = compare_methods(view);
  ASSERT_EQ(comparisons.size(), 3U);
  EXPECT_EQ(where_of(comparisons[1]), "s, terrain grass");
  std::set<std::string> ids;
  for (const MethodComparison& comparison : comparisons) {
    ids.insert(comparison_table(view, comparison).id);
    EXPECT_TRUE(comparison.passed_over.empty());
  }
  EXPECT_EQ(ids, (std::set<std::string>{"test-s-grass-paired-mpe-m", "test-s-road-paired-mpe-m",
                                        "test-s-road-level-3-paired-mpe-m"}));
}

TEST(ResultsComparison, OfMethodsWithoutACommonRunIsNone) {
  const ResultsStudy study = Rows().add("m", "a1", 1.0).add("n", "b1", 2.0).study();
  const ResultsView view(study);
  EXPECT_TRUE(compare_methods(view).empty());
  const ResultsStudy lost = Rows().add("m", "a1", kNaN).add("n", "a1", kNaN).study();
  const ResultsView none(lost);
  EXPECT_TRUE(compare_methods(none).empty());
}

TEST(ResultsComparison, SaysWherePairedTestAndMeanRanksContradictEachOther) {
  // n follows m by nearly the same step everywhere: clear by pairs, one rank apart among three.
  Rows rows;
  double step = 0.1;
  for (const char* run : {"a", "b", "c", "d", "e"}) {
    rows.add("m", run, run[0]).add("n", run, run[0] + step).add("o", run, run[0] + 30.0 * step);
    step += 0.002;
  }
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  const MethodComparison found = compare_methods(view).at(0);
  EXPECT_TRUE(is_significant(found.methods[1]));
  EXPECT_LT(found.ranks->mean_ranks[1] - found.ranks->mean_ranks[0], critical_difference(found));
  const std::string note = disagreement_of(found, view);
  EXPECT_TRUE(note.starts_with("The paired test distinguishes n from m, mean ranks do not. "))
      << note;
  EXPECT_NE(sentence_of(found, view).find("their mean ranks do not differ significantly"),
            std::string::npos);
  EXPECT_EQ(comparison_table(view, found).notes.back(), note);
  const StudyFigures figures = results_figures(view, {found});
  EXPECT_NE(figures.groups[0].figures.back().caption.find(note), std::string::npos);
}

TEST(ResultsComparison, ManyOpenAReportByWhatTheyComeTo) {
  Rows rows;
  for (const double size : {1.0, 2.0, 3.0})
    for (const char* light : {"day", "dusk", "noon"})
      for (const char* run : {"a", "b", "c", "d", "e"})
        for (const char* method : {"m", "n", "o"}) {
          const bool swapped = light[0] == 'n';
          const double worse = method[0] == 'o' ? 9.0 : (method[0] == 'm') == swapped ? 1.0 : 0.0;
          const double noise = 0.01 * (run[0] - 'a') * (method[0] - 'l');
          rows.add(method, run, size == 1.0 && method[0] == 'o' ? kNaN : 1.0 + worse + noise,
                   {{"size", size}, {"light", std::string(light)}, {"floor", 1.0}});
        }
  // Five comparisons are needed: two more setups of the same.
  ResultsStudy study = rows.study();
  const std::vector<Result> once = study.results.rows;
  for (Result row : once) {
    row.at.setup = "t";
    study.results.rows.push_back(row);
  }
  sort_results(study.results);
  EXPECT_EQ(complete(study), "");
  const ResultsView view(study);
  const auto comparisons = compare_methods(view);
  ASSERT_EQ(comparisons.size(), 6U);
  const std::vector<std::string> headlines = headlines_of(view, comparisons);
  ASSERT_EQ(headlines.size(), 1U);
  EXPECT_EQ(
      headlines[0],
      "MPE: of 6 conditions compared, the lowest mean is that of m in 4 (4 significantly) and "
      "n in 2 (2 significantly); significantly worse than the best wherever compared: o.");
  EXPECT_EQ(losses_of(view), "30 of 270 results have no value: 30 of o");
  EXPECT_EQ(headlines_of(view, {comparisons[0]})[0], sentence_of(comparisons[0], view));
}

/// One method in two setups with one level of noise, and in one that has none.
ResultsStudy study_at_one_noise(double noise_of_second) {
  ResultsStudy study;
  study.name = "test";
  const auto add = [&](const char* setup, std::vector<Level> levels) {
    study.results.rows.push_back({.at = condition(setup, std::move(levels)),
                                  .method = "m",
                                  .quantity = "mpe_m",
                                  .run = "a",
                                  .group = "a",
                                  .subject = "",
                                  .value = 0.1});
  };
  add("indoors", {{"noise", 0.1}});
  add("outdoors", {{"noise", noise_of_second}});
  add("quiet", {});
  study.results.are_repeats = true;
  sort_results(study.results);
  EXPECT_EQ(complete(study), "");
  return study;
}

TEST(ResultsView, WhatAllSetupsHaveInCommonIsSaidOnceAndNotInTheirTitles) {
  const auto titles = [](const ResultsView& view) {
    std::vector<std::string> all;
    for (const ResultsBlock& block : view.blocks()) all.push_back(block.title);
    return all;
  };
  const ResultsStudy alike = study_at_one_noise(0.1), other = study_at_one_noise(0.2);
  const ResultsView view(alike);
  EXPECT_EQ(titles(view), (std::vector<std::string>{"indoors", "outdoors", "quiet"}));
  EXPECT_EQ(view.shared_words(), "noise 0.1");
  EXPECT_EQ(view.blocks()[0].id, "test-indoors-noise-0-1");
  const Report report =
      results_report({.view = view, .comparisons = {}, .figures = {}, .provenance = {}});
  EXPECT_TRUE(report.subtitle.ends_with("; noise 0.1")) << report.subtitle;
  const ResultsView apart(other);
  EXPECT_EQ(titles(apart),
            (std::vector<std::string>{"indoors, noise 0.1", "outdoors, noise 0.2", "quiet"}));
  EXPECT_EQ(apart.shared_words(), "");
}

TEST(ResultsReport, SetupsThatAreALineEachStandInOneTable) {
  const ResultsStudy study = study_at_one_noise(0.1);
  const ResultsView view(study);
  const Report report =
      results_report({.view = view, .comparisons = {}, .figures = {}, .provenance = {}});
  ASSERT_EQ(report.sections.size(), 2U) << "and the provenance";
  const Section& section = report.sections[0];
  EXPECT_EQ(section.title, "m in 3 setups");
  EXPECT_EQ(section.id, view.blocks()[0].id) << "to which numbers lead";
  const auto& table = std::get<Table>(section.blocks.back());
  EXPECT_EQ(table.caption, section.title);
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(std::get<TextCell>(table.rows[1].cells[0]).text, "outdoors");
  EXPECT_EQ(std::get<NumberCell>(table.rows[1].cells[1]).value, 0.1);
  EXPECT_EQ(report.opening.numbers.items.at(0).section, section.id);
  // With a figure of its own, a setup has a section of its own.
  StudyFigures figures;
  figures.groups.push_back({view.blocks()[1].id, "outdoors", "", {Figure{.id = "f"}}});
  EXPECT_EQ(results_report({.view = view, .comparisons = {}, .figures = figures, .provenance = {}})
                .sections.size(),
            4U);
}

TEST(ResultsView, AnOverviewHasAColumnPerLevelOfAText) {
  Rows rows;
  for (const char* terrain : {"grass", "gravel", "road"})
    for (const double noise : {0.1, 0.2})
      for (const char* run : {"a", "b"})
        for (const char* method : {"m", "n"})
          rows.add(method, run, noise + (method[0] - 'm') + (terrain[1] - 'a') + (run[0] - 'a'),
                   {{"noise", noise}, {"terrain", std::string(terrain)}});
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  ASSERT_EQ(view.overviews().size(), 1U);
  const ResultsOverview& overview = view.overviews()[0];
  EXPECT_EQ(overview.title, "s: overview by terrain");
  EXPECT_EQ(overview.names, (std::vector<std::string>{"grass", "gravel", "road"}));
  const std::vector<Table> tables = overview_tables(view, overview);
  ASSERT_EQ(tables.size(), 1U);
  EXPECT_EQ(tables[0].caption, "s: overview by terrain: MPE [m], at noise 0.2");
  ASSERT_EQ(tables[0].columns.size(), 7U);
  EXPECT_EQ(tables[0].columns[3].title, "gravel");
  const auto shown = std::get<NumberCell>(tables[0].rows[1].cells[5]);
  EXPECT_DOUBLE_EQ(shown.value, 0.2 + 1.0 + ('o' - 'a') + 0.5);
  const StudyFigures figures = results_figures(view, {});
  ASSERT_EQ(figures.groups.front().id, overview.id);
  EXPECT_EQ(figures.groups.front().figures[0].panels.size(), 3U);
}

TEST(ResultsView, WithOneBlockHasNoOverview) {
  const ResultsStudy study =
      Rows().add("m", "a", 1.0, {{"noise", 1.0}}).add("m", "a", 2.0, {{"noise", 2.0}}).study();
  EXPECT_TRUE(ResultsView(study).overviews().empty());
}

TEST(ResultsView, RowsThatLackAFactorSayItInTheirTitle) {
  const ResultsStudy study = Rows()
                                 .add("m", "a", 1.0, {{"noise", 1.0}})
                                 .add("m", "a", 2.0, {{"noise", 2.0}})
                                 .add("base", "a", 3.0)
                                 .study();
  const ResultsView view(study);
  ASSERT_EQ(view.blocks().size(), 2U);
  EXPECT_EQ(view.blocks()[0].title, "s, without noise");
  EXPECT_EQ(view.blocks()[0].id, "test-s-without-noise");
  EXPECT_EQ(view.blocks()[1].title, "s");
}

TEST(ResultsView, IntervalsEndWhereNoValueCanLie) {
  const auto interval = [](const std::string& quantity, double first, double second) {
    Rows rows(quantity);
    for (const char* run : {"a", "b", "c"}) rows.add("m", run, first);
    for (const char* run : {"d", "e"}) rows.add("m", run, second);
    const ResultsStudy study = rows.study();
    const ResultsView view(study);
    const Quantity& known = known_quantity(quantity);
    const ResultsBlock& block = view.blocks()[0];
    return *view.spread(block.conditions[0], view.lines(block, known)[0], known);
  };
  const Interval share = interval("moe_percent", 60.0, 99.0);
  EXPECT_DOUBLE_EQ(share.high, 100.0);
  EXPECT_DOUBLE_EQ(interval("moe_percent", 1.0, 10.0).low, 0.0);
  EXPECT_GT(interval("moe_percent", 90.0, 101.0).high, 100.0);
  EXPECT_GT(interval("mpe_m", 60.0, 99.0).high, 100.0);
  EXPECT_LT(interval("mpe_m", -1.0, 9.0).low, 0.0);
}

TEST(ResultsView, OfFewGroupsTheSpreadIsThatOfTheRuns) {
  Rows rows;
  for (const char* run : {"a1", "a2", "b1", "c1", "d1"})
    rows.add("m", run, run[0] - 'a' + 0.1 * (run[1] - '0'));
  rows.add("n", "a1", 1.0);
  const ResultsStudy few = rows.study();
  const ResultsView view(few);
  const ResultsBlock& block = view.blocks()[0];
  const auto lines = view.lines(block, mpe());
  const auto spread = view.spread(block.conditions[0], lines[0], mpe());
  ASSERT_TRUE(spread);
  EXPECT_DOUBLE_EQ(spread->low, 0.1);
  EXPECT_DOUBLE_EQ(spread->high, 3.1);
  EXPECT_FALSE(view.spread(block.conditions[0], lines[1], mpe())) << "of one run";
  const ResultsStudy more = rows.add("m", "e1", 4.1).study();
  const ResultsView enough(more);
  const auto interval = enough.spread(enough.blocks()[0].conditions[0],
                                      enough.lines(enough.blocks()[0], mpe())[0], mpe());
  ASSERT_TRUE(interval);
  EXPECT_GT(interval->high, 3.1) << "Student's t of five groups";
  EXPECT_LT(interval->high, 4.1);
}

TEST(ResultsView, ShowsShortTimesInUnitsThatFitThem) {
  for (const auto& [seconds, unit, shown] :
       {std::tuple(0.000141, "µs", 141.0), {0.0141, "ms", 14.1}, {1.41, "s", 1.41}}) {
    ResultsStudy study = Rows().add("m", "a1", seconds).add("m", "b1", seconds).study(true);
    study.results.quantities.declare(study_quantity("took", "time", "s", Better::kLower));
    study.quantities = {"took"};
    for (Result& row : study.results.rows) row.quantity = "took";
    const ResultsView view(study);
    const Quantity& quantity = view.quantity("took");
    EXPECT_EQ(quantity.unit, unit);
    const ResultsBlock& block = view.blocks().front();
    const auto mean =
        view.mean(block.conditions.front(), view.lines(block, quantity).front(), quantity);
    ASSERT_TRUE(mean.has_value());
    EXPECT_NEAR(mean->mean, shown, 1e-9 * shown);
  }
}

TEST(ResultsView, AValueWhoseSquareIsNoNumberIsLost) {
  const ResultsStudy study = Rows().add("m", "a", 1e308).add("m", "b", -1e308).study();
  const ResultsView view(study);
  const ResultsBlock& block = view.blocks()[0];
  const RunNumbers numbers = view.numbers(block.conditions[0], view.lines(block, mpe())[0], mpe());
  EXPECT_TRUE(numbers.values.empty());
  EXPECT_EQ(numbers.lost, 2);
}

}  // namespace
}  // namespace mapproof
