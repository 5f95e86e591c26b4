#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kExampleFiles = fs::path(MAPPROOF_SOURCE_DIR) / "examples";

/// The commands of examples/README.md: its lines that are indented by four spaces.
std::vector<std::string> example_commands() {
  std::vector<std::string> commands;
  std::istringstream page(read_file(kExampleFiles / "README.md"));
  for (std::string line; std::getline(page, line);)
    if (line.starts_with("    ")) commands.push_back(line.substr(4));
  return commands;
}

TEST(Examples, EveryCommandOfTheirReadmeRuns) {
  const TemporaryFolder folder;
  fs::copy(kExampleFiles, folder / "examples", fs::copy_options::recursive);
  const std::string path = "PATH=" + fs::path(program()).parent_path().string() + ":/usr/bin:/bin";
  const std::vector<std::string> commands = example_commands();
  EXPECT_EQ(commands.size(), 11U);
  for (const std::string& command : commands) {
    const Outcome outcome =
        run_program({"env", "-C", folder / "examples", path, "sh", "-c", command});
    if (outcome.exit_code == 127) GTEST_SKIP() << "python3 is not installed";
    EXPECT_EQ(outcome.exit_code, 0) << command << '\n' << outcome.error;
  }
  for (const char* report : {"map", "pairs", "ranges", "detections", "slam", "study", "localisers"})
    EXPECT_TRUE(fs::exists(folder / "examples/out" / report / "report.html")) << report;
}

TEST(Examples, TheMapOfTheBearingsIsWithinATenthOfTheRoom) {
  const TemporaryFolder folder;
  const fs::path files = kExampleFiles / "hall";
  const Outcome outcome =
      mapproof({"map", files / "bearings.csv", "--sensor", "bearing", "--method", "smacof-knn",
                "-K", "7", "--anchors", files / "anchors.csv", "--ground-truth",
                files / "ground_truth.csv", "--out", folder / "map", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const json map = json::parse(read_file(folder / "map/map.json"));
  EXPECT_LT(map.at("score").at("mpe_m").get<double>(), 0.25);
  EXPECT_EQ(map.at("names").size(), 30U);
}

}  // namespace
}  // namespace mapproof::test
