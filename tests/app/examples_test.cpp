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

/// The commands of a page: its lines that are indented by four spaces and begin so.
std::vector<std::string> commands_of(const fs::path& file, const std::string& start = "") {
  std::vector<std::string> commands;
  std::istringstream page(read_file(file));
  for (std::string line; std::getline(page, line);)
    if (line.starts_with("    " + start)) commands.push_back(line.substr(4));
  return commands;
}

TEST(Examples, EveryCommandOfTheirReadmeRuns) {
  const TemporaryFolder folder;
  fs::copy(kExampleFiles, folder / "examples", fs::copy_options::recursive);
  const std::string path = "PATH=" + fs::path(program()).parent_path().string() + ":/usr/bin:/bin";
  const std::vector<std::string> commands = commands_of(kExampleFiles / "README.md");
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

TEST(Examples, EveryCommandOfTheReadmeThatNeedsNothingElseRuns) {
  const TemporaryFolder folder;
  const std::string path = "PATH=" + fs::path(program()).parent_path().string() + ":/usr/bin:/bin";
  std::size_t run = 0;
  for (const std::string& command :
       commands_of(fs::path(MAPPROOF_SOURCE_DIR) / "README.md", "mapproof ")) {
    // These need data that are not part of the program, or a study of some minutes.
    if (command.find("reproduce") != std::string::npos ||
        command.find("yairi2007") != std::string::npos)
      continue;
    const Outcome outcome = run_program({"env", "-C", folder.path(), path, "sh", "-c", command});
    EXPECT_EQ(outcome.exit_code, 0) << command << '\n' << outcome.error;
    ++run;
  }
  EXPECT_GE(run, 5U);
}

TEST(Examples, AreWrittenByTheProgramAsTheyAre) {
  const TemporaryFolder folder;
  ASSERT_EQ(mapproof({"example", folder / "all"}).exit_code, 0);
  for (const char* file :
       {"hall/bearings.csv", "drive/ranges.csv", "study/experiment.json", "plots/new/error.svg"})
    EXPECT_EQ(read_file(folder / "all" / file), read_file(kExampleFiles / file)) << file;
  // Again is fine; but a file of the user's is not replaced.
  EXPECT_EQ(mapproof({"example", "hall", "--out", folder / "all"}).exit_code, 0);
  write_file(folder / "all/hall/anchors.csv", "mine");
  EXPECT_EQ(mapproof({"example", "hall", "--out", folder / "all"}).exit_code, 2);
  EXPECT_EQ(read_file(folder / "all/hall/anchors.csv"), "mine");
}

TEST(Examples, AreMadeAgainByTheirScripts) {
  const TemporaryFolder folder;
  for (const char* name : {"hall", "drive", "plots"}) {
    fs::create_directory(folder / name);
    const Outcome made = run_program({"python3", kExampleFiles / name / "make.py", folder / name});
    if (made.exit_code == 127) GTEST_SKIP() << "python3 is not installed";
    ASSERT_EQ(made.exit_code, 0) << made.error;
    for (const auto& entry : fs::recursive_directory_iterator(folder / name)) {
      if (!entry.is_regular_file()) continue;
      EXPECT_EQ(read_file(entry.path()),
                read_file(kExampleFiles / fs::relative(entry.path(), folder.path())))
          << entry.path();
    }
  }
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
