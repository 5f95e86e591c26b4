#include <string>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "tests/app/faults/fault_cases.hpp"
#include "tests/app/two_studies.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

/// Runs the program in a small address space; exit code 137: it did not end within a minute.
Outcome within(std::size_t kib, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"timeout", "-s", "KILL", "60", program()});
  return run_program(arguments, {.address_bytes = kib << 10});
}

TEST(LittleMemory, IsEnoughForWhatIsSmall) {
  constexpr std::size_t kLimit = 524'288;  // KiB, as a batch system may set it.
  EXPECT_EQ(within(180'000, {"--version"}).exit_code, 0);
  EXPECT_EQ(within(kLimit, {"--version"}).out, mapproof({"--version"}).out);

  const TemporaryFolder folder;
  const std::string observations = std::string(MAPPROOF_TEST_DATA) + "/observations/wide_plain.csv";
  const auto map = [&](const std::string& out) {
    return std::vector<std::string>{"map", observations, "--sensor", "visibility", "--out", out};
  };
  const Outcome plain = mapproof(map(folder / "plain"));
  const Outcome little = within(kLimit, map(folder / "little"));
  EXPECT_EQ(little.exit_code, plain.exit_code) << little.error;
  EXPECT_EQ(read_file(folder / "little/map.json"), read_file(folder / "plain/map.json"));

  const TwoStudies two;
  two.change_score();
  const std::vector<std::string> diff = {"diff", two.before, two.after, "--json"};
  EXPECT_EQ(within(kLimit, diff).exit_code, 1);
  EXPECT_EQ(within(kLimit, diff).out, mapproof(diff).out);
}

TEST(LittleMemory, StartsNoOtherBlasOfTheMachine) {
  const Environment other{{"LD_LIBRARY_PATH", MAPPROOF_OTHER_BLAS}};
  EXPECT_EQ(
      run_program({"sh", "-c", "exec cat \"$0/libblas.so.3\" > /dev/null", MAPPROOF_OTHER_BLAS})
          .exit_code,
      0);
  const Outcome outcome = mapproof({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.error, "");
}

}  // namespace
}  // namespace mapproof::test
