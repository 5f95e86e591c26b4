#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/records/landmarks_csv.hpp"
#include "core/records/range_log_files.hpp"
#include "core/records/trajectory_files.hpp"
#include "core/records/validate.hpp"
#include "tests/core/range_slam/sample_log.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;
using test::csv_folder;
using test::sample_log;

bool remarks_hold(const RangeLog& log, std::string_view words) {
  for (const std::string& remark : log.remarks)
    if (remark.find(words) != std::string::npos) return true;
  return false;
}

/// What reading `path` says is wrong, behind the path.
std::string error_of(const fs::path& path) {
  try {
    read_range_log(path);
  } catch (const IoError& error) {
    const std::string what = error.what();
    EXPECT_LT(what.size(), 600U);
    EXPECT_EQ(what.find('\n'), std::string::npos);
    const std::string start = path.string() + ": ";
    return what.starts_with(start) ? what.substr(start.size()) : what;
  }
  return "no error";
}

void expect_same(const RangeLog& log, const RangeLog& expected, double tolerance) {
  ASSERT_EQ(log.ranges.size(), expected.ranges.size());
  for (std::size_t i = 0; i < log.ranges.size(); ++i) {
    EXPECT_EQ(log.ranges[i].time_s, expected.ranges[i].time_s);
    EXPECT_EQ(log.ranges[i].landmark, expected.ranges[i].landmark);
    EXPECT_EQ(log.ranges[i].range_m, expected.ranges[i].range_m);
  }
  ASSERT_EQ(log.odometry.size(), expected.odometry.size());
  for (std::size_t i = 0; i < log.odometry.size(); ++i) {
    EXPECT_EQ(log.odometry[i].time_s, expected.odometry[i].time_s);
    EXPECT_NEAR(log.odometry[i].distance_m, expected.odometry[i].distance_m, tolerance);
    if (i + 1 < log.odometry.size() || tolerance == 0.0) {
      EXPECT_NEAR(log.odometry[i].turn_rad, expected.odometry[i].turn_rad, tolerance);
    }
    EXPECT_EQ(log.odometry[i].sideways_m, 0.0);
  }
}

void expect_same_truth(const RangeLog& log, const RangeLog& expected) {
  EXPECT_NEAR(log.start.heading_rad, expected.start.heading_rad, 1e-12);
  EXPECT_EQ(log.start.x_m, expected.start.x_m);
  ASSERT_TRUE(log.truth && log.true_landmarks);
  EXPECT_EQ(log.truth->positions_m, expected.truth->positions_m);
  EXPECT_EQ(log.truth->heading_rad, expected.truth->heading_rad);
  EXPECT_EQ(*log.true_landmarks, *expected.true_landmarks);
}

TEST(RangeLogFiles, EveryFormatGivesTheSameLog) {
  const RangeLog log = sample_log();
  const test::TemporaryFolder folder;
  const RangeLog from_csv = read_range_log(csv_folder(folder, log));
  expect_same(from_csv, log, 0.0);
  expect_same_truth(from_csv, log);
  EXPECT_EQ(from_csv.landmarks, log.landmarks);
  EXPECT_EQ(from_csv.name, "set");
  EXPECT_EQ(read_range_log(folder / "set/ranges.csv").name, "set");

  for (const bool is_compressed : {false, true}) {
    test::write_mat(log, folder / "Sample_.mat", is_compressed);
    const RangeLog from_mat = read_range_log(folder / "Sample_.mat");
    expect_same(from_mat, log, 1e-12);
    expect_same_truth(from_mat, log);
    EXPECT_EQ(from_mat.name, "Sample");
    EXPECT_EQ(from_mat.landmarks, log.landmarks);
  }

  const RangeLog from_pyfg = read_range_log(folder.file("s.pyfg", test::pyfg_of(log)));
  expect_same(from_pyfg, log, 0.0);
  expect_same_truth(from_pyfg, log);
  EXPECT_EQ(from_pyfg.landmarks, (std::vector<std::string>{"L0", "L1", "L5"}));
}

TEST(RangeLogFiles, APairOfTextsIsALogWithoutTruthOrStart) {
  const RangeLog log = sample_log();
  const test::TemporaryFolder folder;
  const fs::path odometry = folder.file("a_DR.txt", test::dr_text_of(log));
  const fs::path ranges = folder.file("a_TD.txt", test::td_text_of(log));
  for (const fs::path& path : {odometry, ranges}) {
    const RangeLog read = read_range_log(path);
    expect_same(read, log, 0.0);
    EXPECT_EQ(read.name, "a");
    EXPECT_FALSE(read.truth);
    EXPECT_FALSE(read.true_landmarks);
    EXPECT_EQ(read.start.time_s, 10.0);
    EXPECT_EQ(read.start.heading_rad, 0.0);
    EXPECT_TRUE(remarks_hold(read, "No start is given"));
    EXPECT_TRUE(remarks_hold(read, "true path is not known"));
  }
}

TEST(RangeLogFiles, RangesOutOfOrderAreSortedAndSaidToBe) {
  RangeLog log = sample_log();
  std::rotate(log.ranges.begin(), log.ranges.begin() + 10, log.ranges.end());
  const test::TemporaryFolder folder;
  const RangeLog read = read_range_log(csv_folder(folder, log));
  expect_same(read, sample_log(), 0.0);
  EXPECT_TRUE(remarks_hold(read, "jump back 1 time"));
}

TEST(RangeLogFiles, ATrueHeadingAgainstTheTravelIsTurned) {
  RangeLog log = sample_log();
  log.truth->heading_rad.array() += std::numbers::pi;
  const test::TemporaryFolder folder;
  const RangeLog read = read_range_log(csv_folder(folder, log));
  EXPECT_TRUE(remarks_hold(read, "off by half a turn"));
  EXPECT_NEAR(std::cos(read.truth->heading_rad(3) - sample_log().truth->heading_rad(3)), 1.0,
              1e-12);
}

TEST(RangeLogFiles, OdometryWithTheTruthsTurnsIsNamed) {
  const RangeLog log = sample_log();  // Without noise the turns are the truth's.
  const test::TemporaryFolder folder;
  EXPECT_TRUE(remarks_hold(read_range_log(csv_folder(folder, log)), "no honest result"));
  test::write_mat(log, folder / "a.mat", true);
  EXPECT_TRUE(remarks_hold(read_range_log(folder / "a.mat"), "increments of DR are those"));
  RangeLog noisy = log;
  for (Motion& motion : noisy.odometry) motion.turn_rad += 0.001;
  EXPECT_FALSE(remarks_hold(read_range_log(csv_folder(folder, noisy)), "no honest result"));
}

TEST(RangeLogFiles, OdometryIsRecoveredFromTheDeadReckonedPath) {
  RangeLog log = sample_log();
  for (Motion& motion : log.odometry) motion.turn_rad = -7.0;  // DR lies, DRp does not.
  const test::TemporaryFolder folder;
  test::write_mat(log, folder / "a.mat", true);
  expect_same(read_range_log(folder / "a.mat"), sample_log(), 1e-12);
  const RangeLog given =
      read_range_log(folder / "a.mat", {.name = "", .odometry = OdometrySource::kAsGiven});
  EXPECT_EQ(given.odometry.front().turn_rad, -7.0);
}

TEST(RangeLogFiles, LandmarksWithoutRangesOrWithoutAPlaceAreNamed) {
  const RangeLog log = sample_log();
  const test::TemporaryFolder folder;
  const fs::path set = csv_folder(folder, log);
  folder.file("set/landmarks.csv", "id,x,y\n5,1,2\n8,0,0\n0,3,4\n");
  const RangeLog read = read_range_log(set);
  EXPECT_TRUE(remarks_hold(read, "no range to them: landmarks 8"));
  EXPECT_TRUE(remarks_hold(read, "No true place is given of the landmarks 1"));
  EXPECT_EQ((*read.true_landmarks)(2, 1), 2.0);
  EXPECT_TRUE(std::isnan((*read.true_landmarks)(1, 0)));
}

TEST(RangeLogFiles, WhatIsWrongInACsvIsNamedWithItsLine) {
  const RangeLog log = sample_log();
  const test::TemporaryFolder folder;
  const fs::path set = csv_folder(folder, log);
  const fs::path ranges = set / "ranges.csv";
  const auto with = [&](const std::string& text) {
    folder.file("set/ranges.csv", text);
    return error_of(set).substr(ranges.string().size() + 2);
  };
  EXPECT_EQ(with("t,beacon,range\n1,a,2\n2,a\n"), "line 3: has 2 cells, expected 3");
  EXPECT_EQ(with("t,beacon,range\n1,a,nan\n"), "line 2: \"nan\" is not finite");
  EXPECT_EQ(with("t,beacon,range\n1,a,-2\n"), "line 2: a range cannot be negative, got -2");
  EXPECT_EQ(with("t,beacon,range\n1,,2\n"), "line 2: a landmark without a name");
  EXPECT_EQ(with("t,beacon,range\n1e300,a,2\n"),
            "line 2: a time in seconds is at most 1e+12, got 1e+300");
  EXPECT_EQ(with("t,t,range,beacon\n"), "line 1: two columns of times");
  EXPECT_EQ(with("t,beacon\n1,a\n"),
            "line 1: no column of ranges: expected range, range_m in the header");
  EXPECT_EQ(with("t,beacon,range\n"), "holds no ranges");
  EXPECT_EQ(with("t,robot,beacon,range\n1,1,a,2\n2,2,a,2\n"),
            "line 3: a reading of robot 2 after those of robot 1: give the readings of one robot");
  EXPECT_EQ(with(""), "is empty");
}

TEST(RangeLogFiles, TimesOfAPathMustAscend) {
  const test::TemporaryFolder folder;
  const fs::path set = csv_folder(folder, sample_log());
  folder.file("set/groundtruth.csv", "t,x,y\n1,0,0\n1,0,0\n");
  EXPECT_EQ(error_of(set), (set / "groundtruth.csv").string() +
                               ": line 3: the time 1 s is not after the one before, 1 s");
  folder.file("set/groundtruth.csv", "t,x,y\n1,0,0\n2,0,0\n");
  EXPECT_EQ(read_range_log(set).truth->heading_rad.size(), 0);
  folder.file("set/odometry_start.csv", "t,x,y,heading\n99,0,0,0\n");
  EXPECT_NE(error_of(set).find("is not before the first motion"), std::string::npos);
}

TEST(RangeLogFiles, WhatIsWrongInAPyfgFileIsNamedWithItsLine) {
  const test::TemporaryFolder folder;
  const auto with = [&](const std::string& text) { return error_of(folder.file("a.pyfg", text)); };
  const std::string two = "VERTEX_SE2 0 A0 0 0 0\nVERTEX_SE2 1 A1 1 0 0\nVERTEX_XY L0 3 3\n";
  const std::string edge = "EDGE_SE2 1 A0 A1 1 0 0 1 0 0 1 0 1\n";
  EXPECT_EQ(with("VERTEX_SE3:QUAT 0 A0 0 0 0 0 0 0 1\n"),
            "line 1: is three-dimensional: \"VERTEX_SE3:QUAT\"; maps are of the plane");
  EXPECT_EQ(with("VERTEX_SE2 0 A0 0 0 0\nVERTEX_SE2 1 B0 1 0 0\n"),
            "line 2: pose \"B0\" is of another robot than \"A0\": give the lines of one robot");
  EXPECT_EQ(with(two + edge + "EDGE_RANGE 1 A1 L7 2 1\n"),
            "line 5: no vertex before it is the landmark \"L7\"");
  EXPECT_EQ(with(two + edge + "EDGE_RANGE 1 A1 A0 2 1\n"), "line 5: a range between two poses");
  EXPECT_EQ(with(two + "EDGE_SE2 1 A1 A0 1 0 0 1 0 0 1 0 1\n"),
            "line 4: an edge between poses that do not follow each other");
  EXPECT_EQ(with(two + "EDGE_RANGE 1 A1 L0 2 1\n"),
            "0 odometry edges for 2 poses: one less is expected");
  EXPECT_EQ(with(two + edge), "holds no ranges");
  EXPECT_EQ(with(two + "EDGE_SE2 1 A0 A1 1 0 x 1 0 0 1 0 1\n"), "line 4: \"x\" is not a number");
  EXPECT_EQ(with(two + "NODE 1\n"), "line 4: unknown record \"NODE\"");
  EXPECT_EQ(with(""), "is empty");
}

TEST(RangeLogFiles, SeveralSendersAreRefused) {
  const test::TemporaryFolder folder;
  const fs::path path = folder.file("a_TD.txt", "1 2 0 5\n2 3 0 5\n");
  EXPECT_EQ(error_of(path),
            "line 2: a reading of robot 3 after those of robot 2: give the readings of one robot");
  EXPECT_EQ(error_of(folder.file("a_TD.txt", "1 2 0.5 5\n")),
            "line 1: expected a landmark's number without decimals, got 0.5");
}

TEST(RangeLogFiles, ValidateKnowsThem) {
  const test::TemporaryFolder folder;
  const fs::path set = csv_folder(folder, sample_log());
  EXPECT_EQ(validate(set).at(0).kind, "range log");
  EXPECT_EQ(validate(set).at(0).problem, "");
  const Finding broken = validate(folder.file("a.pyfg", "NODE\n")).at(0);
  EXPECT_EQ(broken.kind, "range log");
  EXPECT_TRUE(broken.problem.ends_with("line 1: unknown record \"NODE\""));
}

TEST(RangeLogFiles, OtherPathsAreNoRangeLogs) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(is_range_log(folder.path()));
  EXPECT_FALSE(is_range_log(folder / "nothing"));
  EXPECT_FALSE(is_range_log(folder.file("a.csv", "t,beacon,range\n1,1,1\n")));
  EXPECT_FALSE(is_range_log(folder.file("ranges.csv", "name,1,2\na,1,1\n")));
  EXPECT_TRUE(is_range_log(folder.file("ranges.csv", "t,beacon,range\n1,1,1\n")));
  EXPECT_TRUE(is_range_log(folder.path()));
  EXPECT_EQ(error_of(folder / "nothing"), "is not there");
  EXPECT_EQ(error_of(folder.file("a.mat", "no")), "is no MATLAB file");
  EXPECT_TRUE(error_of(folder.file("a.csv", "x")).starts_with("holds no ranges"));
}

TEST(TrajectoryFiles, APathReadsBackFromCsv) {
  const RangeLog log = sample_log();
  const test::TemporaryFolder folder;
  const fs::path set = csv_folder(folder, log);
  folder.file("set/groundtruth.csv", trajectory_csv(*log.truth));
  EXPECT_EQ(read_range_log(set).truth->positions_m, log.truth->positions_m);
}

TEST(TrajectoryFiles, TumHoldsTheHeadingAsAQuaternion) {
  const Trajectory path{.time_s = Eigen::VectorXd::Constant(1, 2.5),
                        .positions_m = Points::Constant(1, 2, -1.0),
                        .heading_rad = Eigen::VectorXd::Constant(1, std::numbers::pi)};
  EXPECT_EQ(trajectory_tum(path), "2.5 -1 -1 0 0 0 1 6.123233995736766e-17\n");
  EXPECT_THROW(trajectory_tum({.time_s = Eigen::VectorXd::Zero(2),
                               .positions_m = Points::Zero(1, 2),
                               .heading_rad = {}}),
               InvalidInput);
}

TEST(TrajectoryFiles, LandmarksReadBack) {
  Points positions(3, 2);
  positions << 1.5, 2.0, std::nan(""), 0.0, -3.0, 0.1;
  const test::TemporaryFolder folder;
  const NamedPoints read =
      read_landmarks(folder.file("l.csv", landmarks_csv({"a,b", "lost", "c"}, positions)));
  EXPECT_EQ(read.names, (std::vector<std::string>{"a,b", "c"}));
  EXPECT_EQ(read.positions_m(1, 1), 0.1);
}

/// Facts of the published sets, where the variable says that they can be had.
class PlazaFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("MAPPROOF_PLAZA");
    if (folder == nullptr) GTEST_SKIP() << "MAPPROOF_PLAZA does not name the folder of the sets";
    folder_ = folder;
  }
  fs::path folder_;
};

TEST_F(PlazaFiles, TheMatlabFileIsTheTables) {
  for (const std::string number : {"1", "2"}) {
    const RangeLog mat = read_range_log(folder_ / ("raw_gtsam/Plaza" + number + "_.mat"));
    const RangeLog csv = read_range_log(folder_ / ("plaza" + number));
    EXPECT_EQ(mat.name, "Plaza" + number);
    EXPECT_EQ(mat.landmarks, (std::vector<std::string>{"0", "1", "5", "6"}));
    expect_same(mat, csv, 1e-9);
    EXPECT_EQ(mat.truth->positions_m, csv.truth->positions_m);
    EXPECT_EQ(*mat.true_landmarks, *csv.true_landmarks);
    EXPECT_NEAR(mat.start.heading_rad, csv.start.heading_rad, 1e-12);
    const RangeLog text = read_range_log(folder_ / ("raw_gtsam/Plaza" + number + "_DR.txt"));
    EXPECT_EQ(text.ranges.size(), mat.ranges.size());
  }
}

TEST_F(PlazaFiles, TheTrapsOfTheSetsAreRemarked) {
  const RangeLog first = read_range_log(folder_ / "raw_gtsam/Plaza1_.mat");
  EXPECT_EQ(first.odometry.size(), 9657U);
  EXPECT_EQ(first.ranges.size(), 3529U);
  EXPECT_TRUE(remarks_hold(first, "increments of DR are those of the true heading"));
  EXPECT_TRUE(remarks_hold(first, "jump back 2 times, by up to 64.4 s"));
  EXPECT_FALSE(remarks_hold(first, "no honest result"));
  EXPECT_FALSE(remarks_hold(first, "half a turn"));
  const RangeLog second = read_range_log(folder_ / "raw_gtsam/Plaza2_.mat");
  EXPECT_EQ(second.odometry.size(), 4090U);
  EXPECT_TRUE(remarks_hold(second, "off by half a turn"));
  EXPECT_FALSE(remarks_hold(second, "jump back"));
}

}  // namespace
}  // namespace mapproof
