#include "core/records/studies/results_table.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/base/files/files.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/csv.hpp"
#include "core/records/studies/results_of.hpp"
#include "core/records/studies/slam_store.hpp"
#include "core/records/studies/study_store.hpp"
#include "core/records/studies/topic_json.hpp"
#include "core/records/studies/topic_store.hpp"
#include "core/studies/study_kind.hpp"
#include "core/studies/topic_studies.hpp"
#include "core/topics/topic.hpp"
#include "core/topics/topics.hpp"
#include "tests/core/records/samples.hpp"
#include "tests/core/records/slam_samples.hpp"

namespace mapproof {
namespace {

/// Field by field, a lost value being as good as another.
void expect_same(const std::vector<Result>& found, const std::vector<Result>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].at, expected[i].at);
    EXPECT_EQ(found[i].method, expected[i].method);
    EXPECT_EQ(found[i].quantity, expected[i].quantity);
    EXPECT_EQ(found[i].run, expected[i].run);
    EXPECT_EQ(found[i].group, expected[i].group);
    EXPECT_EQ(found[i].subject, expected[i].subject);
    if (std::isnan(expected[i].value))
      EXPECT_TRUE(std::isnan(found[i].value));
    else
      EXPECT_EQ(found[i].value, expected[i].value);
  }
}

std::vector<Result> read_back(const Results& results) {
  return parse_results_csv(results_csv(results.rows), "results.csv", results.quantities);
}

Study made_up_study() {
  Study study{
      .experiment = test::small_experiment(), .provenance = test::made_up_provenance(), .runs = {}};
  for (const int layout : {1, 2})
    for (const int pose : {1, 2}) study.runs.push_back(test::made_up_result({layout, pose}).run);
  return study;
}

SlamStudy made_up_slam_study() {
  SlamStudy study;
  study.runs = {test::made_up_slam_run("drive")};
  study.convergence = {test::made_up_convergence("white")};
  study.histories = test::made_up_histories();
  return study;
}

/// Numbers for all that the design of an experiment on disk has, every third of them lost.
TopicStudy made_up_topic_study(const TopicExperiment& experiment) {
  TopicStudy study = planned_study(experiment, test::made_up_provenance());
  double number = 0.1;
  for (int layout = 1; layout <= 2; ++layout) {
    TopicPart part;
    part.run = RunId{.layout = layout, .pose = 1};
    part.id = slug(*part.run);
    for (const TopicSetup& setup : study.design.setups)
      for (const StudiedMethod& method : study.design.methods)
        for (const Condition& at : conditions_of(setup)) {
          TopicOutcome outcome{.at = at, .method = method.id, .values = {}, .statuses = {}};
          for (std::size_t i = 0; i < study.design.quantities.size(); ++i) {
            number *= 1.7;
            if (number > 1e9) number *= 1e-12;
            outcome.values[study.design.quantities[i].id] = i % 3 == 2 ? kNaN : number;
          }
          part.outcomes.push_back(std::move(outcome));
        }
    study.parts.push_back(std::move(part));
  }
  return study;
}

TEST(ResultsTable, OfEveryKindOfStudyReadsBackAsItsResults) {
  for (const Results& results : {results_of(made_up_study()), results_of(made_up_slam_study())}) {
    ASSERT_FALSE(results.rows.empty());
    expect_same(read_back(results), results.rows);
    EXPECT_EQ(results_csv(read_back(results)), results_csv(results.rows));
  }
}

TEST(ResultsTable, OfEveryTopicReadsBackAsItsResults) {
  int topics = 0;
  for (const Topic* topic : all_topics()) {
    const std::string file =
        fmt::format("{}/experiments/{}.json", MAPPROOF_SOURCE_DIR, topic->name);
    const Results results = results_of(
        made_up_topic_study(parse_topic_experiment(read_file(file), file, input_of_topics())));
    ASSERT_FALSE(results.rows.empty()) << topic->name;
    expect_same(read_back(results), results.rows);
    ++topics;
  }
  EXPECT_EQ(topics, static_cast<int>(all_topics().size()));
  EXPECT_GT(topics, 5);
}

TEST(ResultsTable, InAStudysFolderIsWhatItsRecordsSay) {
  const test::TemporaryFolder folder;
  {
    StudyWriter store = StudyWriter(
        folder.path(), study_start(test::small_experiment(), test::made_up_provenance()));
    store.write(part_of(test::made_up_result({1, 1})));
  }
  write_results_table(folder.path());
  const std::string bytes = read_file(folder.path() / "results.csv");
  write_results_table(folder.path());
  EXPECT_EQ(read_file(folder.path() / "results.csv"), bytes);
  expect_same(parse_results_csv(bytes, "results.csv", {}),
              results_of(read_study(folder.path())).rows);
  // Records of another solver go, and the table of them.
  StudyWriter(folder.path(),
              study_start(test::small_experiment(), test::made_up_provenance("other")));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "results.csv"));
}

TEST(ResultsTable, QuotesHostileNamesAndKeepsEveryDigit) {
  Quantities quantities;
  Results results{.quantities = quantities};
  const std::string hostile = "a,\"b\";\n=1+1 # \t<x>";
  results.rows = {{.at = condition(hostile, {{"room, m", 12.5}, {"kind", hostile}}),
                   .method = hostile,
                   .quantity = "mpe_m",
                   .run = hostile,
                   .group = " g ",
                   .subject = "#7",
                   .value = 0.1 + 0.2},
                  {.at = condition("", {}),
                   .method = "m",
                   .quantity = "mpe_m",
                   .run = "1",
                   .group = "1",
                   .value = std::numeric_limits<double>::denorm_min()},
                  {.at = condition("", {}),
                   .method = "m",
                   .quantity = "mpe_m",
                   .run = "2",
                   .group = "2",
                   .value = kInfinity},
                  {.at = condition("", {}),
                   .method = "m",
                   .quantity = "mpe_m",
                   .run = "3",
                   .group = "3",
                   .value = kNaN}};
  sort_results(results);
  expect_same(read_back(results), results.rows);
}

RC_GTEST_PROP(ResultsTable, ReadsBackWhateverItsNamesAndNumbersAre, ()) {
  const auto name =
      rc::gen::container<std::string>(rc::gen::elementOf(std::string("ab ,\"\n#;'=")));
  Results results;
  const int rows = *rc::gen::inRange(1, 6);
  for (int i = 0; i < rows; ++i)
    results.rows.push_back(
        {.at = condition(*name, {{"at " + *name, *rc::gen::arbitrary<int>() / 8.0}}),
         .method = "m" + *name,
         .quantity = "mpe_m",
         .run = std::to_string(i),
         .group = std::to_string(i),
         .subject = *name,
         .value = *rc::gen::arbitrary<double>()});
  for (Result& row : results.rows)
    if (std::isnan(row.value)) row.value = kNaN;
  sort_results(results);
  expect_same(read_back(results), results.rows);
}

/// What a table of these lines is refused with.
std::string refusal_of(const std::string& lines) {
  return test::error_of([&] { parse_results_csv(lines, "results.csv", {}); });
}

TEST(ResultsTable, ThatIsWrongIsRefusedWithFileRowAndWhat) {
  const std::string head = "setup,method,quantity,run,value\n";
  EXPECT_EQ(refusal_of(head + "a,m,mpe_m,1,0.5\na,m,mpe_m,2,x\n"),
            "results.csv: line 3: value: \"x\" is not a number");
  EXPECT_EQ(refusal_of(head + "a,m,mpe_m,1\n"),
            "results.csv: line 2: 4 cells where the header has 5");
  EXPECT_EQ(refusal_of(head + "a,m,mpe,1,2\n"),
            "results.csv: line 2: there is no quantity \"mpe\"; did you mean mpe_m?");
  EXPECT_EQ(refusal_of(head + "a,m,frobs,1,2\n"),
            "results.csv: line 2: there is no quantity \"frobs\"; study.json has to declare it");
  EXPECT_EQ(refusal_of(head + "a,,mpe_m,1,2\n"), "results.csv: line 2: the method is missing");
  EXPECT_EQ(refusal_of(head + "a,m,mpe_m,2,1\na,m,mpe_m,1,1\na,m,mpe_m,2,3\n"),
            "results.csv: line 4: has the same setup, levels, method, quantity, run and subject as "
            "line 2");
  EXPECT_EQ(refusal_of("setup,method,value\na,m,1\n"),
            "results.csv: line 1: the column \"quantity\" is missing");
  EXPECT_EQ(refusal_of("setup,metod,quantity,value\n"),
            "results.csv: line 1: unknown column \"metod\"; did you mean method?");
  EXPECT_EQ(refusal_of("setup,method,method,quantity,value\n"),
            "results.csv: line 1: column \"method\" is there twice");
  EXPECT_EQ(refusal_of("setup,method,quantity,run,group,value\na,m,mpe_m,1,g,1\nb,m,mpe_m,1,h,1\n"),
            "results.csv: line 3: the run \"1\" is of the group \"h\" here and of \"g\" on line 2");
  EXPECT_EQ(refusal_of("setup,method,quantity,value,at.noise\na,m,mpe_m,1,1e101\n"),
            "results.csv: line 2: at.noise: \"1e101\" is beyond 1e100");
  EXPECT_EQ(refusal_of("setup,method,quantity,value,at.noise\na,m,mpe_m,1,-inf\n"),
            "results.csv: line 2: at.noise: \"-inf\" is beyond 1e100");
  EXPECT_NE(refusal_of(""), "no error");
  EXPECT_NE(refusal_of(head + "a,\"m,mpe_m,1,2\n"), "no error");
}

TEST(ResultsTable, ThatAnotherProgramWroteInAnotherFormSaysWhatToDo) {
  EXPECT_EQ(refusal_of("setup;method;quantity;value\na;m;mpe_m;1\n"),
            "results.csv: line 1: the cells are separated by semicolons; commas are needed: "
            "to_csv(sep=\",\")");
  EXPECT_EQ(refusal_of("setup\tmethod\tquantity\tvalue\na\tm\tmpe_m\t1\n"),
            "results.csv: line 1: the cells are separated by tabs; commas are needed: "
            "to_csv(sep=\",\")");
  for (const char* index : {"", "Unnamed: 0"})
    EXPECT_EQ(refusal_of(std::string(index) + ",setup,method,quantity,value\n0,a,m,mpe_m,1\n"),
              "results.csv: line 1: the first column has no name, as an index has: "
              "to_csv(index=False) leaves it out");
  EXPECT_EQ(refusal_of("setup,method,quantity,group,value\na,m,mpe_m,g,1\na,m,mpe_m,h,1\n"),
            "results.csv: line 1: the column \"group\" needs the column \"run\": runs are what a "
            "group is of");
}

TEST(ResultsTable, HasNumbersOrTextsForAFactorWithinASetup) {
  const std::string head = "setup,method,quantity,run,value,at.noise\n";
  EXPECT_EQ(refusal_of(head + "a,m,mpe_m,1,1,0.1\na,m,mpe_m,2,1,O.1\na,m,mpe_m,3,1,0.1\n"),
            "results.csv: line 3: at.noise: \"O.1\" is a text where 2 rows of the setup have "
            "numbers; write all levels of a factor as numbers or all as texts");
  EXPECT_EQ(refusal_of(head + "a,m,mpe_m,1,1,low\na,m,mpe_m,2,1,high\na,m,mpe_m,3,1,7\n"),
            "results.csv: line 4: at.noise: \"7\" is a number where 2 rows of the setup have "
            "texts; write all levels of a factor as numbers or all as texts");
  EXPECT_EQ(refusal_of(head + "a,m,mpe_m,1,1,low\nb,m,mpe_m,1,1,7\n"), "no error");
}

TEST(ResultsTable, MayLeaveOutRunGroupAndSubjectAndHaveAnyOrder) {
  const std::vector<Result> rows = parse_results_csv(
      "value,at.size,method,quantity,setup\r\n,9,m,mpe_m,s\r\n1.5,large,m,mpe_m,t\r\n", "r.csv",
      {});
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].at, condition("s", {{"size", 9.0}}));
  EXPECT_TRUE(std::isnan(rows[0].value));
  EXPECT_EQ(rows[1].at, condition("t", {{"size", std::string("large")}}));
  const std::vector<Result> grouped =
      parse_results_csv("setup,method,quantity,run,value\ns,m,mpe_m,7,1\n", "r.csv", {});
  EXPECT_EQ(grouped[0].group, "7");
}

TEST(ResultsTable, OfAFileIsThatOfItsText) {
  const test::TemporaryFolder folder;
  std::string text = "setup,method,quantity,run,group,value,at.noise\n";
  // Some megabytes, so that a row lies across what is read at once; a cell with a line end.
  for (int run = 60'000; run > 0; --run)
    text += fmt::format("\"a,\n{}\",m,mpe_m,run-{},g{},{},{}\n", run % 3, run, run % 7, run / 8.0,
                        run % 2 == 0 ? "" : "0.5");
  const std::filesystem::path file = folder.path() / "results.csv";
  write_file(file, text);
  const std::vector<Result> expected = parse_results_csv(text, "results.csv", {});
  ASSERT_EQ(expected.size(), 60'000U);
  expect_same(read_results_csv(file, {}), expected);
  EXPECT_TRUE(std::ranges::is_sorted(expected, comes_before));
  write_file(file, text + "a,m,mpe_m,run-1,g1\n");
  EXPECT_EQ(test::error_of([&] { read_results_csv(file, {}); }),
            file.string() + ": line 120002: 5 cells where the header has 7");
}

/// What python3 prints of a table; "no python" where it or a module is missing.
std::string python_says(const std::string& code, const std::filesystem::path& folder) {
  write_file(folder / "read.py", code);
  const std::string out = (folder / "out.txt").string();
  const int status =
      std::system(fmt::format("python3 '{}' '{}' > '{}' 2>/dev/null", (folder / "read.py").string(),
                              (folder / "results.csv").string(), out)
                      .c_str());
  return status == 0 ? read_file(out) : "no python";
}

TEST(ResultsTable, IsReadByPythonAndPandasInOneLine) {
  const test::TemporaryFolder folder;
  const Results results = results_of(made_up_study());
  write_file(folder.path() / "results.csv", results_csv(results.rows));
  const std::string by_csv = python_says(
      "import csv, sys\n"
      "rows = list(csv.DictReader(open(sys.argv[1], newline='')))\n"
      "print(len(rows), sum(row['value'] == '' for row in rows), ','.join(rows[0]))\n",
      folder.path());
  const auto lost =
      std::ranges::count_if(results.rows, [](const Result& row) { return std::isnan(row.value); });
  const std::string expected = fmt::format("{} {}", results.rows.size(), lost);
  EXPECT_EQ(by_csv,
            expected + " setup,method,quantity,run,group,subject,value,at.noise,at.steps\n");
  const std::string by_pandas = python_says(
      "import pandas, sys\n"
      "table = pandas.read_csv(sys.argv[1])\n"
      "print(len(table), table.value.isna().sum())\n",
      folder.path());
  if (by_pandas == "no python") GTEST_SKIP() << "pandas is not installed";
  EXPECT_EQ(by_pandas, expected + "\n");
}

}  // namespace
}  // namespace mapproof
