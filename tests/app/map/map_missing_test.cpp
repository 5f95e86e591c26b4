#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "core/base/random.hpp"
#include "core/simulate/missing_entries.hpp"
#include "core/simulate/sensors.hpp"
#include "tests/support/program.hpp"
#include "tests/support/samples/incomplete.hpp"

namespace mapproof::test {
namespace {

/// Bearings in a room, with missing data; and its anchors and ground truth.
struct IncompleteSurvey {
  /// @param by_range  The most distant entries are missing, else any.
  explicit IncompleteSurvey(const TemporaryFolder& folder, double share, bool by_range = false)
      : room(walked_room(3, 1000)) {
    Random random(7);
    const ObservationHistory history = with_missing(
        observe(room.world, room.path, {.sensor = Sensor::kBearing}, random),
        by_range ? range_losses(room.world, room.path) : random_losses(50, 1000, random), share);
    std::string csv;
    for (Eigen::Index i = 0; i < 50; ++i) {
      csv += history.names[static_cast<std::size_t>(i)];
      for (const double value : history.values.row(i))
        csv += std::isnan(value) ? std::string(",") : fmt::format(",{}", value);
      csv += "\n";
    }
    seen = folder.file("seen.csv", csv);
    ground_truth = folder.file("groundtruth.csv", positions(history.names, {}));
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
    std::vector<std::string> arguments = {"map",       seen,         "--sensor", "bearing",
                                          "--anchors", anchors,      "--truth",  ground_truth,
                                          "--method",  "smacof-knn", "-K",       "8",
                                          "--out",     out,          "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return mapproof(arguments);
  }

  WalkedRoom room;
  std::string seen, ground_truth, anchors;
};

TEST(MapMissing, FilledInByPpcaOrPcaIsBetterThanPairwiseCompleteWhereMostIsMissingAtRandom) {
  const TemporaryFolder folder;
  const IncompleteSurvey survey(folder, 0.7);
  const auto mpe = [&](const std::string& way) {
    const Outcome outcome = survey.mapped({"--missing", way}, folder / way);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    const auto result = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(result["remarks"].empty(), way == "pairwise-complete") << way;
    return result["score"]["mpe_m"].get<double>();
  };
  const double common = mpe("pairwise-complete");
  EXPECT_LT(mpe("ppca"), common);
  EXPECT_LT(mpe("pca"), common);
  EXPECT_LT(mpe("ppca"), 0.12);
}

TEST(MapMissing, OfSubmapsShowsThemAndIsNearTheGroundTruth) {
  const TemporaryFolder folder;
  const IncompleteSurvey survey(folder, 0.0);
  const Outcome outcome = survey.mapped({"--submaps", "24"}, folder / "map");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto result = nlohmann::json::parse(outcome.out);
  EXPECT_LT(result["score"]["mpe_m"], 0.25);
  ASSERT_EQ(result["remarks"].size(), 1U);
  EXPECT_EQ(result["remarks"][0].get<std::string>().substr(0, 11), "Joined from");
  EXPECT_TRUE(std::filesystem::exists(folder / "map" / "figures" / "submaps.svg"));
  const std::string half = read_file(folder / "map/map.csv");
  // Mapped as a whole into the same folder, nothing shows sub-maps any more.
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

TEST(MapMissing, OfCovisiblePairsTellsTheOnesLeftOutFromThoseWithoutACommonStep) {
  const TemporaryFolder folder;
  const IncompleteSurvey survey(folder, 0.3);
  const Outcome outcome = survey.mapped({"--missing", "covisible"}, folder / "map");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto result = nlohmann::json::parse(outcome.out);
  EXPECT_NE(result["statuses"].dump().find("(0 of them without a step in common)"),
            std::string::npos)
      << result["statuses"];
  // These missing data show nothing of what is near, and a warning says so.
  ASSERT_EQ(result["warnings"].size(), 1U);
  EXPECT_NE(result["warnings"][0].get<std::string>().find("--missing ppca is likely"),
            std::string::npos);
}

TEST(MapMissing, AutoTakesWhatThePatternOfMissingDataAdvisesAndSaysSo) {
  const TemporaryFolder folder;
  const IncompleteSurvey survey(folder, 0.5);
  const Outcome outcome = survey.mapped({"--missing", "auto"}, folder / "map");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto result = nlohmann::json::parse(outcome.out);
  EXPECT_NE(result["remarks"].dump().find(
                "the strategy is ppca, because entries are missing as if at random"),
            std::string::npos)
      << result["remarks"];
  EXPECT_TRUE(result["warnings"].empty()) << result["warnings"];
}

TEST(MapMissing, OfASensorOfShortRangeWarnsWhereEntriesAreFilledIn) {
  const TemporaryFolder folder;
  const IncompleteSurvey survey(folder, 0.7, true);
  const Outcome filled = survey.mapped({"--missing", "ppca"}, folder / "map");
  ASSERT_EQ(filled.exit_code, 0) << filled.error;
  const auto result = nlohmann::json::parse(filled.out);
  EXPECT_NE(result["warnings"].dump().find("--missing pairwise-complete is likely"),
            std::string::npos)
      << result["warnings"];
  EXPECT_NE(filled.error.find("missing by distance"), std::string::npos) << filled.error;
  const auto plain = nlohmann::json::parse(survey.mapped({}, folder / "plain").out);
  EXPECT_LT(plain["score"]["mpe_m"], result["score"]["mpe_m"]);
}

TEST(Map, RefusesAFolderOfAnotherMapBeforeItComputes) {
  const TemporaryFolder folder;
  const IncompleteSurvey survey(folder, 0.1);
  ASSERT_EQ(survey.mapped({}, folder / "map").exit_code, 0);
  const Outcome again = survey.mapped({"--steps", "100", "--missing", "ppca"}, folder / "map");
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.error.find("1000 steps there, 100 here"), std::string::npos) << again.error;
  // The remarks of the mapping are missing: it did not begin.
  EXPECT_EQ(again.error.find("PPCA"), std::string::npos) << again.error;
}

TEST(Map, WarnsOfAMapThatIsWorthNoMoreThanTheAnchorsMean) {
  const TemporaryFolder folder;
  IncompleteSurvey survey(folder, 0.0);
  // The ground truth of other landmarks: names dealt out again.
  std::string csv = "name,x,y\n";
  const std::vector<std::string> names = landmark_names(50);
  for (Eigen::Index i = 0; i < 50; ++i)
    csv += fmt::format("{},{},{}\n", names[static_cast<std::size_t>((i * 7 + 3) % 50)],
                       survey.room.world.landmarks_m(i, 0), survey.room.world.landmarks_m(i, 1));
  survey.ground_truth = folder.file("dealt.csv", csv);
  const Outcome outcome = survey.mapped({}, folder / "map");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto result = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(result["warnings"].size(), 1U) << outcome.error;
  EXPECT_NE(result["warnings"][0].get<std::string>().find("cannot be used in metres"),
            std::string::npos);
}

TEST(MapMissing, RefusesWhatDoesNotFitTogether) {
  const TemporaryFolder folder;
  const IncompleteSurvey survey(folder, 0.1);
  const Outcome unknown = survey.mapped({"--missing", "zero"}, folder / "a");
  EXPECT_EQ(unknown.exit_code, 2);
  const Outcome dimensions = survey.mapped({"--dimensions", "4"}, folder / "b");
  EXPECT_EQ(dimensions.exit_code, 2);
  EXPECT_NE(dimensions.error.find("--dimensions: --missing pairwise-complete has no dimensions"),
            std::string::npos)
      << dimensions.error;
  const std::string seen = folder.file("v.csv", "a,1,0,1\nb,1,1,0\nc,0,1,1\nd,1,,1\n");
  const Outcome visibility = mapproof(
      {"map", seen, "--sensor", "visibility", "--missing", "covisible", "--out", folder / "c"});
  EXPECT_EQ(visibility.exit_code, 2);
  EXPECT_NE(visibility.error.find("--missing covisible"), std::string::npos);
}

}  // namespace
}  // namespace mapproof::test
