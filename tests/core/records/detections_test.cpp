#include "core/records/detections/detections.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/records/observations/observation_json.hpp"
#include "core/records/observations/observations.hpp"
#include "tests/core/records/samples.hpp"
#include "tests/support/packing.hpp"
#include "tests/support/samples/scans.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

using test::error_of;

DetectionSource read_text(const std::string& text, const TableFormat& format = {}) {
  const test::TemporaryFolder folder;
  return read_detections(folder.file("a.csv", text), format);
}

bool shows_detections(const std::filesystem::path& path) {
  ByteSource source(path);
  return is_detections(source);
}

/// The error of a text, behind the file's path.
std::string error_with(const std::string& text, const TableFormat& format = {}) {
  const test::TemporaryFolder folder;
  const auto path = folder.file("a.csv", text);
  const std::string error = error_of([&] { read_detections(path, format); });
  const std::string start = path.string() + ": ";
  return error.starts_with(start) ? error.substr(start.size()) : error;
}

void expect_same(const DetectionLog& a, const DetectionLog& b) {
  EXPECT_EQ(a.names, b.names);
  EXPECT_EQ(a.steps, b.steps);
  ASSERT_EQ(a.detections.size(), b.detections.size());
  for (std::size_t k = 0; k < a.detections.size(); ++k) {
    EXPECT_EQ(a.detections[k].step, b.detections[k].step);
    EXPECT_EQ(a.detections[k].landmark, b.detections[k].landmark);
    EXPECT_DOUBLE_EQ(a.detections[k].range_m, b.detections[k].range_m);
    EXPECT_DOUBLE_EQ(a.detections[k].bearing_rad, b.detections[k].bearing_rad);
  }
}

constexpr const char* kPlain =
    "step,landmark,range,bearing\n0,oak,3,0.5\n0,elm,4,-0.5\n7,oak,2.5,1\n";

TEST(Detections, AreRowsOfScans) {
  const DetectionLog log = read_text(kPlain).log;
  EXPECT_EQ(log.names, (std::vector<std::string>{"oak", "elm"}));
  EXPECT_EQ(log.steps, 2);
  ASSERT_EQ(log.detections.size(), 3U);
  EXPECT_EQ(log.detections[1].landmark, 1);
  EXPECT_EQ(log.detections[1].range_m, 4.0);
  EXPECT_EQ(log.detections[2].step, 1);
  EXPECT_TRUE(log.times_s.empty());
}

TEST(Detections, ReadTheSameHoweverPeopleWriteThem) {
  const DetectionLog log = read_text(kPlain).log;
  for (const char* text :
       {"\xEF\xBB\xBFstep,landmark,range,bearing\r\n0,oak,3,0.5\r\n0,elm,4,-0.5\r\n7,oak,2.5,1\r\n",
        "Step;Landmark;Range [m];Bearing [rad]\n0;oak;3;0.5\n0;elm;4;-0.5\n7;oak;2.5;1\n",
        "bearing_rad\tname\tdistance_m\tframe\n0.5\toak\t3\t0\n-0.5\telm\t4\t0\n1\toak\t2.5\t7\n",
        "0,oak,3,0.5\n0,elm,4,-0.5\n7,oak,2.5,1\n",
        "step,landmark,range,bearing\n7,oak,2.5,1\n0,oak,3,0.5\n0,elm,4,-0.5\n",
        "# of the yard\nscan, id, r, theta\n 0, oak, 3, 0.5\n\n0, elm, 4, -0.5\n7, \"oak\", 2.5, "
        "1\n"})
    expect_same(read_text(text).log, log);
}

TEST(Detections, TimesTellTheScansAndAreKept) {
  const DetectionLog log =
      read_text("time,landmark,range,bearing\n1.25,oak,3,0\n1.25,elm,3,1\n2.5,oak,2,0\n").log;
  EXPECT_EQ(log.steps, 2);
  EXPECT_EQ(log.times_s, (std::vector<double>{1.25, 2.5}));
}

TEST(Detections, RobotsHaveScansOfTheirOwn) {
  const DetectionLog log =
      read_text("robot,time,landmark,range,bearing\nA,1,oak,3,0\nB,1,oak,2,0\nA,2,oak,1,0\n").log;
  EXPECT_EQ(log.steps, 3);
  EXPECT_EQ(log.times_s, (std::vector<double>{1, 2, 1}));
}

TEST(Detections, MayLackARangeOrABearing) {
  const DetectionLog log = read_text("step,landmark,range,bearing\n0,oak,,0.5\n0,elm,4,nan\n").log;
  EXPECT_TRUE(std::isnan(log.detections[0].range_m));
  EXPECT_TRUE(std::isnan(log.detections[1].bearing_rad));
}

TEST(Detections, DegreesAreTurnedIntoRadians) {
  const double right = std::numbers::pi / 2.0;
  for (const DetectionSource& source :
       {read_text("step,landmark,range,bearing_deg\n0,oak,3,90\n"),
        read_text("step,landmark,range,angle (deg)\n0,oak,3,90\n"),
        read_text("step,landmark,range,bearing\n0,oak,3,90\n",
                  {.unit = AngleUnit::kDegrees, .value = std::nullopt})})
    EXPECT_DOUBLE_EQ(source.log.detections[0].bearing_rad, right);
  EXPECT_EQ(error_with("step,landmark,range,bearing_deg\n0,oak,3,400\n"),
            "line 2: bearings are in degrees from the heading, within a full turn of 360; got 400");
}

TEST(Detections, ColumnsThatAreNotReadAreRemarked) {
  EXPECT_EQ(read_text("step,landmark,range,bearing,colour\n0,oak,3,0,red\n").remarks,
            (std::vector<std::string>{"Columns that are not read: \"colour\""}));
}

TEST(Detections, NameTheLineThatIsWrong) {
  EXPECT_EQ(error_with("step,landmark,range,bearing\n0,oak,3\n"),
            "line 2: has 3 cells, expected 4");
  EXPECT_EQ(error_with("step,landmark,range,bearing\n0,oak,-3,0\n"),
            "line 2: a range cannot be negative, got -3: is it a bearing?");
  EXPECT_EQ(error_with("step,landmark,range,bearing\nx,oak,3,0\n"),
            "line 2: step: \"x\" is not a number");
  EXPECT_EQ(error_with("step,landmark,range,bearing\n0,oak,3,90\n"),
            "line 2: bearings are in radians from the heading, counter-clockwise, within a full "
            "turn; 90 looks like degrees: "
            "--degrees");
  EXPECT_EQ(error_with("step,landmark,range,bearing\n0,oak,3,0\n1,elm,3,0\n0,oak,4,1\n"),
            "line 4: landmark \"oak\" is in that scan already, on line 2");
  EXPECT_EQ(error_with("step,landmark,range,bearing\n# of 0\n0,elm,3,0\n0,oak,3,0\n0,oak,4,1\n"),
            "line 5: landmark \"oak\" is in that scan already, on line 4");
  EXPECT_EQ(error_with("step,landmark,range\n0,elm,3\n0,oak,3\n1,elm,3\n0,ash,4\n0,oak,4\n"),
            "from line 5 on: landmark \"oak\" is in that scan already, from line 2 on");
  EXPECT_EQ(
      error_with("step,landmark,range,bearing\n0,oak,3,0\n1,,4,1\n"),
      "line 3: a detection without a landmark ID: the data association of scans is not estimated; "
      "leave such rows out");
  EXPECT_EQ(error_with("landmark,range,bearing\noak,3,0\n"),
            "line 1: no column is named step or time: which rows are one scan?");
  EXPECT_EQ(error_with("step,landmark,range [furlong],bearing\n0,oak,3,0\n"),
            "line 1: \"range [furlong]\": a range in that unit is not known; m, cm, mm, km, ft, "
            "inch, s, ms, us, ns, min, h, d, rad or deg");
  EXPECT_EQ(error_with("step,landmark,range,distance\n0,oak,3,0\n"),
            "line 1: two columns hold a range: --columns range=HEADER names the one to read");
  EXPECT_EQ(error_with("step,landmark,range,bearing\n"), "holds a header and no rows");
  EXPECT_EQ(
      error_with("1,2,3\n"),
      "line 1: has 3 cells; a table of detections has a header, or the columns step, landmark, "
      "range, bearing; --columns names others");
}

TEST(Detections, AreTheSameFromJson) {
  Points landmarks(9, 2);
  for (Eigen::Index i = 0; i < 9; ++i)
    landmarks.row(i) << static_cast<double>(i % 3), 0.1 * static_cast<double>(i);
  const DetectionLog log = test::scans_at(landmarks, 40, 4, 3);
  const test::TemporaryFolder folder;
  const std::string text = detections_json(log);
  expect_same(read_detections(folder.file("a.json", text)).log, log);
  expect_same(read_detections(folder.file("a.json.gz", test::gzipped(text))).log, log);
  EXPECT_TRUE(shows_detections(folder / "a.json"));
}

TEST(Detections, JsonMayBeInDegrees) {
  const DetectionSource source = parse_detections(
      R"({"schema": {"name": "mapproof.detections", "version": 1}, "landmarks": ["A"], "unit": "deg",
          "steps": 1, "detections": [[0, 0, null, 180]]})",
      "a.json");
  EXPECT_DOUBLE_EQ(source.log.detections[0].bearing_rad, std::numbers::pi);
}

TEST(Detections, GiveTheObservationsOfOneSensor) {
  const test::TemporaryFolder folder;
  const auto path = folder.file("a.csv.gz", test::gzipped(kPlain));
  EXPECT_TRUE(shows_detections(path));
  const ObservationSource range = read_observations(path, Sensor::kRange);
  Eigen::MatrixXd expected(2, 2);
  expected << 3, 2.5, 4, 0;
  EXPECT_EQ(range.history.values.col(0), expected.col(0));
  EXPECT_TRUE(std::isnan(range.history.values(1, 1)));
  EXPECT_EQ(read_observations(path, Sensor::kVisibility).history.values.sum(), 3.0);
  EXPECT_THROW(read_observations(path, std::nullopt), std::runtime_error);
}

TEST(Detections, TablesOfValuesAreNone) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(shows_detections(folder.file("a.csv", "step,landmark,value\n0,oak,1\n")));
  EXPECT_FALSE(shows_detections(folder.file("b.csv", "name,1,2\noak,1,0\n")));
}

TEST(Observations, InDegreesAreTurnedIntoRadians) {
  const test::TemporaryFolder folder;
  const double right = std::numbers::pi / 2.0;
  const auto wide = folder.file("wide.csv.gz", test::gzipped("oak,90,-90\nelm,0,180\n"));
  const auto longs = folder.file("long.csv", "step,landmark,value\n0,oak,90\n0,elm,0\n");
  for (const auto& path : {wide, longs})
    EXPECT_DOUBLE_EQ(read_observations(path, Sensor::kBearing, {.unit = AngleUnit::kDegrees})
                         .history.values(0, 0),
                     right);
}

}  // namespace
}  // namespace mapproof
