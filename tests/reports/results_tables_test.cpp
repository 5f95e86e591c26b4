#include "reports/sections/results/results_tables.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include <gtest/gtest.h>

#include "reports/model/format.hpp"
#include "reports/sections/results/results_comparison.hpp"
#include "reports/tables/write_tables.hpp"
#include "tests/reports/results_rows.hpp"

namespace mapproof {
namespace {

/// The page's text of a table's cell.
std::string shown(const Table& table, std::size_t row, std::size_t column) {
  return page_cell(table.rows.at(row).cells.at(column), table.columns.at(column));
}

TEST(ResultsTables, NumberAndUnitStayOnOneLineInHeadsOfColumns) {
  Rows rows;
  for (const double side : {1.5, 4.0})
    for (const double noise : {0.1, 0.2, 0.3})
      rows.add("m", "a", side + noise, {{"noise", noise}, {"side", side}});
  ResultsStudy study = rows.study();
  for (Label& factor : study.factors)
    if (factor.id == "side") factor.unit = "m";
  const ResultsView view(study);
  ASSERT_EQ(view.overviews().size(), 1U);
  const Table table = overview_tables(view, view.overviews()[0]).at(0);
  EXPECT_EQ(table.columns[1].title, "side 1.5\u00A0m");
  EXPECT_NE(table_csv(table).find("side: side 1.5 m"), std::string::npos) << table_csv(table);
}

TEST(ResultsTables, OfFewGroupsHaveTheReachOfTheRunsAndNoInterval) {
  Rows rows;
  for (const char* run : {"a1", "b1"}) rows.add("m", run, run[0] - 'a' + 1.0);
  const ResultsStudy few = rows.study();
  const ResultsView view(few);
  const Table table = results_tables(view, view.blocks()[0]).at(0);
  EXPECT_EQ(table.columns.at(2).title, "runs");
  EXPECT_EQ(shown(table, 0, 2), "1.00 to 2.00");
  EXPECT_NE(table.notes.at(0).find("too few for an interval"), std::string::npos);
  for (const char* run : {"c1", "d1", "e1"}) rows.add("m", run, run[0] - 'a' + 1.0);
  const ResultsStudy more = rows.study();
  const ResultsView enough(more);
  const Table with = results_tables(enough, enough.blocks()[0]).at(0);
  EXPECT_EQ(with.columns.at(2).title, "95 %");
  EXPECT_NE(with.notes.at(0).find("95 % interval"), std::string::npos);
}

TEST(ResultsTables, SayOfMethodsThatDivergedOnlyWhereOthersDidNot) {
  const std::vector<Level> levels = {{"noise", 0.1}};
  const ResultsStudy some =
      Rows().add("good", "a1", 0.5, levels).add("lost", "a1", 4e12, levels).study();
  const ResultsView view(some);
  const Table table = results_tables(view, view.blocks()[0]).at(0);
  EXPECT_EQ(shown(table, 0, 1), "0.500");
  EXPECT_EQ(shown(table, 1, 1), "over 1\u00A0km");

  const ResultsStudy all = Rows().add("a", "a1", 4000.0).add("b", "a1", 9000.0).study();
  const ResultsView far(all);
  EXPECT_EQ(shown(results_tables(far, far.blocks()[0]).at(0), 0, 1).substr(0, 4), "4000");
}

TEST(ResultsTables, SayHowOftenAMethodEndedWithAStatus) {
  ResultsStudy study = Rows()
                           .add("m", "a1", 1.0, {{"noise", 0.1}})
                           .add("m", "b1", 2.0, {{"noise", 0.1}})
                           .add("m", "b1", 2.5, {{"noise", 0.2}})
                           .study();
  const Condition at = condition("s", {{"noise", 0.1}});
  study.results.outcomes = {{at, "m", "a1", {"not_converged", "not_converged"}},
                            {at, "m", "b1", {"not_euclidean"}}};
  const ResultsView view(study);
  const std::vector<std::string> notes = results_tables(view, view.blocks()[0]).at(0).notes;
  ASSERT_GE(notes.size(), 2U);
  EXPECT_EQ(notes[notes.size() - 2], "m: not converged in 1 of 2 at noise 0.1.");
  EXPECT_EQ(notes.back(), "m: not Euclidean in 1 of 2 at noise 0.1.");
}

TEST(ResultsTables, SayWhereAMethodWasNotTried) {
  Rows rows;
  for (const double references : {10.0, 40.0, 100.0}) {
    rows.add("all", "a1", 1.0, {{"references", references}});
    if (references == 10.0) rows.add("few", "a1", 2.0, {{"references", references}});
  }
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  EXPECT_EQ(results_tables(view, view.blocks()[0]).at(0).notes,
            std::vector<std::string>{"few: not tried at references 40 and references 100."});
}

TEST(ResultsTables, SayWhatIsTheSameOfSeveralMethodsOnce) {
  ResultsStudy study = Rows().add("m", "a", NAN).add("n", "a", NAN).add("o", "a", 1.0).study();
  study.methods[1].label = "Range, ISOMAP";
  for (const char* method : {"m", "n"})
    study.results.outcomes.push_back({condition("s", {}), method, "a", {"failed"}});
  study.results.outcomes.push_back({condition("s", {}), "o", "a", {"not_converged"}});
  const ResultsView view(study);
  const Table table = results_tables(view, view.blocks()[0]).at(0);
  EXPECT_EQ(table.notes,
            (std::vector<std::string>{"m; Range, ISOMAP: 1 value lost (MPE).",
                                      "m; Range, ISOMAP: failed.", "o: not converged."}));
}

TEST(ResultsTables, NameWhereAMethodLostValuesInOneNote) {
  Rows rows;
  for (const double noise : {0.1, 0.2})
    rows.add("m", "a", NAN, {{"noise", noise}}).add("n", "a", noise, {{"noise", noise}});
  rows.add("m", "a", 1.0, {{"noise", 0.3}}).add("n", "a", 1.0, {{"noise", 0.3}});
  const ResultsStudy study = rows.study();
  const ResultsView view(study);
  const Table table = results_tables(view, view.blocks()[0]).at(0);
  ASSERT_EQ(table.notes.size(), 1U);
  EXPECT_EQ(table.notes[0], "m: 1 value lost each (noise 0.1 and noise 0.2).");
}

TEST(ResultsTables, GiveNoIntervalOfADifferenceBetweenEqualValues) {
  Rows rows;
  for (const char* run : {"a", "b", "c", "d", "e"})
    for (const char* method : {"m", "n", "o"})
      rows.add(method, run, (method[0] == 'o' ? 2.0 : 1.0) + 0.1 * (run[0] - 'a') * method[0]);
  ResultsStudy study = rows.study();
  for (Result& row : study.results.rows)
    if (row.method == Name("n")) row.value = 1.0 + 0.1 * (row.run.get()[0] - 'a') * 'm';
  const ResultsView view(study);
  const Table table = comparison_table(view, compare_methods(view).at(0));
  EXPECT_TRUE(std::holds_alternative<MissingCell>(table.rows.at(1).cells.at(4)));
  EXPECT_TRUE(std::holds_alternative<IntervalCell>(table.rows.at(2).cells.at(4)));
}

TEST(ResultsTables, HaveTheStudysLabelsOfKnownQuantities) {
  ResultsStudy study = Rows().add("m", "a1", 1.0).study();
  study.quantity_labels = {{.id = "mpe_m", .label = "MPE of the pick"}};
  const ResultsView view(study);
  EXPECT_EQ(results_tables(view, view.blocks()[0]).at(0).columns.at(1).title, "MPE of the pick");
}

TEST(ResultsTables, MethodsOfTheSameLabelHaveARowEach) {
  Rows rows;
  for (const char* light : {"day", "noon"})
    rows.add("m", "a", 1.0, {{"light", std::string(light)}, {"size", 1.0}})
        .add("n", "a", 2.0, {{"light", std::string(light)}, {"size", 1.0}});
  ResultsStudy study = rows.study();
  for (Label& method : study.methods) method.label = "EKF";
  const ResultsView view(study);
  for (const Table& table : results_tables(view, view.blocks()[0]))
    EXPECT_EQ(table.rows.size(), 2U);
  ResultsStudy single = Rows().add("m", "a", 1.0).add("n", "a", 2.0).study();
  for (Label& method : single.methods) method.label = "EKF";
  const ResultsView other(single);
  EXPECT_EQ(results_tables(other, other.blocks()[0]).at(0).rows.size(), 2U);
}

TEST(ResultsTables, LabelledRunsHaveATableEach) {
  ResultsStudy study =
      Rows().add("m", "a1", 1.0).add("m", "b1", 3.0).add("n", "a1", 2.0).study(false);
  study.runs = {{.id = "a1", .label = "First set"}, {.id = "b1", .label = "Second set"}};
  const ResultsView view(study);
  const std::vector<Table> tables = results_tables(view, view.blocks()[0]);
  ASSERT_EQ(tables.size(), 2U);
  EXPECT_EQ(tables[0].id, "test-s-a1");
  EXPECT_EQ(tables[0].caption, "First set: s");
  EXPECT_EQ(tables[0].rows.size(), 2U);
  EXPECT_EQ(tables[1].rows.size(), 1U);
}

TEST(ResultsTables, OfOneNumberIsLeftToTheSentenceThatSaysIt) {
  Rows rows;
  for (const double noise : {0.1, 0.2})
    for (const char* method : {"m", "n"})
      for (const char* run : {"a", "b"}) rows.add(method, run, 3.0 + noise, {{"noise", noise}});
  ResultsStudy study = rows.study();
  for (Result row : std::vector(study.results.rows)) {
    row.quantity = "moe_percent";
    row.value = 100.0;
    study.results.rows.push_back(std::move(row));
  }
  study.quantities.push_back("moe_percent");
  sort_results(study.results);
  const auto tables_of = [&] {
    const ResultsView view(study);
    std::vector<std::string> all;
    for (const Table& table : results_tables(view, view.blocks()[0])) all.push_back(table.id);
    return all;
  };
  EXPECT_EQ(tables_of().size(), 1U) << "a table of 100 | 100 to 100";
  std::ranges::find(study.results.rows, "moe_percent", &Result::quantity)->value = 99.0;
  EXPECT_EQ(tables_of().size(), 2U);
}

}  // namespace
}  // namespace mapproof
