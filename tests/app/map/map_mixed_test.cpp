#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "core/base/random.hpp"
#include "core/simulate/sensors.hpp"
#include "tests/support/program.hpp"
#include "tests/support/samples/incomplete.hpp"

namespace mapproof::test {
namespace {

/// What three sensors saw in one room, a file each.
struct MixedSurvey {
  explicit MixedSurvey(const TemporaryFolder& folder) : room(walked_room(3, 600, 30)) {
    Random random(7);
    for (const Sensor sensor : {Sensor::kVisibility, Sensor::kBearing, Sensor::kRange}) {
      const ObservationHistory history = observe(room.world, room.path, {.sensor = sensor}, random);
      files.push_back(folder.file(std::string(name(sensor)) + ".csv", table(history, 0)));
    }
    ground_truth = folder.file("groundtruth.csv", positions({}));
    anchors = folder.file("anchors.csv", positions(room.anchors));
  }

  /// Wide CSV of the landmarks from the `first` one on.
  static std::string table(const ObservationHistory& history, Eigen::Index first) {
    std::string csv;
    for (Eigen::Index i = first; i < history.landmarks(); ++i) {
      csv += history.names[static_cast<std::size_t>(i)];
      for (const double value : history.values.row(i)) csv += fmt::format(",{}", value);
      csv += "\n";
    }
    return csv;
  }

  std::string positions(const std::vector<Eigen::Index>& rows) const {
    std::string csv = "name,x,y\n";
    const std::vector<std::string> names = landmark_names(room.world.landmarks_m.rows());
    for (Eigen::Index i = 0; i < room.world.landmarks_m.rows(); ++i)
      if (rows.empty() || std::ranges::find(rows, i) != rows.end())
        csv += fmt::format("{},{},{}\n", names[static_cast<std::size_t>(i)],
                           room.world.landmarks_m(i, 0), room.world.landmarks_m(i, 1));
    return csv;
  }

  WalkedRoom room;
  std::vector<std::string> files;
  std::string ground_truth, anchors;
};

TEST(MapMixed, JoinsThreeSensorsAndTellsWeightsAndWhichMapIsBetter) {
  const TemporaryFolder folder;
  const MixedSurvey survey(folder);
  const std::string out = folder / "joint";
  const Outcome outcome = mapproof(
      {"map", survey.files[0], "--sensor", "visibility", "--with", survey.files[1], "--with-sensor",
       "bearing", "--with", survey.files[2], "--with-sensor", "range", "--anchors", survey.anchors,
       "--truth", survey.ground_truth, "--out", out, "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto result = nlohmann::json::parse(outcome.out);
  const auto& mixed = result["mixed"];
  ASSERT_EQ(mixed["sensors"].size(), 3U);
  EXPECT_EQ(mixed["maps"].size(), 7U);
  double weights = 0.0;
  for (const auto& one : mixed["sensors"]) weights += one["weight"].get<double>();
  EXPECT_NEAR(weights, 1.0, 1e-6);
  for (std::size_t k = 1; k <= 3; ++k)
    EXPECT_LT(mixed["maps"][0]["mpe_m"], mixed["maps"][k]["mpe_m"]) << mixed["maps"][k];
  EXPECT_NE(outcome.error.find("By the ground truth it is"), std::string::npos) << outcome.error;
  const auto map = nlohmann::json::parse(read_file(out + "/map.json"));
  EXPECT_EQ(map["mixed"]["sensors"][1]["sensor"], "bearing");
  EXPECT_TRUE(std::filesystem::exists(out + "/figures/sensors.svg"));
  EXPECT_NE(read_file(out + "/report.html").find("Several sensors in one map"), std::string::npos);
  EXPECT_EQ(mapproof({"validate", out}).exit_code, 0);
}

TEST(MapMixed, PlacesLandmarksThatOneFileAloneHasAndSaysSo) {
  const TemporaryFolder folder;
  const MixedSurvey survey(folder);
  Random random(8);
  const std::string fewer = folder.file(
      "fewer.csv",
      MixedSurvey::table(
          observe(survey.room.world, survey.room.path, {.sensor = Sensor::kRange}, random), 2));
  const Outcome outcome =
      mapproof({"map", survey.files[1], "--sensor", "bearing", "--with", fewer, "--with-sensor",
                "range", "--truth", survey.ground_truth, "--out", folder / "out", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto result = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(result["landmarks"].size(), 30U);
  EXPECT_NE(result["remarks"].dump().find("2 landmarks not in all files (L1 and L2)"),
            std::string::npos)
      << result["remarks"];
  EXPECT_LT(result["score"]["mpe_all_fitted_m"], 0.1);
}

TEST(MapMixed, RefusesWhatDoesNotFitTogether) {
  const TemporaryFolder folder;
  const MixedSurvey survey(folder);
  const auto refused = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "map", survey.files[1], "--sensor", "bearing", "--with",
        "",    "--with-sensor", "range",    "--out",   folder / "out"};
    arguments[5] = more[0];
    arguments[7] = more[1];
    arguments.insert(arguments.end(), more.begin() + 2, more.end());
    const Outcome outcome = mapproof(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.error;
  };
  EXPECT_NE(refused({survey.files[1], "bearing"}).find("each sensor only once"), std::string::npos);
  const std::string other = folder.file("other.csv", "a,1,2,3\nb,2,3,4\nc,3,4,5\n");
  EXPECT_NE(refused({other, "range"}).find("shares 0 landmarks with"), std::string::npos);
  std::string nothing;
  for (const std::string& name : landmark_names(30)) nothing += name + ",,\n";
  EXPECT_NE(refused({folder.file("nothing.csv", nothing), "range"}).find("no observation of any"),
            std::string::npos);
  EXPECT_NE(refused({folder.file("empty.csv", ""), "range"}).find("empty.csv"), std::string::npos);
  EXPECT_NE(refused({survey.files[2], "range", "--method", "auto"}).find("--with: not with"),
            std::string::npos);
  EXPECT_NE(refused({survey.files[2], "range", "--with", survey.files[0]}).find("--with-sensor"),
            std::string::npos);
}

}  // namespace
}  // namespace mapproof::test
