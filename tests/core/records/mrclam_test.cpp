#include "core/records/detections/mrclam.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "core/base/files/files.hpp"
#include "tests/core/records/samples.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;
using test::data_file;
using test::error_of;

/// A copy of tests/data/mrclam in which one file has other bytes; the error behind its path.
std::string mrclam_error(const std::string& file, const std::string& bytes) {
  const test::TemporaryFolder folder;
  fs::copy(data_file("mrclam"), folder / "set");
  const std::string path = folder.file("set/" + file, bytes).string();
  const std::string error = error_of([&] { read_mrclam(folder / "set", Sensor::kBearing); });
  return error.starts_with(path + ": ") ? error.substr(path.size() + 2) : error;
}

TEST(Mrclam, PoolsTheScansOfAllRobots) {
  const ObservationSource source = read_observations(data_file("mrclam"), std::nullopt);
  EXPECT_EQ(source.history.sensor, Sensor::kVisibility);
  EXPECT_EQ(source.history.names, (std::vector<std::string>{"6", "7", "8"}));
  Eigen::MatrixXd expected(3, 4);
  expected << 1, 0, 1, 0, 1, 0, 0, 1, 0, 1, 0, 0;
  EXPECT_EQ(source.history.values, expected);
}

TEST(Mrclam, SaysWhatItDropped) {
  EXPECT_EQ(
      read_mrclam(data_file("mrclam"), Sensor::kRange).remarks,
      (std::vector<std::string>{"Rows dropped with unknown barcodes: 2 (barcodes 99)",
                                "Rows dropped that show other robots: 2",
                                "Rows dropped that show a landmark a second time in one scan: 1",
                                "Scans dropped that show no landmark: 2"}));
}

TEST(Mrclam, TakesWhatWasNotSeenAsMissingForBearingAndRange) {
  const ObservationSource bearing = read_mrclam(data_file("mrclam"), Sensor::kBearing);
  EXPECT_EQ(bearing.history.values(0, 0), -0.278);
  EXPECT_EQ(bearing.history.values(1, 3), -0.75);
  EXPECT_TRUE(std::isnan(bearing.history.values(2, 0)));
  EXPECT_EQ(read_mrclam(data_file("mrclam"), Sensor::kRange).history.values(0, 2), 4.0);
}

TEST(Mrclam, TakesTheGroundTruthFromItsFile) {
  const ObservationSource source = read_mrclam(data_file("mrclam"), Sensor::kVisibility);
  ASSERT_TRUE(source.ground_truth_m.has_value());
  Points expected(3, 2);
  expected << 0.5, -1.25, 2.0, 1.5, -1.0, 3.0;
  EXPECT_EQ(*source.ground_truth_m, expected);
}

TEST(Mrclam, DoesWithoutTheGroundTruth) {
  const test::TemporaryFolder folder;
  fs::copy(data_file("mrclam"), folder / "set");
  fs::remove(folder / "set/Landmark_Groundtruth.dat");
  const ObservationSource source = read_mrclam(folder / "set", Sensor::kVisibility);
  EXPECT_FALSE(source.ground_truth_m.has_value());
  EXPECT_NE(source.remarks.back().find("not known"), std::string::npos);
}

TEST(Mrclam, NeedsTheBarcodes) {
  const test::TemporaryFolder folder;
  fs::copy(data_file("mrclam"), folder / "set");
  fs::remove(folder / "set/Barcodes.dat");
  EXPECT_EQ(
      error_of([&] { read_mrclam(folder / "set", Sensor::kVisibility); }),
      (folder / "set/Barcodes.dat").string() + ": cannot be opened: No such file or directory");
}

TEST(Mrclam, NamesTheLineThatIsWrong) {
  EXPECT_EQ(mrclam_error("Robot1_Measurement.dat", "# x\n1 63 2\n"),
            "line 2: has 3 numbers, expected 4");
  EXPECT_EQ(mrclam_error("Robot1_Measurement.dat", "1 63 2 x\n"), "line 1: \"x\" is not a number");
  EXPECT_EQ(mrclam_error("Robot1_Measurement.dat", "1 63 2 nan\n"),
            "line 1: \"nan\" is not finite");
  EXPECT_EQ(mrclam_error("Robot1_Measurement.dat", "1 63 -2 0\n"),
            "line 1: a range cannot be negative, got -2: is it a bearing?");
  EXPECT_EQ(mrclam_error("Robot2_Measurement.dat", "1 6.3 2 0\n"),
            "line 1: expected a number without decimals, got \"6.3\"");
  EXPECT_EQ(mrclam_error("Barcodes.dat", "6 63\n7 63\n"), "line 2: barcode 63 is there twice");
  EXPECT_EQ(mrclam_error("Barcodes.dat", "1 63\n"), "names no landmark: none above 5");
  EXPECT_EQ(mrclam_error("Landmark_Groundtruth.dat", "6 1 2 0 0\n6 1 2 0 0\n"),
            "line 2: landmark \"6\" is already on line 1");
}

/// Facts of a real set, where the variable names its folder.
TEST(MrclamData, HoldsFifteenLandmarksSeenInSomeTwentyThousandScans) {
  const char* folder = std::getenv("MAPPROOF_MRCLAM");
  if (folder == nullptr) GTEST_SKIP() << "MAPPROOF_MRCLAM does not name the folder of the sets";
  const ObservationSource source =
      read_observations(std::filesystem::path(folder) / "dataset2", Sensor::kVisibility);
  EXPECT_EQ(source.history.landmarks(), 15);
  EXPECT_EQ(source.history.names.front(), "6");
  EXPECT_EQ(source.history.names.back(), "20");
  EXPECT_GT(source.history.steps(), 10'000);
  EXPECT_NEAR(source.history.values.sum() / static_cast<double>(source.history.steps()), 1.5, 0.2);
  ASSERT_TRUE(source.ground_truth_m.has_value());
  EXPECT_TRUE(source.ground_truth_m->allFinite());
}

}  // namespace
}  // namespace mapproof
