// A few faults and kills of each command; fault_sweep_test tries them all.
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "tests/app/faults/fault_cases.hpp"

namespace mapproof::test {
namespace {

/// The short ones, and `report`.
std::vector<FaultCase> quick_cases() {
  std::vector<FaultCase> cases;
  for (const FaultCase& one : fault_cases())
    if (one.samples > 1000 || one.name == "report") cases.push_back(one);
  return cases;
}

class AFault : public ::testing::TestWithParam<FaultCase> {};

TEST_P(AFault, IsOneLineAndLeavesNoWrongFile) {
  for (const std::string& kind : kFaultKinds) expect_faults_reported(GetParam(), kind, 1);
}

INSTANTIATE_TEST_SUITE_P(OfEach, AFault, ::testing::ValuesIn(quick_cases()),
                         [](const auto& one) { return one.param.name; });

TEST(AFaultWhileADrawingIsRead, IsOneLine) {
  const FaultCase validate = {
      .name = "validate",
      .prepare =
          [](const std::filesystem::path& folder) {
            // Elements without content: the end of one is reported though its start failed.
            std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\">";
            for (int i = 0; i < 5000; ++i) text += "<circle r=\"1\"/>";
            write_file(folder / "drawing.svg", text + "</svg>\n");
          },
      .command =
          [](const std::string& folder) {
            return std::vector<std::string>{"validate", folder + "/drawing.svg"};
          }};
  expect_faults_reported(validate, "alloc", 1000);
}

class AKill : public ::testing::TestWithParam<FaultCase> {};

TEST_P(AKill, LeavesWholeFilesFromWhichTheNextRunGoesOn) {
  expect_kills_survived(GetParam(), "write", 2);
  expect_kills_survived(GetParam(), "rename", 1);
}

INSTANTIATE_TEST_SUITE_P(OfEach, AKill, ::testing::ValuesIn(kill_cases()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace mapproof::test
