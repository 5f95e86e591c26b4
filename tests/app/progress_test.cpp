// What a person sees at a terminal while a command works.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

/// What stands on a terminal after so many seconds of a command.
std::string seen_on_terminal(const std::string& seconds, const std::string& words) {
  return run_program({"timeout", "-s", "KILL", seconds, "script", "-qfc", program() + " " + words,
                      "/dev/null"})
      .out;
}

TEST(Progress, ReproduceShowsALineWithinASecond) {
  if (!std::filesystem::exists("/usr/bin/script")) GTEST_SKIP() << "script is not installed";
  const TemporaryFolder folder;
  for (const char* name : {"yairi2007", "missing"}) {
    const std::string seen = seen_on_terminal(
        "1.5", "reproduce " + std::string(name) + " --jobs 1 --out " + (folder / name).string());
    EXPECT_NE(seen.find("\033[K"), std::string::npos) << seen;
    EXPECT_NE(seen.find(" s"), std::string::npos) << seen;
  }
}

TEST(Progress, WithQuietThereIsNone) {
  if (!std::filesystem::exists("/usr/bin/script")) GTEST_SKIP() << "script is not installed";
  const TemporaryFolder folder;
  EXPECT_EQ(seen_on_terminal(
                "1.5", "reproduce missing --quiet --jobs 1 --out " + (folder / "missing").string())
                .find("\033[K"),
            std::string::npos);
}

}  // namespace
}  // namespace mapproof::test
