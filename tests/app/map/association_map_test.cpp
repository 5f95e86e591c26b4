#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "core/records/detections/detections.hpp"
#include "core/records/observations/observation_json.hpp"
#include "tests/core/association/noisy_scans.hpp"
#include "tests/core/association/real_scans.hpp"
#include "tests/support/program.hpp"
#include "tests/support/samples/detections_csv.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof::test {
namespace {

using nlohmann::json;

/// The positions of some landmarks as a file of anchors.
std::string corners_csv(const DetectionLog& log) {
  std::string text = "name,x,y\n";
  const Points locations = noisy_landmarks();
  for (const Eigen::Index k : {0, 2, 5, 9, 12, 14})
    text += fmt::format("{},{},{}\n", log.names[static_cast<std::size_t>(k)], locations(k, 0),
                        locations(k, 1));
  return text;
}

/// The result of `mapproof map ... --json`.
json mapped(const std::vector<std::string>& arguments) {
  std::vector<std::string> all = {"map"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  all.emplace_back("--json");
  const Outcome run = mapproof(all);
  EXPECT_EQ(run.exit_code, 0) << run.error;
  return run.exit_code == 0 ? json::parse(run.out) : json();
}

/// How far the map is from the true positions, rotated and scaled onto them.
double gap(const json& result, const DetectionLog& log) {
  Points map(noisy_landmarks().rows(), 2);
  for (const json& row : result.at("landmarks")) {
    const auto name = std::ranges::find(log.names, row.at("name").get<std::string>());
    map.row(name - log.names.begin()) << row.at("x_m").get<double>(), row.at("y_m").get<double>();
  }
  return procrustes_gap(noisy_landmarks(), map);
}

TEST(MapWithIds, NamesAndRepairsASwapInTheSecondHalf) {
  const TemporaryFolder folder;
  const DetectionLog clean = noisy_scans(600, 1);
  const DetectionLog wrong = swapped(clean, 3, 11, [](int step) { return step >= 300; });
  const std::string file = folder.file("wrong.csv", detections_csv(wrong));
  const json named = mapped({file, "--check-ids", "--out", folder / "named"});
  ASSERT_EQ(named.at("data_association").size(), 1U);
  const json& swap = named.at("data_association")[0];
  EXPECT_EQ(swap.at("what"), "swapped");
  const std::set<std::string> ids = {swap.at("first"), swap.at("second")};
  EXPECT_EQ(ids, (std::set{clean.names[3], clean.names[11]}));
  EXPECT_LT(swap.at("after_m").get<double>(), 0.75 * swap.at("before_m").get<double>());
  EXPECT_FALSE(swap.at("repaired").get<bool>());
  const std::string page = read_file(folder / "named/report.html");
  EXPECT_NE(page.find("swapped from step"), std::string::npos);

  const json repaired = mapped({file, "--repair-ids", "--out", folder / "repaired"});
  EXPECT_TRUE(repaired.at("data_association").at(0).at("repaired").get<bool>());
  const json best = mapped(
      {folder.file("clean.csv", detections_csv(clean)), "--check-ids", "--out", folder / "clean"});
  EXPECT_TRUE(best.at("data_association").empty());
  EXPECT_LT(gap(repaired, clean), 1.1 * gap(best, clean));
}

TEST(MapWithIds, TellsAnExchangeInAllDetectionsByTheAnchors) {
  const TemporaryFolder folder;
  const DetectionLog clean = noisy_scans(600, 2);
  const DetectionLog wrong = swapped(clean, 0, 8, [](int) { return true; });
  const std::string file = folder.file("wrong.csv", detections_csv(wrong));
  const std::string anchors = folder.file("anchors.csv", corners_csv(clean));
  const json alone = mapped({file, "--check-ids", "--out", folder / "alone"});
  EXPECT_TRUE(alone.at("data_association").empty());
  EXPECT_NE(alone.at("remarks").dump().find("would not show"), std::string::npos);
  const json named =
      mapped({file, "--repair-ids", "--anchors", anchors, "--out", folder / "named"});
  ASSERT_EQ(named.at("data_association").size(), 1U);
  EXPECT_EQ(named.at("data_association")[0].at("what"), "exchanged");
  EXPECT_EQ(named.at("data_association")[0].at("second"), clean.names[8]);
  EXPECT_LT(gap(named, clean), 1.1 * gap(mapped({folder.file("clean.csv", detections_csv(clean)),
                                                 "--anchors", anchors, "--out", folder / "clean"}),
                                         clean));
}

TEST(MapWithIds, AreCheckedInAFolderOfMrclam) {
  const char* sets = std::getenv("MAPPROOF_MRCLAM");
  if (sets == nullptr) GTEST_SKIP() << "MAPPROOF_MRCLAM does not name the folder of the sets";
  const std::string set = (std::filesystem::path(sets) / "dataset2").string();
  const TemporaryFolder folder;
  const DetectionLog log = real_scans("dataset2")->log;
  EXPECT_TRUE(
      mapped({set, "--method", "isomap", "--check-ids", "--out", folder / "a"})["data_association"]
          .empty());
  const DetectionLog wrong = swapped(log, 1, 7, [&](int step) { return step < log.steps / 2; });
  const std::string file = folder.file("wrong.json", detections_json(wrong));
  const json named = mapped({file, "--repair-ids", "--out", folder / "b"});
  ASSERT_EQ(named.at("data_association").size(), 1U);
  EXPECT_EQ(named.at("data_association")[0].at("first"), log.names[1]);
  EXPECT_EQ(named.at("data_association")[0].at("second"), log.names[7]);
}

TEST(MapWithIds, CannotBeCheckedOfOneKindOfValue) {
  const TemporaryFolder folder;
  const std::string file = folder.file("seen.csv", "A,1,0,1\nB,1,1,0\nC,0,1,1\nD,1,1,1\n");
  const Outcome run =
      mapproof({"map", file, "--sensor", "visibility", "--check-ids", "--out", folder / "map"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.error.find("range and bearing of the same scan"), std::string::npos);
}

}  // namespace
}  // namespace mapproof::test
