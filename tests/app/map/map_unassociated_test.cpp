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

/// Bearings of 25 landmarks as long CSV, some of them with wrong landmark IDs.
struct LongSurvey {
  WalkedRoom room = walked_room(3, 500, 25);
  ObservationHistory history;
  std::vector<std::string> ground_truth =
      {};  ///< Of each measurement without an ID, in the order of the lines.

  LongSurvey() {
    Random random(7);
    history = observe(room.world, room.path, {.sensor = Sensor::kBearing}, random);
  }

  /// @param label  What the file calls landmark i at step t.
  template <typename Label>
  std::string csv(const Label& label) {
    std::string text = "step,landmark,value\n";
    for (Eigen::Index t = 0; t < history.steps(); ++t)
      for (Eigen::Index i = 0; i < history.landmarks(); ++i) {
        const std::string name = label(i, t);
        if (name == "?") ground_truth.push_back(history.names[static_cast<std::size_t>(i)]);
        text += fmt::format("{},{},{}\n", 10 * t, name, history.values(i, t));
      }
    return text;
  }

  std::string positions() const {
    std::string text = "name,x,y\n";
    for (Eigen::Index i = 0; i < history.landmarks(); ++i)
      text += fmt::format("{},{},{}\n", history.names[static_cast<std::size_t>(i)],
                          room.world.landmarks_m(i, 0), room.world.landmarks_m(i, 1));
    return text;
  }

  Outcome mapped(const TemporaryFolder& folder, const std::string& file,
                 const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"map",      folder.file("seen.csv", file),
                                          "--sensor", "bearing",
                                          "--truth",  folder.file("groundtruth.csv", positions()),
                                          "--method", "smacof-knn",
                                          "--out",    folder / "out",
                                          "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return mapproof(arguments);
  }
};

TEST(MapUnassociated, FindsTheLandmarksOfMeasurementsWithoutAnId) {
  const TemporaryFolder folder;
  LongSurvey survey;
  Random random(9);
  const std::string file = survey.csv([&](Eigen::Index i, Eigen::Index) {
    return random.uniform() < 0.1 ? "?" : survey.history.names[static_cast<std::size_t>(i)];
  });
  const Outcome outcome = survey.mapped(folder, file);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto result = nlohmann::json::parse(outcome.out);
  EXPECT_LT(result["score"]["mpe_all_fitted_m"], 0.15);
  EXPECT_NE(result["remarks"].dump().find("Data association estimated together with the map"),
            std::string::npos);
  // Each line of association.csv names the line of the file that it is about.
  std::istringstream lines(read_file(folder / "out" / "association.csv"));
  std::string line;
  std::getline(lines, line);
  std::map<std::size_t, std::string> found;
  while (std::getline(lines, line)) {
    const std::size_t a = line.find(','), b = line.find(',', a + 1), c = line.find(',', b + 1);
    EXPECT_EQ(line.substr(b + 1, c - b - 1), "?");
    found[std::stoul(line.substr(a + 1, b - a - 1))] =
        line.substr(c + 1, line.find(',', c + 1) - c - 1);
  }
  ASSERT_EQ(found.size(), survey.ground_truth.size());
  std::size_t right = 0, k = 0;
  for (const auto& [number, name] : found) right += name == survey.ground_truth[k++] ? 1U : 0U;
  EXPECT_GT(static_cast<double>(right), 0.8 * static_cast<double>(found.size()));
}

TEST(MapUnassociated, MendsSomeOfTwoLabelsThatAreConfusedInAQuarterOfTheStepsAndWarns) {
  const TemporaryFolder folder;
  LongSurvey survey;
  const std::string file = survey.csv([&](Eigen::Index i, Eigen::Index t) {
    const Eigen::Index other = i == 4 ? 17 : i == 17 ? 4 : i;
    return survey.history.names[static_cast<std::size_t>(t % 4 == 0 ? other : i)];
  });
  const auto plain = nlohmann::json::parse(survey.mapped(folder, file).out);
  const Outcome outcome = survey.mapped(folder, file, {"--uncertain-ids", "L5,L18"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto result = nlohmann::json::parse(outcome.out);
  EXPECT_LT(result["score"]["mpe_all_fitted_m"], plain["score"]["mpe_all_fitted_m"]);
  // Of the two measurements in each fourth step some only are found: little distinguishes two
  // landmarks that are never certain.
  const std::string csv = read_file(folder / "out" / "association.csv");
  EXPECT_GT(std::ranges::count(csv, '\n'), 30);
  EXPECT_NE(result["warnings"].dump().find("have no certain measurement"), std::string::npos)
      << result["warnings"];
}

TEST(MapUnassociated, RefusesWhatItCannotEstimate) {
  const TemporaryFolder folder;
  LongSurvey survey;
  const auto refused = [&](const std::string& file, const std::vector<std::string>& more) {
    const Outcome outcome = survey.mapped(folder, file, more);
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.error;
  };
  const auto own = [&](Eigen::Index i, Eigen::Index) {
    return survey.history.names[static_cast<std::size_t>(i)];
  };
  const std::string whole = survey.csv(own);
  EXPECT_NE(refused(whole + "10,?,1\n", {}).find("more measurements without a landmark ID than"),
            std::string::npos);
  EXPECT_NE(refused(whole + "5000,?,1\n", {}).find("has none left for"), std::string::npos);
  EXPECT_NE(refused(whole, {"--uncertain-ids", "L5"}).find("name two or more"), std::string::npos);
  EXPECT_NE(refused(whole, {"--uncertain-ids", "L5,oak"}).find("no landmark is named \"oak\""),
            std::string::npos);
  const std::string scans = folder.file("scans.csv", "step,landmark,range,bearing\n0,?,1,1\n");
  const Outcome detections = mapproof({"map", scans, "--out", folder / "scans"});
  EXPECT_EQ(detections.exit_code, 2);
  EXPECT_NE(detections.error.find("line 2: a measurement without a landmark ID"), std::string::npos)
      << detections.error;
}

}  // namespace
}  // namespace mapproof::test
