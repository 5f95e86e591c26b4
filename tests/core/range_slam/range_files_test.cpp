#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/records/ranges/range_logs.hpp"
#include "core/studies/validate.hpp"
#include "tests/core/range_slam/sample_log.hpp"
#include "tests/support/packing.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;
using test::csv_folder;
using test::expect_same;
using test::ground_truth_csv_of;
using test::odometry_csv_of;
using test::ranges_csv_of;
using test::remarks_hold;
using test::sample_log;

/// The error of reading `path`, without the path.
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

bool shows_ranges(const fs::path& path) {
  ByteSource source(path);
  return is_range_log(source);
}

void expect_same_ground_truth(const RangeLog& log, const RangeLog& expected) {
  EXPECT_NEAR(log.start.heading_rad, expected.start.heading_rad, 1e-12);
  EXPECT_EQ(log.start.x_m, expected.start.x_m);
  ASSERT_TRUE(log.ground_truth && log.true_landmarks);
  EXPECT_EQ(log.ground_truth->positions_m, expected.ground_truth->positions_m);
  EXPECT_EQ(log.ground_truth->heading_rad, expected.ground_truth->heading_rad);
  EXPECT_EQ(*log.true_landmarks, *expected.true_landmarks);
}

/// The text with the first row replaced.
std::string with_header(const std::string& header, const std::string& table) {
  return header + table.substr(table.find('\n'));
}

TEST(RangeLogFiles, ColumnsMayHaveTheNamesOfOtherTables) {
  const RangeLog log = sample_log();
  const test::TemporaryFolder folder;
  const std::string ranges = ranges_csv_of(log);
  for (const char* header :
       {"time,tag_id,range,raw_row", "Zeit,Objekt,Entfernung,raw_row",
        "header.stamp,Landmark ID,Range [m],raw_row", "stamp,subject,dist,raw_row"}) {
    SCOPED_TRACE(header);
    expect_same(read_range_log(folder.file("log.csv", with_header(header, ranges))),
                read_range_log(folder.file("usual.csv", ranges)), 0.0);
  }
  // In other units, with bearings that are not used, with a row that has no range.
  const RangeLog units = read_range_log(folder.file(
      "units.csv", "time_ms,id,bearing,range_cm\n500,a,0.1,150\n1000,b,0.2,NA\n1500,b,0,250\n"));
  ASSERT_EQ(units.ranges.size(), 2U);
  EXPECT_DOUBLE_EQ(units.ranges[1].time_s, 1.5);
  EXPECT_DOUBLE_EQ(units.ranges[1].range_m, 2.5);
  EXPECT_TRUE(remarks_hold(units, "1 row without a range: left out."));
  const RangeLog stamps = read_range_log(folder.file(
      "stamps.csv", "header.stamp.sec,header.stamp.nanosec,id,range\n5,500000000,a,1\n6,0,b,2\n"));
  EXPECT_DOUBLE_EQ(stamps.ranges[0].time_s, 5.5);
  // Of Windows, with decimal commas.
  const RangeLog german = read_range_log(
      folder.file("german.csv", "Zeit;Bake;Entfernung\n0,5;T\xFCr;1,5\n1;S\xE4ule;2\n"));
  EXPECT_EQ(german.landmarks, (std::vector<std::string>{"Tür", "Säule"}));
  EXPECT_DOUBLE_EQ(german.ranges[0].range_m, 1.5);
}

TEST(RangeLogFiles, ColumnsMayBeNamed) {
  const RangeLog log = sample_log();
  const test::TemporaryFolder folder;
  const fs::path set = csv_folder(folder, log);
  write_file(set / "ranges.csv", with_header("Uhr,Kennung,3D,raw_row", ranges_csv_of(log)));
  EXPECT_EQ(
      error_of(set / "ranges.csv"),
      "line 1: no column of times: expected t, time, timestamp, stamp, datetime in the header; "
      "--columns time=HEADER names another");
  fs::rename(set / "ranges.csv", set / "log.csv");
  EXPECT_EQ(
      error_of(set / "log.csv"),
      "its header \"Uhr, Kennung, 3D, raw_row\" names no times and no landmarks and no ranges: "
      "--columns time=HEADER,landmark=HEADER,range=HEADER does");
  write_file(set / "odometry.csv", with_header("dpsi,Uhr,s", odometry_csv_of(log)));
  const RangeLogOptions options{.odometry_file = set / "odometry.csv",
                                .columns = column_names({"time=Uhr", "landmark=Kennung", "range=3",
                                                         "distance=s", "heading_change=dpsi"},
                                                        kRangeLogRoles)};
  const RangeLog read = read_range_log(set / "log.csv", options);
  EXPECT_EQ(read.ranges.size(), log.ranges.size());
  EXPECT_EQ(read.odometry.size(), log.odometry.size());
  const RangeLogOptions slip{.columns = column_names({"range=rnge"}, kRangeLogRoles)};
  EXPECT_THROW(read_range_log(folder.file("usual.csv", ranges_csv_of(log)), slip), IoError);
  EXPECT_THROW(column_names({"bearing=b"}, kRangeLogRoles), InvalidInput);
  EXPECT_THROW(column_names({"heading=b"}), InvalidInput);
}

TEST(RangeLogFiles, OdometryInDegreesOrAsTheWholeWayIsRemarkedOn) {
  const test::TemporaryFolder folder;
  const auto read = [&](double turn, bool is_whole_way) {
    std::string odometry = "t,ddist,dheading\n";
    for (int i = 1; i <= 40; ++i)
      odometry += fmt::format("{},{},{}\n", i, is_whole_way ? 0.5 * i : 0.5, turn);
    RangeLogOptions options{.odometry_file = folder.file("odometry.csv", odometry)};
    return read_range_log(folder.file("r.csv", "t,beacon,range\n1,a,1\n2,b,2\n"), options);
  };
  EXPECT_FALSE(remarks_hold(read(0.1, false), "degrees"));
  EXPECT_FALSE(remarks_hold(read(0.1, false), "whole way"));
  EXPECT_TRUE(remarks_hold(read(5.0, false), "degrees"));
  EXPECT_TRUE(remarks_hold(read(0.1, true), "whole way"));
}

TEST(RangeLogFiles, TablesOfRangesMayBeJsonLines) {
  const test::TemporaryFolder folder;
  const RangeLog log =
      read_range_log(folder.file("log.jsonl",
                                 "{\"t\": 0, \"tag\": 7, \"range\": 1.5}\n{\"t\": 1, \"tag\": 8, "
                                 "\"range\": 2}\n"));
  EXPECT_EQ(log.landmarks, (std::vector<std::string>{"7", "8"}));
  EXPECT_DOUBLE_EQ(log.ranges[0].range_m, 1.5);
}

TEST(RangeLogFiles, WhatGoesWithRangesIsKnownToValidate) {
  const RangeLog log = sample_log();
  const test::TemporaryFolder folder;
  const auto finding = [&](const std::string& bytes) {
    return validate(folder.file("file.csv", bytes)).at(0);
  };
  EXPECT_EQ(finding(odometry_csv_of(log)).kind, "odometry of a range log, CSV");
  EXPECT_EQ(finding("Zeit;Weg;Drehung\n1;0,5;0,1\n2;0,5;0\n").kind, "odometry of a range log, CSV");
  EXPECT_EQ(finding(ground_truth_csv_of(log)).kind, "path, CSV");
  std::string tum, kitti;
  for (int i = 0; i < 20; ++i) {
    tum += std::to_string(i) + " 1 2 0 0 0 0.6 0.8\n";
    kitti += "1 0 0 5 0 1 0 6 0 0 1 0\n";
  }
  EXPECT_EQ(finding(tum).kind, "path, TUM");
  EXPECT_EQ(finding(kitti).kind, "path, KITTI");
  EXPECT_NE(finding(tum + "20 1 2 x 0 0 0 1\n").problem.find("line 21"), std::string::npos);
  // Eight steps of three landmarks are no path.
  EXPECT_EQ(finding("1 2 3 1 2 1 2 3\n1 2 3 1 2 1 2 3\n3 2 1 3 2 1 1 2\n").kind,
            "wide CSV observations");
}

TEST(RangeLogFiles, EveryFormatGivesTheSameLog) {
  const RangeLog log = sample_log();
  const test::TemporaryFolder folder;
  const RangeLog from_csv = read_range_log(csv_folder(folder, log));
  expect_same(from_csv, log, 0.0);
  expect_same_ground_truth(from_csv, log);
  EXPECT_EQ(from_csv.landmarks, log.landmarks);
  EXPECT_EQ(from_csv.name, "set");
  EXPECT_EQ(read_range_log(folder / "set/ranges.csv").name, "set");

  for (const bool is_compressed : {false, true}) {
    test::write_mat(log, folder / "Sample_.mat", is_compressed);
    const RangeLog from_mat = read_range_log(folder / "Sample_.mat");
    expect_same(from_mat, log, 1e-12);
    expect_same_ground_truth(from_mat, log);
    EXPECT_EQ(from_mat.name, "Sample");
    EXPECT_EQ(from_mat.landmarks, log.landmarks);
  }

  const RangeLog from_pyfg = read_range_log(folder.file("s.pyfg", test::pyfg_of(log)));
  expect_same(from_pyfg, log, 0.0);
  expect_same_ground_truth(from_pyfg, log);
  EXPECT_EQ(from_pyfg.landmarks, (std::vector<std::string>{"L0", "L1", "L5"}));
}

TEST(RangeLogFiles, APairOfTextsIsALogWithoutGroundTruthOrStart) {
  const RangeLog log = sample_log();
  const test::TemporaryFolder folder;
  const fs::path odometry = folder.file("a_DR.txt", test::dr_text_of(log));
  const fs::path ranges = folder.file("a_TD.txt", test::td_text_of(log));
  for (const fs::path& path : {odometry, ranges}) {
    const RangeLog read = read_range_log(path);
    expect_same(read, log, 0.0);
    EXPECT_EQ(read.name, "a");
    EXPECT_FALSE(read.ground_truth);
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
  log.ground_truth->heading_rad.array() += std::numbers::pi;
  const test::TemporaryFolder folder;
  const RangeLog read = read_range_log(csv_folder(folder, log));
  EXPECT_TRUE(remarks_hold(read, "off by 180 degrees"));
  EXPECT_NEAR(
      std::cos(read.ground_truth->heading_rad(3) - sample_log().ground_truth->heading_rad(3)), 1.0,
      1e-12);
}

TEST(RangeLogFiles, OdometryWithTheGroundTruthsTurnsIsNamed) {
  const RangeLog log =
      sample_log();  // Without noise the heading changes are those of the ground truth.
  const test::TemporaryFolder folder;
  EXPECT_TRUE(remarks_hold(read_range_log(csv_folder(folder, log)), "is optimistic"));
  test::write_mat(log, folder / "a.mat", true);
  EXPECT_TRUE(remarks_hold(read_range_log(folder / "a.mat"), "increments of DR are those"));
  RangeLog noisy = log;
  for (Motion& motion : noisy.odometry) motion.heading_change_rad += 0.001;
  EXPECT_FALSE(remarks_hold(read_range_log(csv_folder(folder, noisy)), "is optimistic"));
}

TEST(RangeLogFiles, OdometryIsRecoveredFromTheDeadReckonedPath) {
  RangeLog log = sample_log();
  for (Motion& motion : log.odometry) motion.heading_change_rad = -7.0;  // DR lies, DRp does not.
  const test::TemporaryFolder folder;
  test::write_mat(log, folder / "a.mat", true);
  expect_same(read_range_log(folder / "a.mat"), sample_log(), 1e-12);
  RangeLogOptions as_given;
  as_given.odometry = OdometrySource::kAsGiven;
  const RangeLog given = read_range_log(folder / "a.mat", as_given);
  EXPECT_EQ(given.odometry.front().heading_change_rad, -7.0);
}

TEST(RangeLogFiles, LandmarksWithoutRangesOrWithoutAPlaceAreNamed) {
  const RangeLog log = sample_log();
  const test::TemporaryFolder folder;
  const fs::path set = csv_folder(folder, log);
  folder.file("set/landmarks.csv", "id,x,y\n5,1,2\n8,0,0\n0,3,4\n");
  const RangeLog read = read_range_log(set);
  EXPECT_TRUE(remarks_hold(read, "no range to them: landmarks 8"));
  EXPECT_TRUE(remarks_hold(read, "No true position is given for the landmarks 1"));
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
  EXPECT_EQ(with("t,beacon,range\n1,a,inf\n"), "line 2: \"inf\" is not finite");
  EXPECT_EQ(with("t,beacon,range\n1,a,-2\n"),
            "line 2: a range cannot be negative, got -2: is it a bearing?");
  EXPECT_EQ(with("t,beacon,range\n1,,2\n"), "line 2: a landmark without a name");
  EXPECT_EQ(with("t,beacon,range\n1e300,a,2\n"),
            "line 2: a time in seconds is at most 1e+12, got 1e+300");
  EXPECT_EQ(with("t,t,range,beacon\n"),
            "line 1: two columns of times: --columns time=HEADER names the one to read");
  EXPECT_EQ(
      with("t,beacon\n1,a\n"),
      "line 1: no column of ranges: expected range in the header; --columns range=HEADER names "
      "another");
  EXPECT_EQ(with("t,beacon,range\n"), "holds no ranges");
  EXPECT_EQ(with("t,robot,beacon,range\n1,1,a,2\n2,2,a,2\n"),
            "line 3: a measurement of robot 2 after those of robot 1: give the measurements of one "
            "robot");
  EXPECT_EQ(with(""), "is empty");
}

TEST(RangeLogFiles, TimesOfAPathMustAscend) {
  const test::TemporaryFolder folder;
  const fs::path set = csv_folder(folder, sample_log());
  folder.file("set/groundtruth.csv", "t,x,y\n1,0,0\n1,0,0\n");
  EXPECT_EQ(error_of(set), (set / "groundtruth.csv").string() +
                               ": line 3: the time 1 s is not after the one before, 1 s");
  folder.file("set/groundtruth.csv", "t,x,y\n1,0,0\n2,0,0\n");
  EXPECT_EQ(read_range_log(set).ground_truth->heading_rad.size(), 0);
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

TEST(RangeLogFiles, StampsOfPyfgEdgesAreNumbersAndSaidToDiffer) {
  const test::TemporaryFolder folder;
  const auto with = [&](const std::string& motion_s, const std::string& range_s) {
    return folder.file("a.pyfg",
                       "VERTEX_SE2 0 A0 0 0 0\nVERTEX_SE2 1 A1 1 0 0\nVERTEX_XY L0 3 3\n"
                       "EDGE_SE2 " +
                           motion_s +
                           " A0 A1 1 0 0 1 0 0 1 0 1\n"
                           "EDGE_RANGE " +
                           range_s + " A1 L0 2 1\n");
  };
  EXPECT_FALSE(remarks_hold(read_range_log(with("0", "1")), "stamped otherwise"));
  EXPECT_FALSE(remarks_hold(read_range_log(with("1", "1")), "stamped otherwise"));
  const RangeLog other = read_range_log(with("1", "1.25"));
  EXPECT_TRUE(remarks_hold(other, "1 edge stamped otherwise than the poses, by up to 0.25 s"));
  EXPECT_EQ(other.ranges[0].time_s, 1.0);
  EXPECT_EQ(error_of(with("x", "1")), "line 4: \"x\" is not a number");
  EXPECT_EQ(error_of(with("1", "x")), "line 5: \"x\" is not a number");
}

TEST(RangeLogFiles, AStartThatIsMissingIsMadeUpAndSaidToBe) {
  const test::TemporaryFolder folder;
  folder.file("ranges.csv", "t,beacon,range\n5,a,2\n9,a,3\n");
  folder.file("odometry.csv", "t,ddist,dheading\n5,1,0\n");
  const RangeLog one = read_range_log(folder.path());
  EXPECT_TRUE(remarks_hold(one, "the first motion is taken to last 1 s."));
  EXPECT_TRUE(remarks_hold(one, "where no method takes them: 1 range."));
  folder.file("odometry.csv", "t,ddist,dheading\n5,1,0\n7,1,0\n");
  EXPECT_TRUE(remarks_hold(read_range_log(folder.path()), "to last 2 s, as the second."));
}

TEST(RangeLogFiles, TrueLandmarksBeyondAnyMapAreRefused) {
  const test::TemporaryFolder folder;
  folder.file("ranges.csv", "t,beacon,range\n5,1,2\n");
  std::string landmarks = "id,x,y\n";
  for (int i = 0; i <= 5000; ++i) landmarks += std::to_string(i) + ",0,0\n";
  folder.file("landmarks.csv", landmarks);
  EXPECT_NE(error_of(folder.path()).find("more than 5000 landmarks"), std::string::npos);
}

TEST(RangeLogFiles, SeveralSendersAreRefused) {
  const test::TemporaryFolder folder;
  const fs::path path = folder.file("a_TD.txt", "1 2 0 5\n2 3 0 5\n");
  EXPECT_EQ(error_of(path),
            "line 2: a measurement of robot 3 after those of robot 2: give the measurements of one "
            "robot");
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

TEST(RangeLogFiles, AreRecognizedByTheirFirstBytes) {
  const test::TemporaryFolder folder;
  const RangeLog log = sample_log();
  test::write_mat(log, folder / "a.mat", true);
  for (const std::string& bytes :
       {read_file(folder / "a.mat"), test::pyfg_of(log), test::ranges_csv_of(log)}) {
    EXPECT_TRUE(shows_ranges(folder.file("log", bytes)));
    EXPECT_EQ(read_range_log(folder / "log").ranges.size(), log.ranges.size());
  }
  EXPECT_EQ(read_range_log(folder.file("log", test::td_text_of(log))).ranges.size(),
            log.ranges.size());
  // Four numbers a row may be detections of a robot as well, and these columns are.
  EXPECT_FALSE(shows_ranges(folder / "log"));
  const std::string both = "time,landmark,range\n1,1,1\n";
  EXPECT_FALSE(shows_ranges(folder.file("log", both)));
  EXPECT_TRUE(shows_ranges(folder.file("ranges.csv", both)));
}

TEST(RangeLogFiles, MayBePacked) {
  const test::TemporaryFolder folder;
  const fs::path set = csv_folder(folder, sample_log());
  const RangeLog plain = read_range_log(set);
  for (const char* name : {"ranges.csv", "odometry.csv", "groundtruth.csv", "landmarks.csv"}) {
    const std::string bytes = read_file(set / name);
    fs::remove(set / name);
    folder.file("set/" + std::string(name) + ".xz", test::xzipped(bytes));
  }
  expect_same(read_range_log(set), plain, 0.0);
  EXPECT_EQ(read_range_log(set / "ranges.csv.xz").name, "set");
  EXPECT_EQ(validate(set).at(0).problem, "");
}

TEST(RangeFiles, OfMatlabThatDeclareMoreThanTheyHoldTakeNoMemoryForIt) {
  const test::TemporaryFolder folder;
  test::write_mat(sample_log(), folder / "a.mat", false);
  std::string bytes = read_file(folder / "a.mat");
  constexpr std::size_t kRowsOfTheFirst = 128 + 8 + 16 + 8;  // Behind header, tag, flags, tag.
  const std::uint32_t rows = 1'000'000;
  std::memcpy(bytes.data() + kRowsOfTheFirst, &rows, sizeof rows);
  EXPECT_EQ(error_of(folder.file("b.mat", bytes)),
            "variable DR: is damaged: too short for 1000000 x 3 numbers");
}

TEST(RangeLogFiles, OtherPathsAreNoRangeLogs) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(is_range_log_folder(folder.path()));
  EXPECT_FALSE(shows_ranges(folder.file("ranges.csv", "name,1,2\na,1,1\n")));
  EXPECT_TRUE(is_range_log_folder(folder.path()));
  // A path that was named is read as what it is called, and the error is the reader's.
  EXPECT_EQ(
      error_of(folder.file("ranges.csv", "t,beacon\n1,1\n")),
      "line 1: no column of ranges: expected range in the header; --columns range=HEADER names "
      "another");
  EXPECT_EQ(error_of(folder / "nothing"), "cannot be opened: No such file or directory");
  EXPECT_EQ(error_of(folder.file("a.mat", "no")), "is not a MATLAB file");
  EXPECT_TRUE(error_of(folder.file("a.csv", "x")).starts_with("holds no ranges"));
}

}  // namespace
}  // namespace mapproof
