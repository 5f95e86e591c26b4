#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/child_process.hpp"
#include "core/base/files/files.hpp"
#include "core/base/random.hpp"
#include "core/model/points.hpp"
#include "tests/app/streamed_input.hpp"
#include "tests/support/packing.hpp"
#include "tests/support/samples/drawn_points.hpp"

namespace mapproof::test {
namespace {

using nlohmann::json;

/// Seven landmarks in 20 m x 20 m, and ranges to all of them without noise.
struct RangeTable {
  Points landmarks_m;
  std::string rows;  ///< t,landmark,range of every step.

  explicit RangeTable(int steps = 60) : landmarks_m(7, 2) {
    Random random(11);
    for (double& coordinate : landmarks_m.reshaped()) coordinate = random.uniform(0.0, 20.0);
    for (int step = 0; step < steps; ++step) {
      const Eigen::RowVector2d robot = uniform_point(random, 0.0, 20.0);
      for (Eigen::Index n = 0; n < 7; ++n)
        rows += fmt::format("{},b{},{:.17g}\n", 0.5 * step, n, (landmarks_m.row(n) - robot).norm());
    }
  }

  std::string positions(Eigen::Index first, Eigen::Index count) const {
    std::string csv = "name,x,y\n";
    for (Eigen::Index n = first; n < first + count; ++n)
      csv += fmt::format("b{},{:.17g},{:.17g}\n", n, landmarks_m(n, 0), landmarks_m(n, 1));
    return csv;
  }
};

TEST(SlamIncremental, MapsLandmarksExactlyWhereRangesAreExact) {
  const TemporaryFolder folder;
  const RangeTable table;
  const std::string ground_truth = folder.file("groundtruth.csv", table.positions(0, 7));
  for (const std::string& bytes : {"t,beacon,range\n" + table.rows, gzipped(table.rows)}) {
    const Outcome outcome =
        followed("slam", folder, bytes,
                 {"--ground-truth", ground_truth, "--every", "20", "--out", folder / "out"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
    const json result = json::parse(outcome.out);
    EXPECT_EQ(result.at("method"), "spectral");
    EXPECT_EQ(result.at("steps"), 60);
    EXPECT_LT(result.at("score").at("mpe_m").get<double>(), 1e-4);
  }
  EXPECT_EQ(mapproof({"validate", folder / "out/map.json"}).exit_code, 0);
}

TEST(SlamIncremental, PutsTheMapIntoTheFrameOfKnownLandmarks) {
  const TemporaryFolder folder;
  const RangeTable table;
  for (const Eigen::Index count : {3, 4}) {
    const std::string known = folder.file("known.csv", table.positions(0, count));
    const Outcome outcome =
        followed("slam", folder, table.rows, {"--anchors", known, "--out", folder / "out"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
    const json last = json::parse(outcome.out).at("landmarks").back();
    EXPECT_NEAR(last.at("x_m").get<double>(), table.landmarks_m(6, 0), 1e-3) << count;
    EXPECT_NEAR(last.at("y_m").get<double>(), table.landmarks_m(6, 1), 1e-3) << count;
    std::filesystem::remove_all(folder / "out");
  }
}

TEST(SlamIncremental, SaysWhatItLeavesOut) {
  const TemporaryFolder folder;
  const std::string late = "100,b0,3\n100,b1,4\n101,b0,3\n101,new,2\n";
  const Outcome outcome =
      followed("slam", folder, RangeTable().rows + late, {"--out", folder / "out"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(json::parse(outcome.out).at("steps"), 60);
  EXPECT_NE(outcome.error.find("2 steps without a range to every landmark: left out"),
            std::string::npos)
      << outcome.error;
  EXPECT_NE(outcome.error.find("the first step has no range to them: new"), std::string::npos);
}

TEST(SlamIncremental, OfTooLittleIsNoMap) {
  const TemporaryFolder folder;
  const Outcome outcome = followed("slam", folder, RangeTable(3).rows, {"--out", folder / "out"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.error;
  EXPECT_NE(outcome.error.find("too_few_observations"), std::string::npos) << outcome.error;
  const std::string last = last_line(outcome.error);
  EXPECT_TRUE(last.starts_with("mapproof: ")) << last;
  EXPECT_NE(last.find(": no map was made: 7 landmarks at 3 steps; "), std::string::npos) << last;
}

/// All long options that the help of `slam` lists.
std::set<std::string> options_of_slam(const std::string& help) {
  static const std::regex option(R"(\n {1,8}(?:-\w, )?(--[a-z-]+))");
  std::set<std::string> names;
  for (std::sregex_iterator match(help.begin(), help.end(), option), end; match != end; ++match)
    names.insert((*match)[1]);
  return names;
}

TEST(SlamIncremental, RefusesEveryOptionThatHasNoEffect) {
  const TemporaryFolder folder;
  const std::string table = folder.file("ranges.csv", RangeTable().rows);
  const std::string path = folder.file("path.csv", "t,x,y,heading\n0,0,0,0\n1,1,0,0\n");
  const std::map<std::string, std::vector<std::string>> refused = {
      {"--odometry", {table}},
      {"--ground-truth", {path}},
      {"--name", {"a"}},
      {"--range-sigma", {"3"}},
      {"--odometry-sigma", {"0.1"}},
      {"--heading-sigma", {"0.2"}},
      {"--odometry-scale-sigma", {".1"}},
      {"--repair", {}}};
  std::set<std::string> known = {"--anchors",     "--columns",   "--every",   "--help",
                                 "--incremental", "--jobs",      "--json",    "--out",
                                 "--quiet",       "--templates", "--verbose", "--provenance"};
  const std::string help = mapproof({"slam", "--help"}).out;
  const std::string stated = help.substr(help.find("Not with"));
  for (const auto& [option, value] : refused) {
    known.insert(option);
    std::vector<std::string> words = {"slam",  table,          "--incremental",
                                      "--out", folder / "out", option};
    words.insert(words.end(), value.begin(), value.end());
    const Outcome outcome = mapproof(words);
    EXPECT_EQ(outcome.exit_code, 2) << option;
    EXPECT_TRUE(outcome.error.starts_with("mapproof: " + option)) << outcome.error;
    EXPECT_NE(outcome.error.find(": not with --incremental: "), std::string::npos) << outcome.error;
    EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
    EXPECT_NE(stated.find(option), std::string::npos) << option;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  }
  for (const std::string& option : options_of_slam(help))
    EXPECT_TRUE(known.contains(option)) << option << " is neither refused nor known to have effect";
}

TEST(SlamIncremental, IsNeededForAnInterval) {
  const TemporaryFolder folder;
  const std::string table = folder.file("ranges.csv", RangeTable().rows);
  const Outcome outcome = mapproof({"slam", table, "--every", "5", "--out", folder / "out"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.error.find("add --incremental"), std::string::npos) << outcome.error;
}

}  // namespace
}  // namespace mapproof::test
