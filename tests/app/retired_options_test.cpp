#include "app/retired_options.hpp"

#include <gtest/gtest.h>

#include "tests/support/program.hpp"

namespace mapproof {
namespace {

TEST(RetiredOptions, AreRefusedInOneLineWithTheirNewName) {
  ASSERT_FALSE(retired_options().empty());
  for (const RetiredOption& option : retired_options())
    for (const std::string& word : {std::string(option.name), std::string(option.name) + "=x"}) {
      const test::Outcome outcome = test::mapproof({"map", "seen.csv", word});
      EXPECT_EQ(outcome.exit_code, 2);
      EXPECT_EQ(outcome.error, "mapproof: " + std::string(option.name) +
                                   ": this option is now called " + std::string(option.now) + "\n");
    }
}

TEST(RetiredOptions, HaveANewNameThatACommandTakes) {
  const std::string help =
      test::mapproof({"map", "--help"}).out + test::mapproof({"slam", "--help"}).out;
  for (const RetiredOption& option : retired_options()) {
    EXPECT_NE(help.find(std::string(option.now) + " "), std::string::npos) << option.now;
    EXPECT_EQ(help.find(std::string(option.name) + " "), std::string::npos) << option.name;
  }
}

TEST(RetiredOptions, GroundTruthHasItsShortName) {
  for (const char* command : {"map", "slam"})
    EXPECT_NE(test::mapproof({command, "--help"}).out.find("--ground-truth,--truth"),
              std::string::npos);
}

}  // namespace
}  // namespace mapproof
