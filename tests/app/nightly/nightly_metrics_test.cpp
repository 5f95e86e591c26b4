#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/console.hpp"
#include "app/study/study_request.hpp"
#include "app/study/study_run.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "tests/support/program.hpp"
#include "tests/support/schemas/schema_problem.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A file of metrics as github-action-benchmark's custom tools read it.
std::string metrics(double solve_ms) {
  return fmt::format(
      R"([{{"name": "solve <script>alert(1)</script>", "unit": "ms", "value": {}}},
          {{"name": "load", "unit": "ms", "value": 5}}])",
      solve_ms);
}

/// A program under test: a git repository with a commit a nightly run, and its history.
class Project {
 public:
  Project() {
    shell(
        "git init -q -b main . && git config user.email a@b.example && git config user.name a && "
        "git remote add origin https://name:secret@github.com/me/solver.git");
  }

  fs::path store() const { return folder_ / "history"; }
  fs::path path() const { return folder_.path(); }

  Outcome shell(const std::string& command) const {
    return run_program({"sh", "-c",
                        fmt::format("cd '{}' && export PATH=\"{}:$PATH\" && {}", path().string(),
                                    fs::path(program()).parent_path().string(), command)});
  }

  /// Commits a program that measures that, and makes a nightly run of it.
  Outcome nightly(double solve_ms, const std::string& more = "") const {
    write_file(path() / "speed.json", metrics(solve_ms));
    return shell(
        fmt::format("git add speed.json && git commit -q --allow-empty -m step && mapproof "
                    "nightly --metrics speed.json --better lower --store history --json "
                    "--build true {}",
                    more));
  }

  /// Six nightly runs, the last two of which are slower: the second of these is found.
  Outcome regress(const std::string& more = "") const {
    for (int i = 0; i < 4; ++i) EXPECT_EQ(nightly(10.0).exit_code, 0);
    EXPECT_EQ(nightly(13.0).exit_code, 0) << "one alone is a suspicion";
    return nightly(13.0, more);
  }

 private:
  TemporaryFolder folder_;
};

TEST(NightlyMetrics, ThatGotWorseTwiceAreFoundWithTheirCommits) {
  const Project project;
  const Outcome outcome = project.regress(
      "--markdown n.md --junit n.xml --on-worse 'cat > sent.md; echo $MAPPROOF_COMMITS >> "
      "sent.md'");
  ASSERT_EQ(outcome.exit_code, 1) << outcome.error << outcome.out;
  const json result = json::parse(outcome.out);
  ASSERT_EQ(result["findings"].size(), 1U) << outcome.out;
  EXPECT_EQ(result["findings"][0]["since"], 5);
  EXPECT_NEAR(result["findings"][0]["change"].get<double>(), 30.0, 1e-6);
  EXPECT_EQ(result["repository"], "https://github.com/me/solver") << "and no secret";
  const std::string range = project.shell("git rev-parse --short=9 HEAD~2").out.substr(0, 9) +
                            ".." + project.shell("git rev-parse --short=9 HEAD~1").out.substr(0, 9);
  for (const char* file : {"n.md", "n.xml", "sent.md", "history/index.html", "history/feed.xml"}) {
    const std::string text = read_file(project.path() / file);
    EXPECT_NE(text.find(range), std::string::npos) << file;
    EXPECT_EQ(text.find("<script>alert"), std::string::npos) << file;
    EXPECT_EQ(text.find("secret"), std::string::npos) << file;
  }
  EXPECT_NE(read_file(project.store() / "badge.svg").find("+30.0"), std::string::npos);
  const json exported = json::parse(mapproof({"history", project.store(), "--export", "json"}).out);
  EXPECT_EQ(schema_problem("history", exported), "");
}

TEST(NightlyMetrics, HaveNoLinkToAComparisonThatCouldNotBeMade) {
  const Project project;
  for (const double solve_ms : {10.0, 10.0, 10.0, 10.0, 13.0})
    ASSERT_EQ(project.nightly(solve_ms).exit_code, 0);
  const std::string page = "compare/0004-0005/speed.html";
  const fs::path folder = (project.store() / page).parent_path();
  fs::create_directories(folder.parent_path());
  write_file(folder, "a file where the folder of the page is to be");
  const Outcome damaged = project.nightly(13.0);
  EXPECT_EQ(damaged.exit_code, 1) << "it is judged all the same: " << damaged.error;
  EXPECT_NE(damaged.error.find("0004-0005"), std::string::npos) << damaged.error;
  const auto links_to_it = [&](const char* file) {
    return read_file(project.store() / file).find(page) != std::string::npos;
  };
  EXPECT_FALSE(fs::exists(project.store() / page));
  EXPECT_FALSE(links_to_it("index.html"));
  EXPECT_FALSE(links_to_it("nightly_runs/0006/speed/report.html"));
  fs::remove(folder);
  ASSERT_EQ(project.nightly(13.0).exit_code, 1);
  EXPECT_TRUE(fs::exists(project.store() / page));
  EXPECT_TRUE(links_to_it("index.html"));
  EXPECT_TRUE(links_to_it("nightly_runs/0007/speed/report.html"));
}

TEST(NightlyMetrics, ThatComeAndGoStayOneStudy) {
  const Project project;
  ASSERT_EQ(project.nightly(10.0).exit_code, 0);
  write_file(
      project.path() / "speed.json",
      R"([{"name": "load", "unit": "ms", "value": 5}, {"name": "new", "unit": "MB", "value": 1},
                 {"name": "solve <script>alert(1)</script>", "unit": "ms", "value": 10}])");
  const Outcome outcome =
      project.shell("mapproof nightly --metrics speed.json --better lower --store history --json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(json::parse(outcome.out)["reference"], 1) << "it is compared";
}

/// Eight runs of two methods; the solve takes so long.
std::string plain_table(double solve_ms) {
  std::string text = "setup,method,quantity,run,value\n";
  for (int run = 1; run <= 8; ++run)
    text += fmt::format(",solve,duration_ms,{0},{1}\n,load,duration_ms,{0},5.{0}\n", run,
                        solve_ms + 0.01 * run);
  return text;
}

TEST(NightlyTables, WithoutAStudyJsonAreJudgedByTheGivenDirection) {
  const Project project;
  fs::create_directory(project.path() / "bench");
  const auto nightly = [&](double solve_ms, const std::string& given) {
    write_file(project.path() / "bench/results.csv", plain_table(solve_ms));
    return project.shell("mapproof nightly " + given + " --better lower --store history --json");
  };
  EXPECT_EQ(nightly(10.0, "bench/results.csv").exit_code, 0);
  EXPECT_EQ(nightly(10.0, "bench").exit_code, 0);
  const Outcome worse = nightly(13.0, "./bench/results.csv");
  ASSERT_EQ(worse.exit_code, 1) << worse.error << worse.out;
  const json result = json::parse(worse.out);
  ASSERT_EQ(result["findings"].size(), 1U) << worse.out;
  EXPECT_EQ(result["findings"][0]["quantity"], "duration_ms");
  EXPECT_NE(worse.out.find("bench"), std::string::npos) << "named after its folder";
}

TEST(NightlyTables, ThatChangeWhileTheyAreReadAreRefused) {
  const TemporaryFolder folder;
  const fs::path file = folder / "results.csv";
  write_file(file, plain_table(10.0));
  int reads = 0;
  EXPECT_EQ(read_unchanged(file, [&] { ++reads; }).size(), 64U);
  EXPECT_EQ(reads, 1);
  const auto message = [](const auto& what) -> std::string {
    try {
      what();
    } catch (const IoError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message([&] { read_unchanged(file, [&] { write_file(file, plain_table(13.0)); }); }),
            file.string() + ": " + kChangedWhileRead);
}

TEST(NightlyStudies, ThatChangeBeforeTheyAreCopiedAreRefused) {
  const TemporaryFolder folder;
  const fs::path given = folder / "given";
  fs::create_directory(given);
  write_file(given / "study.json",
             R"({"schema": {"name": "mapproof.results_study", "version": 1}, "title": "T"})");
  write_file(given / "results.csv", "setup,method,quantity,run,value\n,solve,mpe_m,1,0.1\n");
  const StudyRequest request = given_study_request(given);
  const Console console(Verbosity::kQuiet, false, "nightly");
  EXPECT_NO_THROW(make_study(request, folder / "copy", 1, {}, console));
  write_file(given / "results.csv", "setup,method,quantity,run,value\n,solve,mpe_m,1,0.2\n");
  try {
    make_study(request, folder / "other", 1, {}, console);
    ADD_FAILURE() << "the copy is of another table";
  } catch (const IoError& error) {
    EXPECT_EQ(std::string(error.what()), given.string() + ": " + kChangedWhileRead);
  }
}

TEST(NightlyTables, ThatCannotBeUsedAreRefusedInALine) {
  const Project project;
  const auto refusal = [&](const std::string& table, const std::string& more) {
    write_file(project.path() / "speed.csv", table);
    const Outcome outcome = project.shell("mapproof nightly speed.csv --store history" + more);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    EXPECT_FALSE(fs::exists(project.store())) << table;
    return outcome.error;
  };
  EXPECT_NE(refusal(plain_table(1.0), "").find("speed.csv: the quantity \"duration_ms\""),
            std::string::npos);
  EXPECT_NE(refusal("setup,method,quantity\n,a,b\n", " --better lower").find("speed.csv"),
            std::string::npos);
  EXPECT_NE(refusal("setup,method,quantity,value\n", " --better lower").find("has no row"),
            std::string::npos);
  EXPECT_NE(refusal("setup,method,quantity,value\n,a,No Id,1\n", " --better lower").find("No Id"),
            std::string::npos);
}

TEST(NightlyMetrics, AreBisectedByTheValueThatIsNearer) {
  const Project project;
  ASSERT_EQ(project.regress().exit_code, 1);
  const auto bisect = [&](const std::string& text, int since = 5) {
    write_file(project.path() / "speed.json", text);
    return project.shell(fmt::format(
        "mapproof nightly --metrics speed.json --better lower --store history --bisect {}", since));
  };
  EXPECT_EQ(bisect(metrics(10.4)).exit_code, 0);
  EXPECT_EQ(bisect(metrics(12.6)).exit_code, 1);
  EXPECT_EQ(bisect(R"([{"name": "load", "unit": "ms", "value": 5}])").exit_code, 125);
  EXPECT_EQ(bisect(metrics(10.0), 2).exit_code, 2) << "nothing got worse then";
  EXPECT_EQ(
      json::parse(mapproof({"history", project.store(), "--json"}).out)["nightly_runs"].size(), 6U)
      << "nothing is recorded";
  const Outcome run = project.shell(
      "git checkout -q . && git bisect start HEAD~1 HEAD~2 && git bisect run sh -c '(true) || exit "
      "125; mapproof "
      "nightly --metrics speed.json --better lower --store history --bisect 5'");
  EXPECT_NE(run.out.find("is the first bad commit"), std::string::npos) << run.out << run.error;
}

TEST(NightlyMetrics, ThatAreKnownFailNoNightlyRunUntilTheyGetWorse) {
  const Project project;
  ASSERT_EQ(project.regress().exit_code, 1);
  ASSERT_EQ(
      mapproof({"history", project.store(), "--known", "6.1", "bigger input, <b>12</b>"}).exit_code,
      0);
  EXPECT_EQ(read_file(project.store() / "index.html").find("<b>12"), std::string::npos);
  EXPECT_NE(read_file(project.store() / "index.html").find("bigger input"), std::string::npos);
  const Outcome same = project.nightly(13.0, "--on-worse 'touch called'");
  EXPECT_EQ(same.exit_code, 0) << same.out;
  EXPECT_EQ(json::parse(same.out)["new_findings"], 0);
  EXPECT_FALSE(fs::exists(project.path() / "called"));
  EXPECT_EQ(project.nightly(20.0).exit_code, 1) << "it got worse";
}

TEST(NightlyMetrics, AreNotKnownAnyMoreAfterAnEmptyText) {
  const Project project;
  ASSERT_EQ(project.regress().exit_code, 1);
  for (const std::string text : {"bigger input", ""}) {
    const Outcome known = mapproof({"history", project.store(), "--known", "6.1", text});
    EXPECT_EQ(known.exit_code, 0) << known.error;
    const json history = json::parse(mapproof({"history", project.store(), "--json"}).out);
    EXPECT_EQ(history["notes"].empty(), text.empty()) << history["notes"];
  }
}

TEST(NightlyMetrics, AreAcceptedByTheFileOfThePage) {
  const Project project;
  ASSERT_EQ(project.regress().exit_code, 1);
  write_file(project.path() / "d.json",
             R"({"schema": {"name": "mapproof.decisions", "version": 1}, "decisions": [
                 {"target": "6", "decision": "accepted", "text": "more accurate"}]})");
  ASSERT_EQ(mapproof({"history", project.store(), "--from", project.path() / "d.json"}).exit_code,
            0);
  const Outcome next = project.nightly(13.0);
  EXPECT_EQ(next.exit_code, 0) << next.out;
  const json history = json::parse(mapproof({"history", project.store(), "--json"}).out);
  EXPECT_EQ(history["notes"][0]["text"], "more accurate");
  EXPECT_TRUE(history["nightly_runs"][5]["pinned"].get<bool>());
  const Outcome compared = mapproof({"history", project.store(), "--compare", "1", "6"});
  EXPECT_EQ(compared.exit_code, 0) << compared.error;
  EXPECT_TRUE(fs::exists(project.store() / "compare/0001-0006/speed.html"));
}

TEST(NightlyMetrics, AndOptionsThatCannotBeUsedAreRefusedInALineBeforeAnyWork) {
  const TemporaryFolder folder;
  const std::string file = folder.file("m.json", metrics(1.0));
  const auto refused = [&](std::vector<std::string> more, const std::string& part) {
    std::vector<std::string> words = {"nightly", "--store", folder / "h"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = mapproof(words);
    EXPECT_EQ(outcome.exit_code, 2) << part;
    EXPECT_NE(outcome.error.find(part), std::string::npos) << outcome.error;
    EXPECT_FALSE(fs::exists(folder / "h/history.sqlite")) << part;
  };
  refused({}, "nothing to run");
  refused({"--metrics", file}, "--better");
  refused({"--metrics", file, "--better", "lower", "--commit", "HEAD; rm"}, "--commit");
  refused({"--metrics", file, "--better", "lower", "--repository-url", "javascript:alert(1)"},
          "--repository-url");
  refused({"--metrics", file, "--better", "lower", "--repository-url", "https://a:b@c"},
          "--repository-url");
  refused({"--metrics", file, "--metrics", file, "--better", "lower"}, "given twice");
}

}  // namespace
}  // namespace mapproof::test
