#include "core/records/studies/results_study_json.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "tests/core/records/samples.hpp"
#include "tests/support/schemas/schema_problem.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

const std::string kHead =
    R"({"schema": {"name": "mapproof.results_study", "version": 1}, "title": "Errors")";
const std::string kOwn =
    R"(, "quantities": [{"id": "ate_m", "label": "ATE", "unit": "m", "better": "lower"}])";
const std::string kTable = "setup,method,quantity,run,value\ns,b,ate_m,1,2\ns,a,ate_m,1,\n";

ResultsStudy study_of(const std::string& head, const std::string& table) {
  const test::TemporaryFolder folder;
  write_file(folder / "study.json", head);
  write_file(folder / "results.csv", table);
  return read_results_study(folder.path());
}

/// The error of reading, without the folder's name.
std::string problem(const std::string& head, const std::string& table) {
  const test::TemporaryFolder folder;
  write_file(folder / "study.json", head);
  write_file(folder / "results.csv", table);
  try {
    read_results_study(folder.path());
  } catch (const IoError& error) {
    const std::string what = error.what(), prefix = folder.path().string() + "/";
    return what.starts_with(prefix) ? what.substr(prefix.size()) : what;
  }
  return "";
}

TEST(ResultsStudy, NeedsATitleAndATableAlone) {
  const ResultsStudy study = study_of(kHead + "}", "setup,method,quantity,value\n,m,mpe_m,1\n");
  EXPECT_EQ(study.name, "results");
  EXPECT_EQ(study.title, "Errors");
  EXPECT_TRUE(study.results.are_repeats);
  EXPECT_EQ(study.quantities, std::vector<std::string>{"mpe_m"});
  EXPECT_EQ(study.methods, (std::vector<Label>{{"m", "m"}}));
}

TEST(ResultsStudy, KeepsTheOrderOfItsLabelsAndAddsTheOthers) {
  const ResultsStudy study = study_of(
      kHead + kOwn + R"(, "methods": [{"id": "b", "label": "Second"}], "runs_are_repeats": false})",
      kTable);
  EXPECT_EQ(study.methods, (std::vector<Label>{{"b", "Second"}, {"a", "a"}}));
  EXPECT_FALSE(study.results.are_repeats);
  EXPECT_EQ(study.results.quantities.at("ate_m").label, "ATE");
  EXPECT_EQ(label_of(study.methods, "b"), "Second");
  EXPECT_EQ(label_of(study.methods, "c"), "c");
}

TEST(ResultsStudy, DeclaredQuantitiesWithADirectionAreJudgedByNightlyRuns) {
  const std::string more =
      R"(, "quantities": [{"id": "a_m", "label": "A", "unit": "m", "better": "lower"},
                          {"id": "b_percent", "label": "B", "unit": "%", "better": "higher"},
                          {"id": "c", "label": "C", "better": "neither"}, {"id": "mpe_m"}]})";
  const ResultsStudy study = study_of(
      kHead + more, "setup,method,quantity,value\n,m,a_m,1\n,m,b_percent,2\n,m,c,3\n,m,mpe_m,4\n");
  const Quantities& quantities = study.results.quantities;
  EXPECT_EQ(study.quantities, (std::vector<std::string>{"a_m", "b_percent", "c", "mpe_m"}));
  EXPECT_EQ(quantities.at("a_m").nightly, NightlyRule::kRatio);
  EXPECT_EQ(quantities.at("b_percent").nightly, NightlyRule::kPoints);
  EXPECT_EQ(quantities.at("c").nightly, NightlyRule::kShown);
}

TEST(ResultsStudy, WhatIsWrongIsOneLineWithFileAndPlace) {
  EXPECT_EQ(problem(kHead + kOwn + "}", kTable), "");
  EXPECT_EQ(problem(kHead + kOwn + "}", "setup,method,quantity,run,value\n"),
            "results.csv: has no row");
  EXPECT_EQ(problem(kHead + "}", kTable),
            "results.csv: line 2: there is no quantity \"ate_m\"; study.json has to declare it");
  EXPECT_EQ(problem(kHead + R"(, "metods": []})", kTable),
            "study.json: /: unknown key \"metods\": did you mean \"methods\"?");
  EXPECT_EQ(problem(kHead + kOwn + R"(, "methods": [{"id": "z", "label": "Z"}]})", kTable),
            "study.json: methods: z: results.csv has no row of it");
  EXPECT_EQ(problem(kHead + kOwn + R"(, "name": "A b"})", kTable),
            "study.json: /name: expected lower-case letters, digits and '-', a letter first, got "
            "\"A b\"");
  EXPECT_EQ(
      problem(kHead + R"(, "quantities": [{"id": "q", "label": "Q", "better": "more"}]})", kTable),
      "study.json: /quantities/0/better: expected lower, higher or neither, got \"more\"");
  EXPECT_NE(problem(kHead + R"(, "quantities": [{"id": "mpe_m", "label": "M", "unit": "cm",
                                                 "better": "lower"}]})",
                    kTable)
                .find("study.json: /quantities/0/id: \"mpe_m\" is a quantity of mapproof's, in m"),
            std::string::npos);
}

TEST(ResultsStudy, SaysWhatScansUnusualInATable) {
  const auto remarks = [](const std::string& rows) {
    const std::string own =
        R"(, "quantities": [{"id": "found", "label": "F", "unit": "%", "better": "higher"}]})";
    return remarks_of(study_of(kHead + own, "setup,method,quantity,run,value,at.noise\n" + rows));
  };
  EXPECT_TRUE(remarks("s,m,found,1,90,1\ns,m,found,2,80,1\nt,m,found,1,1,\n").empty());
  EXPECT_EQ(remarks("s,m,found,1,90,1\ns,m,found,2,80,\ns,m,found,3,80,2\n"),
            std::vector<std::string>{
                "at.noise is empty in 1 of the 3 rows of the setup \"s\", first of m, found, run "
                "2: there the factor is not given, and these rows stand in a section of their "
                "own"});
  EXPECT_EQ(remarks("s,m,found,1,0.9,1\ns,m,found,2,1,1\ns,m,found,3,,1\n"),
            std::vector<std::string>{
                "all values of found lie between 0 and 1, but its unit is %: are they shares?"});
  EXPECT_TRUE(remarks("s,m,found,1,0,1\n").empty());
  const std::string drift =
      R"(, "quantities": [{"id": "drift", "label": "D", "unit": "%", "better": "lower"}]})";
  EXPECT_TRUE(
      remarks_of(study_of(kHead + drift, "setup,method,quantity,run,value\ns,m,drift,1,0.3\n"))
          .empty());
}

TEST(ResultsStudy, SaysWhichLabelsAreTheSame) {
  const std::string methods =
      R"(, "methods": [{"id": "b", "label": "EKF"}, {"id": "a", "label": "EKF"}]})";
  EXPECT_EQ(label_remarks_of(study_of(kHead + kOwn + methods, kTable)),
            std::vector<std::string>{"methods: b and a have the same label \"EKF\": figures and "
                                     "tables do not distinguish them"});
  EXPECT_EQ(label_remarks_of(
                study_of(kHead + kOwn + R"(, "methods": [{"id": "b", "label": "a"}]})", kTable))
                .size(),
            1U)
      << "the other is labelled by its id";
  EXPECT_TRUE(label_remarks_of(study_of(kHead + kOwn + "}", kTable)).empty());
}

TEST(ResultsStudy, NamesFilesThatAreNotRead) {
  const test::TemporaryFolder folder;
  for (const char* file : {"maps/a.csv", "maps/b.txt", "maps/.hidden", "paths/a.csv", "paths/b.tum",
                           "paths/b.groundtruth.tum"})
    write_file(folder / file, "");
  EXPECT_EQ(passed_over_files(folder.path()),
            (std::vector<std::string>{"maps/b.txt: is not read: a map is maps/NAME.csv",
                                      "paths/a.csv: is not read: a path is paths/NAME.tum"}));
}

TEST(ResultsStudy, WithoutItsStudyJsonSaysWhatToAdd) {
  const test::TemporaryFolder folder;
  write_file(folder / "results.csv", kTable);
  const std::string problem = test::error_of([&] { read_results_study(folder.path()); });
  EXPECT_EQ(problem, folder.path().string() +
                         ": holds results.csv without study.json; write one beside it, at least "
                         R"({"schema": {"name": "mapproof.results_study", "version": 1}, )"
                         R"("title": "..."})");
  const std::size_t head = problem.find('{');
  EXPECT_EQ(parse_results_study(problem.substr(head), "study.json").title, "...");
}

TEST(ResultsStudy, MapsAndPathsAreGivenWhole) {
  const test::TemporaryFolder folder;
  write_file(folder / "study.json", kHead + "}");
  const auto problem_of_map = [&](const std::string& rows) {
    write_file(folder / "maps/a.csv", "name,x_m,y_m,true_x_m,true_y_m\n" + rows);
    const std::string what = test::error_of([&] { read_given_maps(folder.path()); });
    const std::string prefix = folder.path().string() + "/";
    return what.starts_with(prefix) ? what.substr(prefix.size()) : what;
  };
  EXPECT_EQ(problem_of_map("a,1,2,3,4\nb,1,2,,\nc,,,1,2\n"), "no error");
  EXPECT_EQ(problem_of_map("a,1,2,3,4\nb,1,2,3,\n"),
            "maps/a.csv: line 3: \"b\" has true_x_m and no true_y_m");
  EXPECT_EQ(problem_of_map("a,,2,3,4\n"), "maps/a.csv: line 2: \"a\" has y_m and no x_m");
  write_file(folder / "paths/a.tum", "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 0\n");
  EXPECT_EQ(
      test::error_of([&] { read_given_paths(folder.path()); }),
      (folder / "paths/a.tum").string() +
          ": line 2: the quaternion qx qy qz qw is 0 0 0 0, which is not an orientation; without "
          "one it is 0 0 0 1");
}

TEST(ResultsStudy, ErrorsDoNotShowCarriageReturns) {
  EXPECT_EQ(problem(kHead + "}", "setup,method,quantity,run,value\r\n\"s\" x\r\n"),
            "results.csv: line 2: text behind a closing quote: \"x\"");
  EXPECT_EQ(
      problem(kHead + "}", "setup,method,quantity,run,value\rs,b,mpe_m,1,2\r"),
      "results.csv: line 1: the lines end with carriage returns alone; line feeds are needed");
}

TEST(ResultsStudy, PathsAreAlignedAsItSays) {
  const test::TemporaryFolder folder;
  const auto alignment = [&](const std::string& key) {
    write_file(folder / "study.json", kHead + key + "}");
    return read_given_paths(folder.path()).at(0).alignment;
  };
  write_file(folder / "paths/a.tum", "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n");
  EXPECT_EQ(alignment(R"(, "paths": {"align": "rigid"})"), Alignment::kNone) << "no ground truth";
  write_file(folder / "paths/a.groundtruth.tum", "0 0 0 0 0 0 0 1\n1 0 1 0 0 0 0 1\n");
  EXPECT_EQ(alignment(R"(, "paths": {"align": "similarity"})"), Alignment::kSimilarity);
  EXPECT_EQ(alignment(R"(, "paths": {"align": "none"})"), Alignment::kNone);
  EXPECT_EQ(alignment(""), Alignment::kNone);
  write_file(folder / "paths/a.groundtruth.tum", "5 0 0 0 0 0 0 1\n6 0 1 0 0 0 0 1\n");
  EXPECT_THROW(alignment(R"(, "paths": {"align": "rigid"})"), IoError) << "other times";
  EXPECT_EQ(alignment(""), Alignment::kNone);
  EXPECT_EQ(problem(kHead + R"(, "paths": {"align": "best"}})", kTable),
            "study.json: /paths/align: expected none, rigid or similarity, got \"best\"");
}

TEST(ResultsStudy, OnTheDiskIsAsItsSchemaSays) {
  using nlohmann::json;
  EXPECT_EQ(test::schema_problem("results_study", json::parse(kHead + kOwn + "}")), "");
  EXPECT_NE(test::schema_problem("results_study", json::parse(kHead + R"(, "name": "A b"})")), "");
  const auto problem_of = [](const std::string& key) {
    return test::schema_problem("results_study", json::parse(kHead + ", " + key + "}"));
  };
  EXPECT_EQ(problem_of(R"("paths": {"align": "rigid"})"), "");
  EXPECT_NE(problem_of(R"("paths": {"align": "best"})"), "");
  EXPECT_NE(problem_of(R"("quantities": [{"id": "ate_m"}])"), "") << "it needs a label";
  EXPECT_NE(problem_of(R"("quantities": [{"id": "ate_m", "label": "ATE"}])"), "");
  for (const Quantity& known : all_quantities())
    EXPECT_EQ(problem_of(R"("quantities": [{"id": ")" + known.id + R"("}])"), "") << known.id;
}

}  // namespace
}  // namespace mapproof
