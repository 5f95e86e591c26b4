#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files.hpp"
#include "core/base/random.hpp"
#include "core/simulate/gaps.hpp"
#include "core/simulate/sensors.hpp"
#include "tests/support/gappy.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

/// Bearings in a room, with gaps, as a person has them; and its anchors and truth.
struct GappedSurvey {
  explicit GappedSurvey(const TemporaryFolder& folder, double share) : room(walked_room(3, 1000)) {
    Random random(7);
    const ObservationHistory history =
        with_gaps(observe(room.world, room.path, {.sensor = Sensor::kBearing}, random),
                  random_losses(50, 1000, random), share);
    std::string csv;
    for (Eigen::Index i = 0; i < 50; ++i) {
      csv += history.names[static_cast<std::size_t>(i)];
      for (const double value : history.values.row(i))
        csv += std::isnan(value) ? std::string(",") : fmt::format(",{}", value);
      csv += "\n";
    }
    seen = folder.file("seen.csv", csv);
    truth = folder.file("truth.csv", positions(history.names, {}));
    anchors = folder.file("anchors.csv", positions(history.names, room.anchors));
  }

  std::string positions(const std::vector<std::string>& names,
                        const std::vector<Eigen::Index>& rows) const {
    std::string csv = "name,x,y\n";
    for (Eigen::Index i = 0; i < 50; ++i)
      if (rows.empty() || std::ranges::find(rows, i) != rows.end())
        csv += fmt::format("{},{},{}\n", names[static_cast<std::size_t>(i)],
                           room.world.landmarks_m(i, 0), room.world.landmarks_m(i, 1));
    return csv;
  }

  Outcome mapped(const std::vector<std::string>& more, const std::string& out) const {
    std::vector<std::string> arguments = {"map",   seen,      "--kind", "bearing",  "--anchors",
                                          anchors, "--truth", truth,    "--method", "smacof-knn",
                                          "-K",    "8",       "--out",  out,        "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return mapproof(arguments);
  }

  WalkedRoom room;
  std::string seen, truth, anchors;
};

TEST(MapMissing, FilledInByPpcaOrPcaIsBetterThanCommonStepsWhereMostIsMissingAtRandom) {
  const TemporaryFolder folder;
  const GappedSurvey survey(folder, 0.7);
  const auto mpe = [&](const std::string& way) {
    const Outcome outcome = survey.mapped({"--missing", way}, folder / way);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    const auto result = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(result["remarks"].empty(), way == "common-steps") << way;
    return result["score"]["mpe_m"].get<double>();
  };
  const double common = mpe("common-steps");
  EXPECT_LT(mpe("ppca"), common);
  EXPECT_LT(mpe("pca"), common);
  EXPECT_LT(mpe("ppca"), 0.12);
}

TEST(MapMissing, OfSubmapsShowsThemAndIsNearTheTruth) {
  const TemporaryFolder folder;
  const GappedSurvey survey(folder, 0.0);
  const Outcome outcome = survey.mapped({"--submaps", "24"}, folder / "map");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto result = nlohmann::json::parse(outcome.out);
  EXPECT_LT(result["score"]["mpe_m"], 0.25);
  ASSERT_EQ(result["remarks"].size(), 1U);
  EXPECT_EQ(result["remarks"][0].get<std::string>().substr(0, 11), "Joined from");
  EXPECT_TRUE(std::filesystem::exists(folder / "map" / "figures" / "submaps.svg"));
  const std::string half = read_file(folder / "map/map.csv");
  // Mapped as a whole into the same folder, nothing tells of sub-maps any more.
  EXPECT_EQ(survey.mapped({}, folder / "map").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "map" / "figures" / "submaps.svg"));
  EXPECT_EQ(survey.mapped({"--submaps", "5"}, folder / "small").exit_code, 2);
  EXPECT_EQ(survey.mapped({"--submaps", "24", "--overlap", "0.65"}, folder / "more").exit_code, 0);
  EXPECT_NE(read_file(folder / "more/map.csv"), half);
  EXPECT_EQ(survey.mapped({"--submaps", "24", "--overlap", "0.5"}, folder / "same").exit_code, 0);
  EXPECT_EQ(read_file(folder / "same/map.csv"), half);
  const Outcome alone = survey.mapped({"--overlap", "0.65"}, folder / "alone");
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_NE(alone.error.find("add --submaps"), std::string::npos);
}

TEST(MapMissing, RefusesWhatDoesNotFitTogether) {
  const TemporaryFolder folder;
  const GappedSurvey survey(folder, 0.1);
  const Outcome unknown = survey.mapped({"--missing", "zero"}, folder / "a");
  EXPECT_EQ(unknown.exit_code, 2);
  const Outcome dimensions = survey.mapped({"--dimensions", "4"}, folder / "b");
  EXPECT_EQ(dimensions.exit_code, 2);
  EXPECT_NE(dimensions.error.find("--dimensions: --missing common-steps has none"),
            std::string::npos)
      << dimensions.error;
  const std::string seen = folder.file("v.csv", "a,1,0,1\nb,1,1,0\nc,0,1,1\nd,1,,1\n");
  const Outcome visibility = mapproof(
      {"map", seen, "--kind", "visibility", "--missing", "covisible", "--out", folder / "c"});
  EXPECT_EQ(visibility.exit_code, 2);
  EXPECT_NE(visibility.error.find("--missing covisible"), std::string::npos);
}

}  // namespace
}  // namespace mapproof::test
