#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

const std::string kSweep = std::string(MAPPROOF_TEST_DATA) + "/experiments/small_sweep.json";

/// All but seconds and the page that shows them.
Contents without_seconds(const fs::path& folder) {
  Contents files = contents(folder);
  std::erase_if(files, [](const auto& file) {
    return file.first == "timings.jsonl" || file.first == "report.html" ||
           file.first.find("/sessions--") != std::string::npos;
  });
  return files;
}

TEST(Sweep, HasCurvesHeatMapsTablesAndAValidFolder) {
  const TemporaryFolder folder;
  const Outcome made = mapproof({"run", kSweep, "--out", folder / "s", "--json"});
  ASSERT_EQ(made.exit_code, 0) << made.error;
  ASSERT_EQ(mapproof({"report", folder / "s"}).exit_code, 0);
  const std::string name = "small-sweep-bearing-";
  for (const std::string& file :
       {"figures/" + name + "anchors-mpe-m.svg",
        "figures/" + name + "reach-m-steps-grid-mpe-m-lpca.svg",
        "figures/" + name + "reach-m-steps-grid-moe-percent-smacof-knn-k5.pdf",
        "tables/" + name + "anchors-moe-percent.csv",
        "tables/" + name + "reach-m-steps-reach-m-0-2-mpe-m.csv", std::string("results.csv")})
    EXPECT_TRUE(fs::exists(folder / "s" / file)) << file;
  EXPECT_EQ(mapproof({"validate", folder / "s"}).exit_code, 0);
  const std::string table = read_file(folder / "s/results.csv");
  for (const char* column : {"at.anchors", "at.reach_m", "at.steps"})
    EXPECT_NE(table.substr(0, table.find('\n')).find(column), std::string::npos) << column;
  const auto result = nlohmann::json::parse(made.out).at("results").at(0);
  EXPECT_EQ(result.at("levels").at("anchors"), 3);
  EXPECT_TRUE(result.at("mpe_m").is_number());
}

TEST(Sweep, EndsInTheSameBytesForAnyJobsAndAfterAKill) {
  const TemporaryFolder folder;
  const auto job = [&](const std::string& name, const std::string& jobs) {
    return std::vector<std::string>{"run",    kSweep, "--layouts", "12",
                                    "--jobs", jobs,   "--out",     folder / name};
  };
  ASSERT_EQ(mapproof(job("one", "1")).exit_code, 0);
  for (int attempt = 0; attempt < 4; ++attempt) {
    const pid_t child = start_mapproof(job("two", "2"));
    std::this_thread::sleep_for(std::chrono::milliseconds(80 + 100 * attempt));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
  }
  ASSERT_EQ(mapproof(job("two", "2")).exit_code, 0);
  expect_same(without_seconds(folder / "one"), without_seconds(folder / "two"));
}

TEST(Sweep, IsComparedApprovedAndJudgedByNightlyRun) {
  const TemporaryFolder folder;
  ASSERT_EQ(mapproof({"run", kSweep, "--out", folder / "a"}).exit_code, 0);
  ASSERT_EQ(mapproof({"run", kSweep, "--out", folder / "b", "--seed", "4"}).exit_code, 0);
  for (const char* name : {"once", "again"}) {
    ASSERT_EQ(mapproof({"run", kSweep, "--out", folder / name}).exit_code, 0);
    ASSERT_EQ(mapproof({"report", folder / name}).exit_code, 0);
  }
  const Outcome same = mapproof({"diff", folder / "once", folder / "again"});
  EXPECT_EQ(same.exit_code, 0) << same.out << "seconds and dates alone differ";
  const Outcome differ = mapproof({"diff", folder / "a", folder / "b"});
  EXPECT_EQ(differ.exit_code, 1) << differ.error;
  EXPECT_EQ(mapproof({"approve", folder / "a", folder / "b", "--all"}).exit_code, 0);
  EXPECT_EQ(mapproof({"diff", folder / "a", folder / "b"}).exit_code, 0);
  for (int nightly_run = 0; nightly_run < 2; ++nightly_run) {
    const Outcome run = mapproof({"nightly", kSweep, "--store", folder / "history"});
    EXPECT_EQ(run.exit_code, 0) << run.out << run.error;
  }
}

TEST(Sweep, ThatCannotBeIsRefusedInOneLine) {
  const TemporaryFolder folder;
  std::string text = read_file(kSweep);
  const std::string from = "\"anchors\": [3, 4, 6]";
  text.replace(text.find(from), from.size(), "\"anchors\": [3, 14]");
  write_file(folder / "wrong.json", text);
  const Outcome outcome = mapproof({"run", folder / "wrong.json", "--out", folder / "s"});
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.error.find("14 anchors leave none of 14 landmarks"), std::string::npos)
      << outcome.error;
  EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
  EXPECT_FALSE(fs::exists(folder / "s"));
}

}  // namespace
}  // namespace mapproof::test
