#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "core/base/random.hpp"
#include "core/records/maps/map_json.hpp"
#include "core/records/tables/table_reader.hpp"
#include "tests/app/streamed_input.hpp"
#include "tests/core/association/noisy_scans.hpp"
#include "tests/support/packing.hpp"
#include "tests/support/program.hpp"
#include "tests/support/samples/scans.hpp"

namespace mapproof::test {
namespace {

using nlohmann::json;

json mapped(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "map");
  arguments.emplace_back("--json");
  const Outcome outcome = mapproof(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  return outcome.exit_code == 0 ? json::parse(outcome.out) : json();
}

void expect_same_landmarks(const json& incremental, const json& whole) {
  ASSERT_EQ(incremental.at("landmarks").size(), whole.at("landmarks").size());
  for (std::size_t i = 0; i < whole.at("landmarks").size(); ++i) {
    const json& here = incremental["landmarks"][i];
    const json& there = whole["landmarks"][i];
    EXPECT_EQ(here["name"], there["name"]);
    EXPECT_NEAR(here["x_m"].get<double>(), there["x_m"].get<double>(), 1e-6);
    EXPECT_NEAR(here["y_m"].get<double>(), there["y_m"].get<double>(), 1e-6);
  }
}

std::string detections_csv(const DetectionLog& log) {
  std::string text = "time,landmark,range,bearing\n";
  for (const Detection& seen : log.detections)
    text += fmt::format("{},{},{},{}\n", 0.1 * seen.step,
                        log.names[static_cast<std::size_t>(seen.landmark)], seen.range_m,
                        seen.bearing_rad);
  return text;
}

std::string bearings_csv(const DetectionLog& log) {
  std::string text = "step,landmark,value\n";
  for (const Detection& seen : log.detections)
    text += fmt::format("{},{},{}\n", seen.step, log.names[static_cast<std::size_t>(seen.landmark)],
                        seen.bearing_rad);
  return text;
}

std::string places_csv(const DetectionLog& log, const std::vector<Eigen::Index>& rows) {
  std::string text = "name,x,y\n";
  const Points locations = noisy_landmarks();
  for (const Eigen::Index k : rows)
    text += fmt::format("{},{},{}\n", log.names[static_cast<std::size_t>(k)], locations(k, 0),
                        locations(k, 1));
  return text;
}

TEST(IncrementalMapFile, ReadsWhatThePlainMapReads) {
  const TemporaryFolder folder;
  const std::string text =
      "step,landmark,value\n0,\"x;y\",1\n0,b,1\n1,b,1\n1,c,1\n2,x;y,1\n2,c,1\n2,d,1\n3,d,1\n3,b,"
      "1\n4,b,1";
  const Outcome outcome = followed(
      "map", folder, text, {"--sensor", "visibility", "--method", "lpca", "--out", folder / "a"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(json::parse(outcome.out)["landmarks"][0]["name"], "x;y");
  EXPECT_NE(outcome.error.find(kCutRemark), std::string::npos) << outcome.error;
  const json whole = mapped({folder.file("a.csv", text), "--sensor", "visibility", "--method",
                             "lpca", "--out", folder / "b"});
  EXPECT_NE(whole["remarks"].dump().find(kCutRemark), std::string::npos);
  EXPECT_EQ(whole["landmarks"].size(), 4U);
}

TEST(IncrementalMapFile, IsScoredByTheGroundTruthAsThePlainMapIs) {
  const TemporaryFolder folder;
  const DetectionLog log = noisy_scans(400, 2);
  const std::string text = bearings_csv(log);
  const std::string anchors = folder.file("anchors.csv", places_csv(log, {0, 2, 12, 14}));
  const std::string ground_truth =
      folder.file("groundtruth.csv", places_csv(log, {0, 1, 2, 5, 7, 9, 12, 14}));
  const std::vector<std::string> options = {"--sensor", "bearing",    "--method",
                                            "smacof",   "--anchors",  anchors,
                                            "--truth",  ground_truth, "--out"};
  auto with_out = [&](const std::string& out) {
    std::vector<std::string> all = options;
    all.push_back(out);
    return all;
  };
  const Outcome outcome = followed("map", folder, text, with_out(folder / "followed"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  std::vector<std::string> plain = with_out(folder / "whole");
  plain.insert(plain.begin(), folder.file("all.csv", text));
  const json whole = mapped(plain), last = json::parse(outcome.out);
  expect_same_landmarks(last, whole);
  for (const char* score : {"mpe_m", "moe_percent", "mpe_all_fitted_m"})
    EXPECT_NEAR(last["score"][score].get<double>(), whole["score"][score].get<double>(), 1e-6);
  EXPECT_NE(last["remarks"].dump().find("The true position of 7 landmarks is not known."),
            std::string::npos);
}

TEST(IncrementalMapFile, OfRangeAndBearingIsThePlainMapAndNamesWhatMoved) {
  const TemporaryFolder folder;
  const DetectionLog log = scans_with_move(800, 7, {0.3, -0.4}, 400);
  const std::string text = detections_csv(log);
  const std::string anchors = folder.file("anchors.csv", places_csv(log, {0, 2, 12, 14}));
  const Outcome outcome =
      followed("map", folder, text,
               {"--sensor", "range-bearing", "--find-moved", "--every", "50", "--anchors", anchors,
                "--fit", "rigid", "--out", folder / "followed"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  // Noticed while there were still scans to come, with the time.
  const std::string noticed = fmt::format("scans: {} moved by 0.", log.names[7]);
  EXPECT_NE(outcome.error.find(noticed), std::string::npos) << outcome.error;
  EXPECT_NE(outcome.error.find(" s and "), std::string::npos) << outcome.error;
  const json last = json::parse(outcome.out);
  const json whole =
      mapped({folder.file("all.csv", text), "--sensor", "range-bearing", "--find-moved",
              "--anchors", anchors, "--fit", "rigid", "--out", folder / "whole"});
  ASSERT_EQ(last["data_association"].size(), 1U);
  EXPECT_EQ(last["data_association"], whole["data_association"]);
  EXPECT_EQ(last["landmarks"].size(), log.names.size() + 1);
  expect_same_landmarks(last, whole);
  EXPECT_NE(read_file(folder / "followed/report.html").find("range and bearing"),
            std::string::npos);
}

TEST(IncrementalMapFile, MayBeGzippedAndCutThere) {
  const TemporaryFolder folder;
  const DetectionLog log = noisy_scans(400, 3);
  const std::string packed = gzipped(detections_csv(log));
  const Outcome whole =
      followed("map", folder, packed, {"--sensor", "range-bearing", "--out", folder / "a"});
  ASSERT_EQ(whole.exit_code, 0) << whole.error;
  EXPECT_EQ(json::parse(whole.out)["steps"], 400);
  const Outcome part = followed("map", folder, packed.substr(0, packed.size() * 3 / 4),
                                {"--sensor", "range-bearing", "--out", folder / "b"});
  ASSERT_EQ(part.exit_code, 0) << part.error;
  EXPECT_LT(json::parse(part.out)["steps"], 400);
  EXPECT_NE(part.error.find("stops before its end"), std::string::npos);
}

TEST(IncrementalMapFile, SaysWhatCannotBeCombinedAndWhy) {
  const TemporaryFolder folder;
  const std::string file = folder.file("rows.csv", "0,a,1\n0,b,2\n");
  const std::string out = folder / "out";
  const auto error = [&](std::vector<std::string> more) {
    std::vector<std::string> all = {"map", file, "--incremental", "--out", out};
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = mapproof(all);
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.error;
  };
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--ellipses", "20"}, "--ellipses: not with --incremental"},
      {{"--method", "auto"}, "--method auto: not with --incremental"},
      {{"--missing", "ppca"}, "--missing: not with --incremental"},
      {{"--submaps", "8"}, "--submaps: not with --incremental"},
      {{"--steps", "8"}, "--steps: not with --incremental"},
      {{"--check-ids"}, "--check-ids: not with --incremental"},
      {{"--repair-ids"}, "--repair-ids: not with --incremental"},
      {{"--find-moved"},
       "--find-moved without range-bearing: not with --incremental: ranges or bearings"},
  };
  for (const auto& [options, expected] : cases) {
    std::vector<std::string> all = options;
    all.insert(all.end(), {"--sensor", "range"});
    EXPECT_NE(error(all).find(expected), std::string::npos) << error(all);
  }
  EXPECT_NE(error({}).find("range or range-bearing"), std::string::npos);
}

}  // namespace
}  // namespace mapproof::test
