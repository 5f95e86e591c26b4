#include "core/topics/topics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "reports/sections/results/topic_records.hpp"
#include "reports/sections/topics/topic_text.hpp"
#include "tests/support/samples/scans.hpp"
#include "tests/support/samples/worlds.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

constexpr int kLandmarks = 9;

/// Files of a set whose robots measure without error.
/// @param known  Landmarks with a true position; none: there is no ground truth.
void write_set(const test::TemporaryFolder& folder, const std::string& name,
               int known = kLandmarks) {
  const Points landmarks = 6.0 * test::scattered(kLandmarks, 3);
  std::string barcodes = "# subject barcode\n1 5\n";
  std::string ground_truth;
  for (int i = 0; i < kLandmarks; ++i) {
    barcodes += fmt::format("{} {}\n", 6 + i, 60 + i);
    if (i >= known) continue;
    ground_truth += fmt::format("{} {} {} 0.001 0.001\n", 6 + i, landmarks(i, 0), landmarks(i, 1));
  }
  folder.file(name + "/Barcodes.dat", barcodes);
  if (known > 0) folder.file(name + "/Landmark_Groundtruth.dat", ground_truth);
  for (const int robot : {1, 4}) {
    std::string rows;
    for (const Detection& seen :
         test::scans_at(landmarks, 150, 4, static_cast<std::uint64_t>(robot)).detections)
      rows += fmt::format("{} {} {} {}\n", 0.5 * seen.step, 60 + seen.landmark, seen.range_m,
                          seen.bearing_rad);
    folder.file(fmt::format("{}/Robot{}_Measurement.dat", name, robot), rows);
  }
  folder.file(name + "/Robot5_Measurement.dat", "");
}

TopicExperiment experiment() {
  TopicExperiment experiment;
  experiment.name = experiment.topic = "mrclam";
  experiment.options = {{"neighbours", {5}}, {"replicates", {12}}, {"block_scans", {10}}};
  return experiment;
}

TopicPart made(const TopicExperiment& experiment, const DataSetFolder& data) {
  const TopicTask context{.experiment = experiment,
                          .part = data.set.id,
                          .run = {},
                          .anchors = {},
                          .seed = 1,
                          .data = data.folder,
                          .with_maps = true};
  return kMrclamTopic.make(context);
}

const TopicOutcome& outcome(const TopicPart& part, const std::string& method) {
  return *std::ranges::find(part.outcomes, method, &TopicOutcome::method);
}

TEST(MrclamSets, AreTheFoldersThatHoldRobotsOrTheFolderItself) {
  const test::TemporaryFolder folder;
  write_set(folder, "MRCLAM_Dataset2");
  write_set(folder, "an other");
  folder.file("notes/readme.txt", "no set");
  const std::vector<DataSetFolder> sets = kMrclamTopic.data_sets(folder.path());
  ASSERT_EQ(sets.size(), 2U);
  EXPECT_EQ(sets[0].set.id, "an-other");
  EXPECT_EQ(sets[1].set.id, "mrclam-dataset2");
  EXPECT_EQ(sets[0].set.digest, sets[1].set.digest);
  EXPECT_EQ(kMrclamTopic.data_sets(folder / "an other").at(0).set.id, "an-other");
  EXPECT_TRUE(kMrclamTopic.data_sets(folder / "notes").empty());
}

TEST(MrclamTopic, PairsOfPerfectRobotsGiveThePerfectMap) {
  const test::TemporaryFolder folder;
  write_set(folder, "set");
  const TopicExperiment ordered = experiment();
  const TopicPart part = made(ordered, kMrclamTopic.data_sets(folder.path()).at(0));
  const TopicDesign design = kMrclamTopic.design(ordered);
  ASSERT_EQ(part.outcomes.size(), design.methods.size());
  const TopicOutcome pairs = outcome(part, "pairs");
  EXPECT_LT(pairs.values.at("mpe_m"), 1e-8);
  EXPECT_LT(pairs.values.at("rigid_m"), 1e-8);
  EXPECT_EQ(pairs.values.at("mapped"), 9.0);
  // Scans with wrong landmark IDs have scores and no maps of their own.
  ASSERT_EQ(part.maps.size() + 4, design.methods.size());
  ASSERT_TRUE(part.maps.back().uncertainty);
  EXPECT_EQ(part.maps.back().uncertainty->covariances.size(), 9U);
  EXPECT_GT(outcome(part, "swapped").values.at("rigid_m"), 0.1);
  EXPECT_LT(outcome(part, "swapped-corrected").values.at("rigid_m"), 1e-6);
  EXPECT_GE(outcome(part, "swapped-corrected").values.at("faults"), 1.0);
  EXPECT_LT(outcome(part, "misnamed-corrected").values.at("rigid_m"), 1e-6);
  EXPECT_FALSE(part.maps.back().pairs.empty());
  // A quantity that does not apply to a strategy is not a lost result.
  for (const TopicOutcome& one : part.outcomes)
    for (const auto& [quantity, value] : one.values)
      EXPECT_FALSE(std::isnan(value)) << one.method << ", " << quantity;
  EXPECT_FALSE(outcome(part, "bearing-cmds").values.contains("pair_m"));
  EXPECT_FALSE(outcome(part, "swapped").values.contains("faults"));
}

TEST(MrclamTopic, MapsWithoutAPositionAreNamedAndNotDrawn) {
  const test::TemporaryFolder folder;
  write_set(folder, "set");
  TopicStudy study;
  study.experiment = experiment();
  study.design = kMrclamTopic.design(study.experiment);
  study.parts = {made(study.experiment, kMrclamTopic.data_sets(folder.path()).at(0))};
  const std::string one = "m-map-visibility-cmds", other = "m-map-visibility-isomap";
  const auto is_of = [](const std::string& id) {
    return [id](const Figure& figure) { return figure.id.starts_with(id); };
  };
  const FigureGroup all = topic_maps(study, "m");
  EXPECT_EQ(all.words, "");
  EXPECT_TRUE(std::ranges::any_of(all.figures, is_of(one)));
  // The caption of the scene names what the topic calls the method.
  ASSERT_EQ(all.scenes.size(), 1U);
  for (TopicMap& map : study.parts[0].maps)
    if (map.method != "bearing-cmds") map.map.estimate.setConstant(std::nan(""));
  const FigureGroup single = topic_maps(study, "m");
  ASSERT_EQ(single.scenes.size(), 1U);
  EXPECT_NE(single.scenes[0].caption.find("where Bearing, CMDS of"), std::string::npos)
      << single.scenes[0].caption;
  EXPECT_FALSE(std::ranges::any_of(single.figures, is_of(one)));
  EXPECT_FALSE(std::ranges::any_of(single.figures, is_of(other)));
  EXPECT_TRUE(single.words.starts_with("No landmark has a position: ")) << single.words;
  EXPECT_NE(single.words.find("Visibility, ISOMAP"), std::string::npos) << single.words;
}

TEST(MrclamTopic, WithoutGroundTruthThereAreMapsAndNoErrors) {
  const test::TemporaryFolder folder;
  write_set(folder, "set", 0);
  const TopicPart part = made(experiment(), kMrclamTopic.data_sets(folder.path()).at(0));
  EXPECT_FALSE(outcome(part, "pairs").values.contains("mpe_m"));
  EXPECT_FALSE(outcome(part, "pairs").values.contains("rigid_m"));
  EXPECT_LT(outcome(part, "pairs").values.at("pair_m"), 1e-8);
  EXPECT_TRUE(part.maps.back().map.estimate.allFinite());
  TopicStudy study;
  study.experiment = experiment();
  study.parts = {part};
  study.parts[0].id = "set";
  EXPECT_EQ(conclusions_of(study).size(), 1U);
}

TEST(MrclamTopic, HasNoErrorsOfAnchorsAlone) {
  for (const int known : {3, 4}) {
    const test::TemporaryFolder folder;
    write_set(folder, "set", known);
    const TopicPart part = made(experiment(), kMrclamTopic.data_sets(folder.path()).at(0));
    for (const TopicOutcome& one : part.outcomes)
      for (const char* quantity : {"mpe_m", "moe_percent", "mpe_all_fitted_m"})
        EXPECT_FALSE(one.values.contains(quantity)) << one.method << ", " << quantity;
    EXPECT_LT(outcome(part, "pairs").values.at("rigid_m"), 1e-8);
  }
}

TEST(MrclamTopic, ReportsASetThatCannotBeRead) {
  const test::TemporaryFolder folder;
  write_set(folder, "set");
  folder.file("set/Robot1_Measurement.dat", "1 2\n");
  try {
    kMrclamTopic.data_sets(folder.path());
    FAIL() << "it was read";
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("line 1"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace mapproof
