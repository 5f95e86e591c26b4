#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "core/base/random.hpp"
#include "tests/support/packing.hpp"
#include "tests/support/program.hpp"
#include "tests/support/samples/detections_csv.hpp"
#include "tests/support/samples/scans.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof::test {
namespace {

using nlohmann::json;

/// Scans without error at landmarks in a hall of 6 x 6 m, as people write them down.
struct Hall {
  Points landmarks = 6.0 * scattered(10, 5);
  DetectionLog log = scans_at(landmarks, 300, 4, 5);

  std::string csv(double unit = 1.0) const { return detections_csv(log, unit); }
  std::string positions(Eigen::Index count) const {
    std::string text = "name,x,y\n";
    for (Eigen::Index i = 0; i < count; ++i)
      text += fmt::format("{},{},{}\n", log.names[static_cast<std::size_t>(i)], landmarks(i, 0),
                          landmarks(i, 1));
    return text;
  }
};

/// The landmarks' positions in the order of `names`.
Points locations(const json& result, const std::vector<std::string>& names, const char* x,
                 const char* y) {
  Points points(std::ssize(names), 2);
  for (const json& row : result.at("landmarks")) {
    const auto name = std::ranges::find(names, row.at("name").get<std::string>());
    points.row(name - names.begin()) << row.at(x).get<double>(), row.at(y).get<double>();
  }
  return points;
}

TEST(MapOfDetections, WithoutAnchorsIsInMetres) {
  const TemporaryFolder folder;
  const Hall hall;
  const std::string file = folder.file("seen.csv", hall.csv());
  const Outcome run = mapproof({"map", file, "--out", folder / "map", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.error;
  const json result = json::parse(run.out);
  EXPECT_EQ(result.at("method"), "pairs");
  EXPECT_EQ(result.at("sensor"), "range-bearing");
  EXPECT_LT(procrustes_gap(hall.landmarks, locations(result, hall.log.names, "x_m", "y_m")), 1e-8);
  const std::string page = read_file(folder / "map/report.html");
  EXPECT_NE(page.find("SMACOF of measured pairs"), std::string::npos);
  const json file_of_map = json::parse(read_file(folder / "map/map.json"));
  EXPECT_EQ(file_of_map.at("method"), "pairs");
  EXPECT_EQ(file_of_map.at("sensor"), "range-bearing");
}

TEST(MapOfDetections, HasEllipsesOfTheSizeOfItsErrors) {
  const TemporaryFolder folder;
  Hall hall;
  Random random(3);
  for (Detection& seen : hall.log.detections) seen.range_m *= 1.0 + 0.05 * random.normal();
  const std::string file = folder.file("seen.csv", hall.csv());
  const std::string anchors = folder.file("anchors.csv", hall.positions(4));
  for (const char* fit : {"least-squares", "rigid"}) {
    const Outcome run = mapproof({"map", file, "--anchors", anchors, "--fit", fit, "--ellipses",
                                  "40", "--out", folder / fit, "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const json result = json::parse(run.out);
    const Points off = locations(result, hall.log.names, "x_m", "y_m") - hall.landmarks;
    const double error = off.bottomRows(6).rowwise().norm().mean();
    double axis = 0.0;
    for (const json& landmark : result.at("landmarks"))
      axis += landmark.at("ellipse").at("a_m").get<double>() / 10.0;
    EXPECT_GT(axis, 0.4 * error) << fit;
    EXPECT_LT(axis, 10.0 * error) << fit;
  }
}

TEST(MapOfDetections, GzippedInDegreesIsTheSame) {
  const TemporaryFolder folder;
  const Hall hall;
  const std::string file = folder.file("seen.csv.gz", gzipped(hall.csv(180.0 / std::numbers::pi)));
  const Outcome run = mapproof(
      {"map", file, "--sensor", "range-bearing", "--degrees", "--out", folder / "map", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.error;
  EXPECT_LT(
      procrustes_gap(hall.landmarks, locations(json::parse(run.out), hall.log.names, "x_m", "y_m")),
      1e-8);
}

TEST(MapOfDetections, IsFittedToAnchorsAffinelyOrRigidly) {
  const TemporaryFolder folder;
  const Hall hall;
  const std::string file = folder.file("seen.csv", hall.csv());
  const std::string anchors = folder.file("anchors.csv", hall.positions(4));
  const std::string ground_truth = folder.file("groundtruth.csv", hall.positions(10));
  for (const char* fit : {"least-distances", "rigid"}) {
    const Outcome run = mapproof({"map", file, "--anchors", anchors, "--truth", ground_truth,
                                  "--fit", fit, "--out", folder / fit, "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const json result = json::parse(run.out);
    EXPECT_LT(result.at("score").at("mpe_m").get<double>(), 1e-8) << fit;
    EXPECT_LT(
        (locations(result, hall.log.names, "x_m", "y_m") - hall.landmarks).cwiseAbs().maxCoeff(),
        1e-8);
  }
}

TEST(MapOfDetections, OneKindOfThemCanBeMappedAlone) {
  const TemporaryFolder folder;
  const Hall hall;
  const std::string file = folder.file("seen.csv", hall.csv());
  for (const char* kind : {"visibility", "bearing", "range"}) {
    const Outcome run = mapproof({"map", file, "--sensor", kind, "--out", folder / kind, "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    EXPECT_EQ(json::parse(run.out).at("sensor"), kind);
  }
}

TEST(MapOfDetections, WhatDoesNotFitTogetherIsSaid) {
  const TemporaryFolder folder;
  const Hall hall;
  const std::string file = folder.file("seen.csv", hall.csv());
  const auto error = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"map", file, "--out", folder / "map"});
    const Outcome run = mapproof(more);
    EXPECT_EQ(run.exit_code, 2);
    return run.error;
  };
  EXPECT_NE(error({"--method", "isomap"}).find("range and bearing together are mapped by pairs"),
            std::string::npos);
  EXPECT_NE(error({"--method", "pairs", "--sensor", "bearing"}).find("--sensor range-bearing"),
            std::string::npos);
  EXPECT_NE(error({"-K", "5"}).find("has no parameter"), std::string::npos);
  EXPECT_NE(error({"--sensor", "range", "--fit", "rigid"}).find("--fit rigid"), std::string::npos);
}

TEST(MapOfDetections, ALongTableBeyondAllMemoryGivesTheMapOfItsPart) {
  // The values of 30 landmarks at 200,000 steps, some 80 MB: read as a stream.
  const TemporaryFolder folder;
  const Points landmarks = 6.0 * scattered(30, 8);
  const DetectionLog log = scans_at(landmarks, 2000, 5, 8);
  std::string text = "step,landmark,value\n";
  for (int copy = 0; copy < 300; ++copy)
    for (const Detection& seen : log.detections)
      text += fmt::format("{},{},{:.17g}\n", copy * 2000 + seen.step,
                          log.names[static_cast<std::size_t>(seen.landmark)], seen.bearing_rad);
  ASSERT_GT(text.size(), 64'000'000U);
  const std::string large = folder.file("large.csv", text);
  const std::string small = folder.file("small.csv", text.substr(0, text.find("\n2000,") + 1));
  Points maps[2];
  for (const std::string& file : {small, large}) {
    const Outcome run = mapproof({"map", file, "--sensor", "bearing", "--method", "smacof", "--out",
                                  file + ".map", "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    maps[file == large ? 1 : 0] = locations(json::parse(run.out), log.names, "x", "y");
  }
  // Three hundred times the same scans: distances that many times longer, squared.
  EXPECT_LT(procrustes_gap(std::sqrt(300.0) * maps[0], maps[1]), 1e-5 * maps[1].norm());
}

}  // namespace
}  // namespace mapproof::test
