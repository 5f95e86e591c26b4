#include <algorithm>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A study that a program of someone else made: examples/results/localisers.py.
class StudyOfAnotherProgram : public ::testing::Test {
 protected:
  void SetUp() override { make("mine"); }

  void make(const std::string& name, const std::string& worse = "0") {
    const std::string script = std::string(MAPPROOF_SOURCE_DIR) + "/examples/results/localisers.py";
    const Outcome made = run_program({"python3", script, folder_ / name, worse});
    if (made.exit_code == 127) GTEST_SKIP() << "python3 is not installed";
    ASSERT_EQ(made.exit_code, 0) << made.error;
  }

  /// Puts a text in the place of the first occurrence of another.
  void change(const std::string& name, const std::string& from, const std::string& to) {
    const fs::path table = folder_ / name / "results.csv";
    std::string text = read_file(table);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    write_file(table, text.replace(at, from.size(), to));
  }

  TemporaryFolder folder_;
};

TEST_F(StudyOfAnotherProgram, GetsFiguresTablesAndAReport) {
  EXPECT_EQ(mapproof({"validate", folder_ / "mine"}).exit_code, 0);
  const Outcome outcome = mapproof({"report", folder_ / "mine"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const std::string page = read_file(folder_ / "mine/report.html");
  for (const char* part :
       {"Three localisers in ten rooms", "EKF has the lowest mean absolute trajectory error",
        "p &lt; 0.001 over 10 groups", "4 of 720 results have no value",
        "Left out, without a value in some group or in half of the runs: Scan matching"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  for (const char* file : {"figures/localisers-indoors-ate-m.svg",
                           "figures/localisers-indoors-ranks-found-percent.svg",
                           "tables/localisers-indoors-paired-ate-m.csv"})
    EXPECT_TRUE(fs::exists(folder_ / "mine" / file)) << file;
}

TEST_F(StudyOfAnotherProgram, IsComparedValueByValueWithItsTest) {
  make("baseline");
  ASSERT_EQ(mapproof({"report", folder_ / "mine"}).exit_code, 0);
  ASSERT_EQ(mapproof({"report", folder_ / "baseline"}).exit_code, 0);
  EXPECT_EQ(mapproof({"diff", folder_ / "baseline", folder_ / "mine"}).exit_code, 0);
  change("mine", "indoors,ekf,ate_m,17,room-7,0.135254", "indoors,ekf,ate_m,17,room-7,0.5");
  const Outcome outcome = mapproof({"diff", folder_ / "baseline", folder_ / "mine"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find(
                "absolute trajectory error 0.135 → 0.500 m in run 17 alone of 40, p = 0.343 of "
                "indoors, EKF, laser noise 0.05\u00a0m"),
            std::string::npos)
      << outcome.out;
  EXPECT_EQ(mapproof({"approve", folder_ / "baseline", folder_ / "mine", "--all"}).exit_code, 0);
  EXPECT_EQ(mapproof({"diff", folder_ / "baseline", folder_ / "mine"}).exit_code, 0);
}

TEST_F(StudyOfAnotherProgram, WhoseReportIsMissingAsAWholeIsOneLine) {
  make("baseline");
  ASSERT_EQ(mapproof({"report", folder_ / "baseline"}).exit_code, 0);
  const Outcome outcome = mapproof({"diff", folder_ / "baseline", folder_ / "mine"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("the current has no report: 8 items of the baseline"),
            std::string::npos)
      << outcome.out;
  // CTest's own environment adds a measurement per verdict.
  std::istringstream lines(outcome.out);
  long said = 0;
  for (std::string line; std::getline(lines, line);) said += line.starts_with('<') ? 0 : 1;
  EXPECT_LE(said, 3) << outcome.out;
  EXPECT_EQ(mapproof({"diff", folder_ / "mine", folder_ / "baseline"}).exit_code, 0);
}

TEST_F(StudyOfAnotherProgram, WhoseRecordsAreApprovedAloneHasAStaleReport) {
  make("baseline", "0.05");
  ASSERT_EQ(mapproof({"report", folder_ / "baseline"}).exit_code, 0);
  const Outcome records = mapproof({"approve", folder_ / "baseline", folder_ / "mine", "records"});
  EXPECT_EQ(records.exit_code, 0);
  EXPECT_NE(records.error.find("baseline/report.html: shows the earlier records"),
            std::string::npos)
      << records.error;
  make("baseline", "0.05");
  ASSERT_EQ(mapproof({"report", folder_ / "mine"}).exit_code, 0);
  const Outcome all = mapproof({"approve", folder_ / "baseline", folder_ / "mine", "--all"});
  EXPECT_EQ(all.error.find("earlier records"), std::string::npos) << all.error;
}

TEST_F(StudyOfAnotherProgram, HasItsPathsAlignedIfItAsks) {
  // The estimate is the ground truth, turned by a right angle and moved.
  std::string path, ground_truth;
  for (int i = 0; i < 20; ++i) {
    path += fmt::format("{} {} {} 0 0 0 0 1\n", i, 5 - i % 4, 7 + i);
    ground_truth += fmt::format("{} {} {} 0 0 0 0 1\n", i, i, i % 4);
  }
  write_file(folder_ / "mine/paths/drive.tum", path);
  write_file(folder_ / "mine/paths/drive.groundtruth.tum", ground_truth);
  const auto figure = [&] {
    EXPECT_EQ(mapproof({"report", folder_ / "mine"}).exit_code, 0);
    return json::parse(read_file(folder_ / "mine/figures/localisers-path-drive.figure.json"));
  };
  EXPECT_NE(figure()["caption"].get<std::string>().find("nothing was aligned"), std::string::npos);
  json study = json::parse(read_file(folder_ / "mine/study.json"));
  study["paths"] = {{"align", "rigid"}};
  write_file(folder_ / "mine/study.json", study.dump());
  const std::string caption = figure()["caption"];
  EXPECT_NE(caption.find("aligned by rotation and translation"), std::string::npos) << caption;
  EXPECT_NE(caption.find("RMS distance from the ground truth: "), std::string::npos) << caption;
}

TEST_F(StudyOfAnotherProgram, NamesAFewFindingsOfANightlyRunAndWhereAllAre) {
  const auto nightly_run = [&](const std::string& more = "--quiet") {
    return mapproof({"nightly", folder_ / "mine", "--store", folder_ / "history", more});
  };
  EXPECT_EQ(nightly_run().exit_code, 0);
  make("mine", "0.05");  // Three noises, two quantities.
  const Outcome second = nightly_run("--json");
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_EQ(json::parse(second.out)["findings"].size(), 6U);
  const Outcome third = nightly_run("--jobs=1");
  EXPECT_NE(third.out.find("6 findings."), std::string::npos) << third.out;
  EXPECT_NE(third.out.find("  localisers: and 3 more: "), std::string::npos) << third.out;
  EXPECT_NE(third.out.find("trends/localisers/report.html#section-findings"), std::string::npos);
  EXPECT_NE(
      read_file(folder_ / "history/trends/localisers/report.html").find("id=\"section-findings\""),
      std::string::npos);
}

TEST_F(StudyOfAnotherProgram, IsNotTakenForObservationsWithoutItsStudyJson) {
  fs::copy(fs::path(folder_ / "mine") / "results.csv", folder_ / "numbers.csv");
  const Outcome outcome = mapproof({"validate", folder_ / "numbers.csv"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE((outcome.out + outcome.error).find("check the study's folder"), std::string::npos)
      << outcome.out << outcome.error;
}

TEST_F(StudyOfAnotherProgram, IsJudgedByNightlyRuns) {
  const auto nightly_run = [&] {
    return mapproof({"nightly", folder_ / "mine", "--store", folder_ / "history"});
  };
  EXPECT_EQ(nightly_run().exit_code, 0);
  const Outcome second = nightly_run();
  EXPECT_EQ(second.exit_code, 0) << second.out;
  EXPECT_NE(second.out.find("Nothing got worse"), std::string::npos) << second.out;
  make("mine", "0.05");
  const Outcome third = nightly_run();
  EXPECT_EQ(third.exit_code, 1) << third.out;
  for (const char* part : {"absolute trajectory error", "higher than in nightly run 2",
                           "EKF, laser noise 0.1", "and 3 more: ", "#section-findings"})
    EXPECT_NE(third.out.find(part), std::string::npos) << part << " in:\n" << third.out;
}

/// Colour, dash and marker of each line of a figure, by its label.
std::map<std::string, std::string> styles_in(const fs::path& file) {
  std::map<std::string, std::string> styles;
  const json figure = json::parse(read_file(file));
  for (const json& layer : figure["panels"][0]["layers"])
    if (layer["kind"] == "polyline")
      styles[layer["label"]] =
          layer["colour"].dump() + layer["dash"].dump() + layer["marker"].dump();
  return styles;
}

TEST_F(StudyOfAnotherProgram, HasPagesOfANightlyRunThatAgree) {
  const auto nightly_run = [&] {
    return mapproof({"nightly", folder_ / "mine", "--store", folder_ / "history"}).exit_code;
  };
  ASSERT_EQ(nightly_run(), 0);
  make("mine", "0.05");
  ASSERT_EQ(nightly_run(), 1);
  const fs::path store = folder_ / "history", study = store / "nightly_runs/0002/localisers";

  // A method has one colour, dash and marker in its report and in the trends, whatever its level.
  const auto reported = styles_in(study / "figures/localisers-indoors-ate-m.figure.json");
  const auto trends =
      styles_in(store / "trends/localisers/figures/trend-ate-m-indoors.figure.json");
  ASSERT_EQ(trends.size(), 3U);
  EXPECT_TRUE(trends.contains("EKF, all 3 settings")) << "each has a finding";
  for (const auto& [label, style] : trends)
    EXPECT_EQ(style, reported.at(label.substr(0, label.find(", ")))) << label;

  // The comparison has the nightly run's verdict, and names nightly runs.
  const std::string page = read_file(store / "compare/0001-0002/localisers.html");
  EXPECT_EQ(page.find("too few"), std::string::npos);
  EXPECT_NE(page.find("What differs: <bdi>nightly run 1, "), std::string::npos);
  EXPECT_NE(page.find("Nightly run 2: accuracy got worse: 6 findings: indoors, EKF: "),
            std::string::npos);
  EXPECT_EQ(page.find("No p: there are too few"), std::string::npos)
      << "what the nightly run tests has a p in the comparison, too";
  EXPECT_EQ(page.find("Stale:"), std::string::npos) << "ranks can stay while errors change";
  // What a finding is about is called worse, and comes first.
  const std::string scores = page.substr(page.find("id=\"table-scores-"), 3000);
  EXPECT_NE(scores.find("<bdi>indoors, EKF, "), std::string::npos) << scores;
  EXPECT_LT(scores.find("data, worse"), scores.find("</tr>", scores.find("<tbody>"))) << scores;

  // A table whose columns are levels marks the method that got worse, and says at which levels.
  const std::string report = read_file(study / "report.html");
  const std::size_t table = report.find("id=\"table-localisers-indoors-ate-m\"");
  const std::size_t row = report.find("class=\"regressed\"", table);
  ASSERT_LT(row, report.find("id=\"table-", table + 10));
  EXPECT_NE(report.substr(row, 2000).find("(all 3 levels of laser noise)"), std::string::npos)
      << report.substr(row, 2000);
}

TEST_F(StudyOfAnotherProgram, IsNamedByItsOwnLabelsInEveryNightlyRun) {
  // Ids that mapproof has methods of; one is labelled, two stand under their ids.
  const auto rename = [&] {
    const fs::path folder = folder_ / "mine";
    json head = json::parse(read_file(folder / "study.json"));
    head["methods"] = json::array({{{"id", "ekf"}, {"label", "My EKF"}}});
    head["setups"] = json::array({{{"id", "indoors"}, {"label", "The hall"}}});
    write_file(folder / "study.json", head.dump());
    std::string table = read_file(folder / "results.csv");
    for (const auto& [from, to] : {std::pair(",mcl,", ",spectral,"), {",icp,", ",isomap-K6,"}})
      for (std::size_t at = 0; (at = table.find(from, at)) != std::string::npos;)
        table.replace(at, std::string(from).size(), to);
    write_file(folder / "results.csv", table);
  };
  const fs::path store = folder_ / "history";
  Outcome last;
  for (const char* worse : {"0", "0.05"}) {
    make("mine", worse);
    rename();
    last = mapproof({"nightly", folder_ / "mine", "--store", store});
  }
  EXPECT_EQ(last.exit_code, 1) << last.error;
  EXPECT_NE(last.out.find("localisers: The hall, My EKF, laser noise 0.01\u00a0m: "),
            std::string::npos)
      << last.out;

  std::vector<std::pair<std::string, std::string>> shown = {
      {"console", last.out}, {"list", mapproof({"history", store}).out}};
  std::string figures;
  for (const auto& [file, bytes] : contents(store)) {
    if (file.ends_with(".html") && !file.starts_with("compare/")) shown.emplace_back(file, bytes);
    if (file.starts_with("trends/") && file.ends_with(".figure.json")) figures += bytes;
  }
  EXPECT_GE(shown.size(), 6U);
  shown.emplace_back("figures", figures);
  for (const auto& [where, text] : shown) {
    if (where != "nightly_runs/0001/localisers/report.html") {
      EXPECT_NE(text.find("My EKF"), std::string::npos) << where;
      EXPECT_NE(text.find("The hall"), std::string::npos) << where;
    }
    for (const char* ours : {"extended Kalman filter", "ISOMAP", "spectral, 4-D"})
      EXPECT_EQ(text.find(ours), std::string::npos) << ours << " in " << where;
  }
  for (const char* label :
       {"\"My EKF, laser noise 0.01\u00a0m\"", "\"spectral, laser noise 0.01\u00a0m\"",
        "\"isomap-K6, laser noise 0.01\u00a0m\""})
    EXPECT_NE(figures.find(label), std::string::npos) << label;
  const std::string csv = mapproof({"history", store, "--export", "csv"}).out;
  EXPECT_NE(csv.find(",indoors,ekf noise=0.01,0,ate_m,"), std::string::npos) << "ids stay";
  EXPECT_NE(csv.find(",The hall,\"My EKF, laser noise 0.01\u00a0m\"\r\n"), std::string::npos);
  const json exported = json::parse(mapproof({"history", store, "--export", "json"}).out);
  EXPECT_EQ(exported["schema"]["name"], "mapproof.history");
  EXPECT_EQ(exported["nightly_runs"][1]["studies"][0]["methods"][0].dump(),
            R"({"id":"ekf","label":"My EKF"})");
}

TEST_F(StudyOfAnotherProgram, WithoutANameIsNotTakenForAnother) {
  make("theirs");
  for (const char* name : {"mine", "theirs"}) {
    const fs::path file = fs::path(folder_ / name) / "study.json";
    json head = json::parse(read_file(file));
    head.erase("name");
    write_file(file, head.dump());
  }
  const std::string mine = folder_ / "mine", theirs = folder_ / "theirs";
  const auto nightly_run = [&](const std::vector<std::string>& folders) {
    std::vector<std::string> words = {"nightly", "--store", folder_ / "history"};
    words.insert(words.end(), folders.begin(), folders.end());
    return mapproof(words);
  };
  const Outcome both = nightly_run({mine, theirs});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_EQ(both.error, "mapproof: " + mine + "/study.json and " + theirs +
                            "/study.json: both studies have the name \"results\", which is that of "
                            "a study.json without one; add a \"name\" of its own to one of them\n");
  EXPECT_FALSE(fs::exists(folder_ / "history/nightly_runs"));
  EXPECT_EQ(nightly_run({mine, mine}).error, "mapproof: " + mine + "/study.json: is given twice\n");
  make("theirs");  // Named again.
  EXPECT_EQ(nightly_run({mine, theirs}).exit_code, 0);
  make("mine");
  EXPECT_NE(nightly_run({mine, theirs}).error.find("both studies have the name \"localisers\"; "),
            std::string::npos);
}

TEST_F(StudyOfAnotherProgram, WithAWrongTableIsOneLineThatNamesTheRow) {
  change("mine", "indoors,mcl,ate_m,1,room-1,", "indoors,mcl,ate_m,1,room-1,x");
  for (const char* command : {"report", "validate"}) {
    const Outcome outcome = mapproof({command, folder_ / "mine"});
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_NE((outcome.error + outcome.out).find("results.csv: line 2: value: "), std::string::npos)
        << outcome.error << outcome.out;
  }
  EXPECT_FALSE(fs::exists(folder_ / "mine/report.html"));
}

}  // namespace
}  // namespace mapproof::test
