#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "tests/app/range_logs.hpp"
#include "tests/support/plaza.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// What must repeat: everything but seconds and what shows them.
Contents lasting(const fs::path& folder) {
  auto files = contents(folder);
  std::erase_if(files, [](const auto& file) {
    const std::string& name = file.first;
    return name.find("timings.jsonl") != std::string::npos ||
           name.find("report.html") != std::string::npos ||
           name.find("tables/") != std::string::npos ||
           name.find("figures/factorization-cost") != std::string::npos ||
           name.find("figures/cost-") != std::string::npos;
  });
  return files;
}

void expect_lasting_same(const fs::path& a, const fs::path& b) {
  expect_same(lasting(a), lasting(b));
}

std::vector<std::string> quick(const fs::path& out, const std::string& jobs) {
  return {"reproduce", "boots2013", "--profile", "quick", "--jobs", jobs, "--out", out};
}

TEST(ReproduceBoots2013, WithoutDataRunsTheSimulationAndSaysWhatIsMissing) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments = quick(folder / "out", "2");
  arguments.push_back("--json");
  const Outcome outcome = mapproof(arguments);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const json result = json::parse(outcome.out);
  EXPECT_EQ(result.at("missing").size(), 2U);
  EXPECT_NE(outcome.error.find("Plaza 1 is missing"), std::string::npos) << outcome.error;
  EXPECT_NE(read_file(folder / "out/report.html").find("--plaza"), std::string::npos);
  EXPECT_EQ(mapproof({"validate", folder / "out"}).exit_code, 0);
}

TEST(ReproduceBoots2013, TheSameBytesForOneJobAndTwo) {
  const TemporaryFolder folder;
  ASSERT_EQ(mapproof(quick(folder / "one", "1")).exit_code, 0);
  ASSERT_EQ(mapproof(quick(folder / "two", "2")).exit_code, 0);
  ASSERT_GT(lasting(folder / "one").size(), 8U);
  expect_lasting_same(folder / "one", folder / "two");
}

TEST(ReproduceBoots2013, AKilledStudyResumesAndEndsInTheSameBytes) {
  const TemporaryFolder folder;
  ASSERT_EQ(mapproof(quick(folder / "whole", "2")).exit_code, 0);
  int killed = 0;
  for (int attempt = 0; attempt < 6; ++attempt) {
    const pid_t child = start_mapproof(quick(folder / "torn", "2"));
    std::this_thread::sleep_for(std::chrono::milliseconds(30 + 60 * attempt));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (WIFSIGNALED(status)) ++killed;
  }
  EXPECT_GE(killed, 2);  // else the machine was too fast for the test to mean anything
  const Outcome resumed = mapproof(quick(folder / "torn", "1"));
  ASSERT_EQ(resumed.exit_code, 0) << resumed.error;
  expect_lasting_same(folder / "whole", folder / "torn");
}

TEST(ReproduceBoots2013, ReportAndRenderNeedNoSolver) {
  const TemporaryFolder folder;
  ASSERT_EQ(mapproof(quick(folder / "study", "2")).exit_code, 0);
  const auto before = lasting(folder / "study");
  fs::remove_all(folder / "study" / "figures");
  EXPECT_EQ(mapproof({"render", folder / "study"}).exit_code, 0);
  EXPECT_EQ(lasting(folder / "study"), before);
  fs::remove_all(folder / "study" / "figures");
  fs::remove(folder / "study" / "report.html");
  EXPECT_EQ(mapproof({"report", folder / "study"}).exit_code, 0);
  EXPECT_EQ(lasting(folder / "study"), before);
}

TEST(ReproduceBoots2013, WrongUseIsTwoAndOneLine) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "empty");
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--plaza", folder / "empty"},
        {"--plaza", folder / "not-there"},
        {"--layouts", "3"}}) {
    std::vector<std::string> arguments = quick(folder / "out", "1");
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = mapproof(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << more[0] << outcome.error;
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
}

TEST(ReproduceAll, PutsBothPapersIntoOneReport) {
  const TemporaryFolder folder;
  const Outcome outcome = mapproof({"reproduce", "all", "--profile", "quick", "--poses", "1",
                                    "--layouts", "1", "--out", folder / "out"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  for (const char* file : {"yairi2007/study.json", "boots2013/study.json", "report.html"})
    EXPECT_TRUE(fs::exists(folder / "out" / file)) << file;
  EXPECT_EQ(mapproof({"validate", folder / "out"}).exit_code, 0);
  const std::string report = read_file(folder / "out/report.html");
  EXPECT_EQ(mapproof({"report", folder / "out"}).exit_code, 0);
  EXPECT_EQ(read_file(folder / "out/report.html"), report);
  // A folder that holds anything else is left alone.
  fs::create_directory(folder / "mine");
  write_file(folder / "mine/letter.txt", "Dear Sir");
  EXPECT_EQ(
      mapproof({"reproduce", "all", "--profile", "quick", "--out", folder / "mine"}).exit_code, 2);
}

TEST(ReproduceBoots2013, RunsOnThePlazaDataAndMeetsTheBounds) {
  const auto plaza = plaza_folder();
  if (!plaza) GTEST_SKIP() << kNoPlaza;
  const TemporaryFolder folder;
  std::vector<std::string> arguments = quick(folder / "out", "2");
  arguments.insert(arguments.end(), {"--plaza", plaza->string(), "--json"});
  const Outcome outcome = mapproof(arguments);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const json result = json::parse(outcome.out);
  EXPECT_TRUE(result.at("missing").empty());
  const auto mean_m = [&](const std::string& run, const std::string& method) {
    for (const json& item : result.at("results"))
      if (item.at("run") == run && item.at("method") == method)
        return item.at("errors").at(0).at("path_mean_m").get<double>();
    return HUGE_VAL;
  };
  EXPECT_NEAR(mean_m("plaza-1", "dead-reckoning"), 15.92, 0.01);
  EXPECT_LE(mean_m("plaza-1", "spectral"), 0.70);
  EXPECT_LE(mean_m("plaza-2", "spectral"), 0.30);
  EXPECT_LE(mean_m("plaza-1", "refined"), 0.20);
  EXPECT_LE(mean_m("plaza-2", "refined"), 0.19);
}

}  // namespace
}  // namespace mapproof::test
