#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>

#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

const std::string kSmall = std::string(MAPPROOF_TEST_DATA) + "/experiments/small.json";

/// What must repeat: everything but timings.jsonl and the report, tables and figures of seconds.
Contents lasting(const fs::path& folder) {
  auto files = contents(folder);
  std::erase_if(files, [](const auto& file) {
    return file.first == "timings.jsonl" || file.first == "report.html" ||
           file.first.starts_with("tables/") || file.first.starts_with("figures/cost-");
  });
  return files;
}

void expect_lasting_same(const fs::path& a, const fs::path& b) {
  expect_same(lasting(a), lasting(b));
}

TEST(Repeatability, TheSameBytesForOneJobAndTwoAndTwiceInARow) {
  const TemporaryFolder folder;
  const auto reproduce = [&](const std::string& name, const std::string& jobs) {
    EXPECT_EQ(mapproof({"reproduce", "yairi2007", "--profile", "quick", "--out", folder / name,
                        "--jobs", jobs})
                  .exit_code,
              0);
  };
  const auto vary = [&](const std::string& name, const std::string& jobs) {
    EXPECT_EQ(mapproof({"run", kSmall, "--out", folder / name, "--jobs", jobs}).exit_code, 0);
  };
  vary("varied-one", "1");
  vary("varied-two", "2");
  expect_lasting_same(folder / "varied-one", folder / "varied-two");
  reproduce("one", "1");
  reproduce("two", "2");
  reproduce("again", "2");
  ASSERT_GT(lasting(folder / "one").size(), 20U);
  expect_lasting_same(folder / "one", folder / "two");
  expect_lasting_same(folder / "two", folder / "again");
}

TEST(Repeatability, AnotherSeedGivesOtherRecords) {
  const TemporaryFolder folder;
  mapproof({"run", kSmall, "--out", folder / "a", "--seed", "1"});
  mapproof({"run", kSmall, "--out", folder / "b", "--seed", "2"});
  EXPECT_NE(lasting(folder / "a"), lasting(folder / "b"));
}

TEST(Repeatability, AKilledStudyResumesAndEndsInTheSameBytes) {
  const TemporaryFolder folder;
  // With variations, which the quick profile of the paper has none of.
  const std::vector<std::string> job = {"run", kSmall, "--layouts", "60", "--jobs", "2", "--out"};
  const auto with_out = [&](const std::string& name) {
    std::vector<std::string> arguments = job;
    arguments.push_back(folder / name);
    return arguments;
  };
  ASSERT_EQ(mapproof(with_out("whole")).exit_code, 0);

  int killed = 0;
  for (int attempt = 0; attempt < 8; ++attempt) {
    const pid_t child = start_mapproof(with_out("torn"));
    std::this_thread::sleep_for(std::chrono::milliseconds(60 + 137 * attempt));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (WIFSIGNALED(status)) ++killed;
  }
  EXPECT_GE(killed, 2);  // else the machine was too fast for the test to mean anything
  const Outcome resumed = mapproof(with_out("torn"));
  ASSERT_EQ(resumed.exit_code, 0) << resumed.error;
  expect_lasting_same(folder / "whole", folder / "torn");
}

TEST(Repeatability, FinishedRunsAreReusedAndADamagedOneIsMadeAgain) {
  const TemporaryFolder folder;
  const std::vector<std::string> job = {"run", kSmall, "--out", folder / "study"};
  ASSERT_EQ(mapproof(job).exit_code, 0);
  const auto before = lasting(folder / "study");
  fs::resize_file(folder / "study" / "runs" / "layout-1-pose-1.json", 100);
  const Outcome again = mapproof(job);
  EXPECT_EQ(again.exit_code, 0) << again.error;
  EXPECT_EQ(lasting(folder / "study"), before);
}

TEST(Repeatability, RenderAndReportNeedNoSolverAndDrawTheSame) {
  const TemporaryFolder folder;
  ASSERT_EQ(mapproof({"reproduce", "yairi2007", "--profile", "quick", "--out", folder / "study"})
                .exit_code,
            0);
  const auto before = lasting(folder / "study");
  fs::remove_all(folder / "study" / "figures");
  fs::remove_all(folder / "study" / "tables");
  EXPECT_EQ(mapproof({"render", folder / "study"}).exit_code, 0);
  EXPECT_EQ(lasting(folder / "study"), before);
  fs::remove_all(folder / "study" / "figures");
  fs::remove(folder / "study" / "report.html");
  EXPECT_EQ(mapproof({"report", folder / "study"}).exit_code, 0);
  EXPECT_EQ(lasting(folder / "study"), before);
  EXPECT_TRUE(fs::exists(folder / "study" / "report.html"));
}

TEST(Repeatability, TheProgramRunsFromAnyFolder) {
  const TemporaryFolder folder;
  const fs::path old = fs::current_path();
  fs::current_path(folder.path());
  const Outcome outcome =
      mapproof({"reproduce", "yairi2007", "--profile", "quick", "--out", "here"});
  fs::current_path(old);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_TRUE(fs::exists(folder / "here" / "report.html"));
}

TEST(Repeatability, AFolderOfAnotherExperimentIsRefusedAndKept) {
  const TemporaryFolder folder;
  ASSERT_EQ(mapproof({"run", kSmall, "--out", folder / "study"}).exit_code, 0);
  const auto before = contents(folder / "study");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"run", kSmall, "--out", folder / "study", "--seed", "99"},
        {"reproduce", "yairi2007", "--out", folder / "study"},
        {"map", std::string(MAPPROOF_TEST_DATA) + "/mrclam", "--out", folder / "study"}}) {
    const Outcome outcome = mapproof(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.error.find("study"), std::string::npos) << outcome.error;
    EXPECT_EQ(contents(folder / "study"), before);
  }
}

}  // namespace
}  // namespace mapproof::test
