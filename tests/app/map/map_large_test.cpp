// Maps of many landmarks: `mapproof map --method landmark-isomap`.
#include <cmath>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "core/base/random.hpp"
#include "core/records/maps/map_json.hpp"
#include "tests/support/program.hpp"
#include "tests/support/samples/drawn_points.hpp"

namespace mapproof::test {
namespace {

/// Landmarks on a square grid, and a robot that wanders among them and sees those within a radius.
struct Field {
  int side = 12;
  int steps = 3000;
  double radius = 2.5;

  Eigen::RowVector2d landmark(int i) const {
    return {static_cast<double>(i / side), static_cast<double>(i % side)};
  }
  int landmarks() const { return side * side; }

  std::string seen() const {
    Random random(4);
    std::string csv = "step,landmark\n";
    for (int t = 0; t < steps; ++t) {
      const Eigen::RowVector2d robot = uniform_point(random, -1.0, side);
      for (int i = 0; i < landmarks(); ++i)
        if ((landmark(i) - robot).norm() <= radius) csv += fmt::format("{},p{}\n", t, i);
    }
    return csv;
  }
  std::string positions(const std::vector<int>& which) const {
    std::string csv = "name,x,y\n";
    for (const int i : which) csv += fmt::format("p{},{},{}\n", i, landmark(i)(0), landmark(i)(1));
    return csv;
  }
  std::vector<int> all() const {
    std::vector<int> which;
    for (int i = 0; i < landmarks(); ++i) which.push_back(i);
    return which;
  }
};

/// "step,landmark": each step shows three of so many landmarks, the next one those beside them.
std::string chain(int landmarks) {
  std::string csv = "step,landmark\n";
  for (int t = 0; t + 2 < landmarks; ++t)
    for (int i = t; i < t + 3; ++i) csv += fmt::format("{},p{}\n", t, i);
  return csv;
}

TEST(MapLarge, IsThatOfIsomapWithAllLandmarksAsReferences) {
  const TemporaryFolder folder;
  const Field field;
  const std::string seen = folder.file("seen.csv", field.seen());
  const std::string anchors = folder.file("anchors.csv", field.positions({0, 11, 132, 143, 66}));
  const std::string known = folder.file("known.csv", field.positions(field.all()));
  const auto map_by = [&](const std::vector<std::string>& how) {
    std::vector<std::string> command = {
        "map", seen, "--sensor", "visibility", "--anchors",    anchors,   "--ground-truth",
        known, "-K", "8",        "--out",      folder / "map", "--force", "--json"};
    command.insert(command.end(), how.begin(), how.end());
    const Outcome outcome = mapproof(command);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    return nlohmann::json::parse(outcome.out);
  };
  const nlohmann::json exact = map_by({"--method", "isomap"});
  const nlohmann::json all = map_by({"--method", "landmark-isomap", "--references", "144"});
  for (std::size_t i = 0; i < exact.at("landmarks").size(); ++i)
    for (const char* axis : {"x_m", "y_m"})
      EXPECT_NEAR(exact["landmarks"][i].at(axis).get<double>(),
                  all["landmarks"][i].at(axis).get<double>(), 1e-8);
  EXPECT_EQ(all.at("method"), "landmark-isomap");
  const nlohmann::json few = map_by({"--method", "landmark-isomap", "--references", "20"});
  const double of_exact = exact.at("score").at("mpe_m"), of_few = few.at("score").at("mpe_m");
  EXPECT_LT(of_few, 2.0 * of_exact + 0.05);
  EXPECT_NE(read_file(folder / "map" / "report.html").find("20 of 144"), std::string::npos);
}

TEST(MapLarge, NeedsNoArrayOfLandmarksTimesSteps) {
  const TemporaryFolder folder;
  // 20,000 x 20,000 entries: twice what an array may have.
  const std::string seen = folder.file("seen.csv", chain(20'000));
  const Outcome outcome =
      mapproof({"map", seen, "--sensor", "visibility", "--method", "landmark-isomap", "-K", "2",
                "--references", "10", "--out", folder / "map"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const MapRecord map = parse_map(read_file(folder / "map" / "map.json"), "map.json");
  ASSERT_EQ(map.names.size(), 20'000U);
  // The landmarks of a chain come one after the other along the first axis.
  const Eigen::VectorXd along = map.estimate.col(0);
  const double way = along(19'999) > along(0) ? 1.0 : -1.0;
  for (Eigen::Index i = 100; i < 20'000; i += 100)
    EXPECT_GT(way * (along(i) - along(i - 100)), 0.0);

  const Outcome other = mapproof(
      {"map", seen, "--sensor", "visibility", "--method", "isomap", "--out", folder / "other"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.error.find("--method landmark-isomap"), std::string::npos) << other.error;
}

TEST(MapLarge, IsRefusedWhereMemoryIsTooLittle) {
  const TemporaryFolder folder;
  const std::string seen = folder.file("seen.csv", chain(8'000));
  const auto within = [&](const char* method) {
    return mapproof({"map", seen, "--sensor", "visibility", "--method", method, "-K", "2", "--out",
                     folder / method},
                    {.address_bytes = std::size_t{2} << 30});
  };
  const Outcome whole = within("isomap");
  EXPECT_EQ(whole.exit_code, 2);
  EXPECT_NE(whole.error.find("ISOMAP of 8000 landmarks needs 3.1 GB of memory"), std::string::npos)
      << whole.error;
  EXPECT_NE(whole.error.find("use --method landmark-isomap"), std::string::npos) << whole.error;
  EXPECT_FALSE(std::filesystem::exists(folder / "isomap"));
  const Outcome large = within("landmark-isomap");
  EXPECT_EQ(large.exit_code, 0) << large.error;
}

TEST(MapLarge, HasReferencesForItsMethodAlone) {
  const TemporaryFolder folder;
  const std::string seen = folder.file("seen.csv", chain(50));
  const Outcome outcome = mapproof({"map", seen, "--sensor", "visibility", "--method", "isomap",
                                    "--references", "10", "--out", folder / "map"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.error.find("only landmark-isomap and landmark-mvu have reference"), std::string::npos)
      << outcome.error;
}

}  // namespace
}  // namespace mapproof::test
