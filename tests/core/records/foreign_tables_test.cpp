// Tables in the spellings of other programs hold the same observations.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/records/detections/detections.hpp"
#include "core/records/observations/landmarks_csv.hpp"
#include "core/records/observations/observations.hpp"
#include "core/records/ranges/range_log_forms.hpp"
#include "core/records/tables/time_text.hpp"
#include "tests/core/records/samples.hpp"

namespace mapproof {
namespace {

using test::error_of;
using test::TemporaryFolder;

ObservationSource values_of(const std::string& bytes, Sensor sensor = Sensor::kRange,
                            const TableFormat& format = {}) {
  const TemporaryFolder folder;
  return read_observations(folder.file("table", bytes), sensor, format);
}

DetectionSource detections_of(const std::string& bytes, const TableFormat& format = {}) {
  const TemporaryFolder folder;
  return read_detections(folder.file("table", bytes), format);
}

/// The error behind the name of the file.
std::string table_error(const std::string& bytes, const TableFormat& format = {}) {
  const std::string error = error_of([&] { values_of(bytes, Sensor::kRange, format); });
  const std::size_t name = error.find("table: ");
  return name == std::string::npos ? error : error.substr(name + 7);
}

/// Three landmarks over four steps; one range is missing.
const Eigen::MatrixXd& expected_ranges() {
  static const Eigen::MatrixXd values =
      (Eigen::MatrixXd(3, 4) << 1.5, 2, kNaN, 4, 0.25, 1, 2, 3, 7, 8, 9, 10).finished();
  return values;
}

void expect_equal(const Eigen::MatrixXd& values, const Eigen::MatrixXd& expected) {
  ASSERT_EQ(values.rows(), expected.rows());
  ASSERT_EQ(values.cols(), expected.cols());
  for (Eigen::Index i = 0; i < expected.size(); ++i) {
    if (std::isnan(expected(i)))
      EXPECT_TRUE(std::isnan(values(i))) << i;
    else
      EXPECT_DOUBLE_EQ(values(i), expected(i)) << i;
  }
}

void expect_ranges(const std::string& bytes, const TableFormat& format = {},
                   const std::vector<std::string>& names = {"door", "desk", "plant"}) {
  SCOPED_TRACE(bytes.substr(0, 80));
  const ObservationSource source = values_of(bytes, Sensor::kRange, format);
  EXPECT_EQ(source.history.names, names);
  expect_equal(source.history.values, expected_ranges());
}

TEST(ForeignTables, OfWindows1252AreReadAndSaidToBe) {
  const ObservationSource wide =
      values_of("name;a;b;c\nT\xFCr;1,5;2;3\nS\xE4ule;4;5;6\n\x80;7;8;9\n");
  EXPECT_EQ(wide.history.names, (std::vector<std::string>{"Tür", "Säule", "€"}));
  EXPECT_EQ(wide.reading.packing, "Windows-1252");
  const DetectionSource list = detections_of("step,landmark,range\n0,T\xFCr,1\n1,T\xFCr,2\n");
  EXPECT_EQ(list.log.names, (std::vector<std::string>{"Tür"}));
  EXPECT_EQ(list.reading.packing, "Windows-1252");
  // Far behind the first block, and in a header's unit.
  std::string late = "step,landmark,range,bearing [\xB0]\n";
  for (int i = 0; i < 20'000; ++i) late += fmt::format("{},L{},1,90\n", i / 3, i % 3);
  EXPECT_NEAR(detections_of(late).log.detections.back().bearing_rad, std::numbers::pi / 2, 1e-12);
  std::string names = "step,landmark,range\n";
  for (int i = 0; i < 200'000; ++i) names += fmt::format("{},L{},1\n", i / 3, i % 3);
  EXPECT_EQ(detections_of(names + "70000,T\xFCr,1\n").log.names.back(), "Tür");
  const TemporaryFolder folder;
  EXPECT_EQ(read_landmarks(folder.file("a.csv", "name,x,y\nT\xFCr,1,2\n")).names[0], "Tür");
}

TEST(ForeignTables, OfUtf8WithABrokenCharacterAreNotTakenForWindows1252) {
  EXPECT_EQ(table_error("name,a,b\nTür,1,2\nT\xFCr,3,4\n"), "line 3: byte 0xFC is not UTF-8");
  // Not defined in Windows-1252 either.
  EXPECT_EQ(table_error("name,a,b\nT\x81r,1,2\n"), "line 2: byte 0x81 is not UTF-8");
}

TEST(ForeignTables, WithTimesAsRowsAreRecognisedByHeaderOrFirstColumn) {
  // A header that names the times, in several languages of programs.
  expect_ranges("time,door,desk,plant\n0,1.5,0.25,7\n1,2,1,8\n2,,2,9\n3,4,3,10\n");
  expect_ranges("Zeit;door;desk;plant\n0;1,5;0,25;7\n1;2;1;8\n2;;2;9\n3;4;3;10\n");
  // pandas' index without a name.
  expect_ranges(",door,desk,plant\n0,1.5,0.25,7.0\n1,2.0,1.0,8.0\n2,,2.0,9.0\n3,4.0,3.0,10.0\n");
  expect_ranges("Unnamed: 0,door,desk,plant\n0,1.5,.25,7\n1,2,1,8\n2,NA,2,9\n3,4,3,10\n");
  expect_ranges(
      "Unnamed: 0\tdoor\tdesk\tplant\n0\t1.5\t.25\t7\n1\t2\t1\t8\n2\tNA\t2\t9\n3\t4\t3\t10\n");
  // Each name in quotes, as by csv.QUOTE_NONNUMERIC.
  expect_ranges(
      "\"Unnamed: 0\",\"door\",\"desk\",\"plant\"\n0,1.5,.25,7\n1,2,1,8\n2,NA,2,9\n3,4,3,10\n");
  // Dates.
  expect_ranges(
      "stamp (UTC),door,desk,plant\n2026-11-03 09:15:00,1.5,0.25,7\n2026-11-03 09:15:01,2,1,8\n"
      "2026-11-03 09:15:02,NaN,2,9\n2026-11-03 09:15:03,4,3,10\n");
  // Without an index the header is of landmarks alone.
  expect_ranges("door,desk,plant\n1.5,0.25,7\n2,1,8\n,2,9\n4,3,10\n");
  // R names the rows, and not their column.
  expect_ranges(
      "\"door\" \"desk\" \"plant\"\n\"1\" 1.5 0.25 7\n\"2\" 2 1 8\n\"3\" NA 2 9\n\"4\" 4 3 10\n");
}

TEST(ForeignTables, WithLandmarksAsRowsStayAsTheyAre) {
  const std::string rows = "door,1.5,2,,4\ndesk,0.25,1,2,3\nplant,7,8,9,10\n";
  expect_ranges(rows);
  expect_ranges("name,a,b,c,d\n" + rows);
  expect_ranges("time,0.1,0.2,0.3,0.4\n" + rows);
  expect_ranges(",0.1,0.2,0.3,0.4\n" + rows);
  expect_ranges(",2026-11-03,2026-11-04,2026-11-05,2026-11-06\n" + rows);
  expect_ranges("t0,t1,t2,t3\n1.5,2,,4\n0.25,1,2,3\n7,8,9,10\n", {}, {"L1", "L2", "L3"});
}

TEST(ForeignTables, OfNumbersAloneAreRefusedIfTheySeemTransposed) {
  std::string tall;
  for (int i = 0; i < 20; ++i) tall += fmt::format("{},{}\n", i % 7 + 0.5, i % 5 + 0.5);
  const std::string error = table_error(tall);
  EXPECT_NE(error.find("20 rows x 2 columns"), std::string::npos) << error;
  EXPECT_NE(error.find("--layout transposed"), std::string::npos) << error;
  EXPECT_EQ(values_of(tall, Sensor::kRange, {.layout = Layout::kTransposed}).history.landmarks(),
            2);
  EXPECT_EQ(values_of(tall, Sensor::kRange, {.layout = Layout::kWide}).history.landmarks(), 20);
  // The same where both the header and the rows count.
  std::string counted = ",0,1,2\n";
  for (int i = 0; i < 20; ++i) counted += fmt::format("{},1,2,3\n", i);
  EXPECT_NE(table_error(counted).find("--layout transposed"), std::string::npos);
  // A first column that ascends over many rows is one of times.
  std::string timed;
  for (int i = 0; i < 20; ++i) timed += fmt::format("{},1,2,3\n", 0.1 * i);
  EXPECT_EQ(values_of(timed, Sensor::kRange, {.layout = Layout::kTransposed}).history.landmarks(),
            3);
}

TEST(ForeignTables, MayWriteMissingValuesInManyWays) {
  for (const char* word :
       {"", "NA", "N/A", "n/a", "#N/A", "<NA>", "null", "None", "nan", "NaN", "-", "NaT"})
    expect_ranges(fmt::format("door,1.5,2,{},4\ndesk,0.25,1,2,3\nplant,7,8,9,10\n", word));
}

TEST(ForeignTables, MayHaveDecimalCommasWhereCommasDoNotSeparate) {
  const std::string rows = "door;1,5;2,0;;4,0\ndesk;0,25;1;2;3\nplant;7;8;9;1,0e1\n";
  expect_ranges(rows);
  std::string tabs = rows;
  std::ranges::replace(tabs, ';', '\t');
  expect_ranges(tabs);
  EXPECT_TRUE(values_of(rows).reading.has_decimal_commas);
  EXPECT_EQ(values_of("a;1.234,5\nb;2\nc;3\n", Sensor::kRange, {.layout = Layout::kWide})
                .history.values(0, 0),
            1234.5);
  expect_ranges("sep=;\n" + rows);
}

TEST(ForeignTables, MayBeUtf16) {
  const std::string text = "name,1,2,3,4\ndoor,1.5,2,,4\ndesk,0.25,1,2,3\nplant,7,8,9,10\n";
  for (const bool is_big : {false, true}) {
    std::string bytes = is_big ? "\xFE\xFF" : "\xFF\xFE";
    for (const char c : text) {
      if (is_big) bytes += '\0';
      bytes += c;
      if (!is_big) bytes += '\0';
    }
    expect_ranges(bytes);
    EXPECT_EQ(values_of(bytes).reading.packing, "UTF-16");
    EXPECT_NE(table_error(bytes.substr(0, bytes.size() - 1)).find("cut off"), std::string::npos);
  }
}

TEST(ForeignTimes, AreTheSameInstantInEverySpelling) {
  const double instant = 1793697300.125;
  for (const char* text :
       {"2026-11-03T09:15:00.125Z", "2026-11-03 09:15:00.125", "2026-11-03T10:15:00.125+01:00",
        "2026-11-03 04:15:00,125-0500", "20261103T091500.125Z", "2026/11/03 09:15:00.125",
        "03.11.2026 09:15:00,125", "03.11.26 09:15:00,125", "03-Nov-2026 09:15:00.125",
        "3 Nov 2026 09:15:00.125", "03 November 2026, 09:15:00.125",
        "Tue, 03 Nov 2026 10:15:00.125 +0100", "Nov 3, 2026 9:15:00.125 AM",
        "Tuesday, November 3, 2026 9:15:00.125 AM", "2026-11-03 9:15:00.125 AM", "2026-11-03 09:15:00.125 UTC", "1793697300.125"})
    EXPECT_NEAR(time_in(text).value_or(kNaN), instant, 1e-6) << text;
  EXPECT_EQ(time_in("13/11/2026"), time_in("11/13/2026"));
  EXPECT_EQ(time_in("09:15:00"), 33300.0);
  EXPECT_EQ(time_in("1970-01-01"), 0.0);
}

TEST(ForeignTimes, ThatMayMeanTwoDaysOrNoneAreRefused) {
  for (const char* text : {"03/11/2026", "2026-02-30", "2026-11-03T25:61", "soon", "12", "1.2.26", "3 Now 2026",
                           "May 5", "Mayday 5, 2026", "31 Feb 2026", "Tue 9 2026", "Tue 09:15",
                           "2026-11-03 09:15:00 Europe/Berlin", "99:99"})
    if (std::string(text) != "12") EXPECT_FALSE(time_in(text).has_value()) << text;
  EXPECT_NE(time_problem("03/11/2026").find("day and month"), std::string::npos);
}

TEST(ForeignTimes, AreScaledByTheirSize) {
  const auto scale = [](std::vector<double> times) { return time_scale(times).seconds; };
  EXPECT_EQ(scale({1.7936973e18, 1.7936973005e18}), 1e-9);
  EXPECT_EQ(scale({1793697300125.0, 1793697300625.0}), 1e-3);
  EXPECT_EQ(scale({1793697300.125, 1793697300.625}), 1.0);
  // 09:15:00 on 3 November 2026 and on, each half a second, as a spreadsheet counts days.
  std::vector<double> days;
  for (int i = 0; i < 6; ++i) days.push_back(46329.0 + (33300.0 + 0.5 * i) / 86400.0);
  EXPECT_EQ(scale(days), 86400.0);
  EXPECT_EQ(scale({46329.1, 46329.22, 46329.31, 46329.4, 46329.5}), 1.0);
}

/// Two landmarks in two scans.
void expect_detections(const std::string& bytes, const TableFormat& format = {},
                       double tolerance = 1e-12) {
  SCOPED_TRACE(bytes.substr(0, 100));
  const DetectionSource source = detections_of(bytes, format);
  EXPECT_EQ(source.log.names, (std::vector<std::string>{"7", "12"}));
  ASSERT_EQ(source.log.steps, 2);
  ASSERT_EQ(source.log.detections.size(), 3U);
  const double ranges[] = {5.0, 2.0, 1.0};
  const double bearings[] = {std::atan2(4.0, 3.0), -std::numbers::pi / 2, 0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(source.log.detections[i].range_m, ranges[i], tolerance) << i;
    EXPECT_NEAR(source.log.detections[i].bearing_rad, bearings[i], tolerance) << i;
  }
}

TEST(ForeignDetections, AreReadByTheNamesThatDetectorsGive) {
  const std::string rows = "0.5,7,5,0.927295218\n0.5,12,2,-1.570796327\n1,7,1,0\n";
  for (const char* header : {"time,tag_id,range,bearing", "t,marker_id,r,theta",
                             "timestamp,Landmark ID,Distance [m],Angle [rad]",
                             "stamp,beacon,dist,azimuth", "Time (s),Tag,range_m,bearing_rad"})
    expect_detections(std::string(header) + "\n" + rows, {}, 1e-8);
  const ColumnNames names = {{ColumnRole::kTime, "Uhr"},
                             {ColumnRole::kLandmark, "Kennung"},
                             {ColumnRole::kRange, "Weite"},
                             {ColumnRole::kBearing, "4"}};
  expect_detections("Uhr,Kennung,Weite,Richtung\n" + rows, {.columns = names}, 1e-8);
  // By number, without a header.
  expect_detections(rows,
                    {.columns = {{ColumnRole::kTime, "1"},
                                 {ColumnRole::kLandmark, "2"},
                                 {ColumnRole::kRange, "3"},
                                 {ColumnRole::kBearing, "4"}}},
                    1e-8);
}

TEST(ForeignDetections, MayBePositionsInTheRobotsFrame) {
  expect_detections("time,id,x,y\n0.5,7,3,4\n0.5,12,0,-2\n1,7,1,0\n");
  expect_detections("time,id,x [cm],y [cm]\n0.5,7,300,400\n0.5,12,0,-200\n1,7,100,0\n");
  // OpenCV's frame: x to the right, z ahead.
  expect_detections(
      "time,marker_id,tvec_x,tvec_y,tvec_z\n0.5,7,-4,0,3\n0.5,12,2,0,0\n1,7,0,0.1,1\n");
}

TEST(ForeignDetections, MayHaveOtherUnitsAndConventions) {
  const std::string degrees = "t,id,range,bearing_deg\n0,7,5,53.13010235\n0,12,2,-90\n1,7,1,0\n";
  expect_detections(degrees, {}, 1e-8);
  expect_detections("t,id,range,bearing\n0,7,5,306.86989765\n0,12,2,90\n1,7,1,0\n",
                    {.unit = AngleUnit::kDegrees, .convention = BearingConvention::kCompass}, 7.0);
  const DetectionSource compass =
      detections_of("t,id,range,bearing\n0,7,5,30\n0,12,2,90\n1,7,1,0\n",
                    {.unit = AngleUnit::kDegrees, .convention = BearingConvention::kCompass});
  EXPECT_NEAR(compass.log.detections[0].bearing_rad - compass.log.detections[1].bearing_rad,
              std::numbers::pi / 3, 1e-12);
}

TEST(ForeignDetections, MayListNothingButWhenALandmarkWasSeen) {
  for (const char* text :
       {"time,tag\n0.5,a\n0.5,b\n1,a\n", "0.5;a\n0.5;b\n1;a\n",
        "2026-11-03T09:15:00Z,a\n2026-11-03T09:15:00Z,b\n2026-11-03T09:15:01Z,a\n",
        ",Frame No,marker id\n0,1,a\n1,1,b\n2,5,a\n"}) {
    SCOPED_TRACE(text);
    const ObservationSource source = values_of(text, Sensor::kVisibility);
    EXPECT_EQ(source.history.names, (std::vector<std::string>{"a", "b"}));
    expect_equal(source.history.values, (Eigen::MatrixXd(2, 2) << 1, 1, 1, 0).finished());
  }
  // A further column may be the measurement: it is asked for.
  EXPECT_NE(error_of([] { detections_of("time,tag,Peilwinkel\n0,a,1\n"); }).find("--columns"),
            std::string::npos);
}

TEST(ForeignDetections, TakeTheStampsOfRosInTwoColumns) {
  const DetectionSource source = detections_of(
      "header.stamp.sec,header.stamp.nanosec,header.frame_id,id,range,bearing\n"
      "1793697300,125000000,camera,7,1,0\n1793697300,625000000,camera,7,1,0\n");
  ASSERT_EQ(source.log.times_s.size(), 2U);
  EXPECT_NEAR(source.log.times_s[1] - source.log.times_s[0], 0.5, 1e-6);
}

TEST(ForeignDetections, MayBeEdgesOfAGraph) {
  expect_detections(
      "VERTEX_SE2 0 0 0 0\nVERTEX_XY 7 3 4\nEDGE_SE2_XY 0 7 3 4 1 0 1\nEDGE_SE2_XY 0 12 0 -2 1 0 "
      "1\n"
      "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2_XY 1 7 1 0 1 0 1\n");
  expect_detections(
      "BR 0 7 0.9272952180016122 5 .1 .1\nBR 0 12 -1.5707963267948966 2 .1 .1\n"
      "BR 1 7 0 1 .1 .1\n");
  EXPECT_NE(error_of([] {
              detections_of("VERTEX_SE2 A0 0 0 0\nEDGE_RANGE A0 L1 1 1\n");
            }).find("mapproof slam"),
            std::string::npos);
}

TEST(ForeignDetections, MayBeJsonInTheUsualForms) {
  for (
      const char* text :
      {// Lines.
       R"({"t":0,"id":7,"range":5,"bearing":0.9272952180016122}
{"t":0,"id":12,"range":2,"bearing":-1.5707963267948966}
{"t":1,"id":7,"range":1,"bearing":0}
)",
       // A list of objects.
       R"([{"id":7,"range":5,"bearing":0.9272952180016122,"t":0},
            {"id":12,"t":0,"range":2,"bearing":-1.5707963267948966},
            {"t":1,"id":7,"range":1,"bearing":0}])",
       // A scan per line, with its detections.
       R"({"t":0,"detections":[{"id":7,"x":3,"y":4},{"id":12,"x":0,"y":-2}]}
{"t":1,"detections":[{"id":7,"x":1,"y":0}]}
{"t":2,"detections":[]}
)",
       // Columns, and pandas' orient="columns" and "split".
       R"({"t":[0,0,1],"id":[7,12,7],"x":[3,0,1],"y":[4,-2,0]})",
       R"({"t":{"0":0,"1":0,"2":1},"id":{"0":7,"1":12,"2":7},"x":{"0":3,"1":0,"2":1},
            "y":{"0":4,"1":-2,"2":0}})",
       R"({"columns":["t","id","x","y"],"index":[0,1,2],"data":[[0,7,3,4],[0,12,0,-2],[1,7,1,0]]})"})
    expect_detections(text);
}

/// An array of NumPy's of format 1.0.
template <typename Value>
std::string npy_of(const char* descr, const Eigen::MatrixXd& values, bool is_fortran,
                   bool is_swapped = false) {
  std::string header =
      fmt::format("{{'descr': '{}', 'fortran_order': {}, 'shape': ({}, {}), }}", descr,
                  is_fortran ? "True" : "False", values.rows(), values.cols());
  while ((header.size() + 11) % 64 != 0) header += ' ';
  header += '\n';
  std::string bytes = "\x93NUMPY";
  bytes += '\x01';
  bytes += '\0';
  bytes += static_cast<char>(header.size() % 256);
  bytes += static_cast<char>(header.size() / 256);
  bytes += header;
  const Eigen::MatrixXd order = is_fortran ? values : Eigen::MatrixXd(values.transpose());
  for (Eigen::Index i = 0; i < order.size(); ++i) {
    const auto value = static_cast<Value>(order(i));
    std::string one(sizeof value, '\0');
    std::memcpy(one.data(), &value, sizeof value);
    if (is_swapped) std::ranges::reverse(one);
    bytes += one;
  }
  return bytes;
}

TEST(NumpyArrays, OfEveryElementAndOrderHoldTheSame) {
  const Eigen::MatrixXd values =
      (Eigen::MatrixXd(3, 4) << 1, 0, 1, 1, 0, 0, 1, 1, 1, 1, 0, 0).finished();
  const auto expect = [&](const std::string& bytes) {
    expect_equal(values_of(bytes, Sensor::kVisibility).history.values, values);
  };
  for (const bool is_fortran : {false, true}) {
    expect(npy_of<double>("<f8", values, is_fortran));
    expect(npy_of<double>(">f8", values, is_fortran, true));
    expect(npy_of<float>("<f4", values, is_fortran));
    expect(npy_of<float>(">f4", values, is_fortran, true));
    expect(npy_of<std::int64_t>("<i8", values, is_fortran));
    expect(npy_of<std::int32_t>(">i4", values, is_fortran, true));
    expect(npy_of<std::int16_t>("<i2", values, is_fortran));
    expect(npy_of<std::int8_t>("|i1", values, is_fortran));
    expect(npy_of<std::uint64_t>("<u8", values, is_fortran));
    expect(npy_of<std::uint8_t>("|u1", values, is_fortran));
    expect(npy_of<bool>("|b1", values, is_fortran));
  }
  expect_equal(values_of(npy_of<double>("<f8", expected_ranges(), false)).history.values,
               expected_ranges());
}

TEST(NumpyArrays, ThatAreCutOrOfOtherElementsAreRefusedByName) {
  for (const auto& [rows, columns] : {std::pair(4, 0), std::pair(0, 5)})
    EXPECT_EQ(table_error(npy_of<std::int64_t>("<i8", Eigen::MatrixXd(rows, columns), false)),
              fmt::format("a NumPy array of {} x {} holds no number", rows, columns));
  const std::string bytes = npy_of<double>("<f8", expected_ranges(), false);
  for (std::size_t length = 6; length < bytes.size(); ++length)
    EXPECT_NE(table_error(bytes.substr(0, length)), "no error") << length;
  EXPECT_NE(table_error(npy_of<double>("<c8", expected_ranges(), false)).find("\"<c8\""),
            std::string::npos);
  for (const char* type : {"|O8", ">", ""})  // Without a type: found by the fuzzer.
    EXPECT_NE(table_error(npy_of<double>(type, expected_ranges(), false)).find("astype"),
              std::string::npos);
  std::string records = npy_of<double>("<f8", expected_ranges(), false);
  records.replace(records.find("'<f8'"), 5, "[('t','<f8')]");
  records[8] = static_cast<char>(records[8] + 8);
  EXPECT_NE(table_error(records).find("pandas.DataFrame(array).to_csv"), std::string::npos);
}

TEST(NumpyArchives, ThatStateMoreThanTheirBytesCanHoldAreRefusedAtOnce) {
  std::string bytes = read_file(test::data_file("foreign/numpy_columns.npz"));
  constexpr std::size_t kSizeInEntry = 24;  // Of the directory at the end of the archive.
  const std::uint32_t stated = 1'700'000'000;
  std::memcpy(bytes.data() + bytes.find("PK\x01\x02") + kSizeInEntry, &stated, sizeof stated);
  EXPECT_EQ(table_error(bytes), "unpacks to more than 300 times its size: no table does");
  const std::uint32_t harmless = 1'000'000;
  std::memcpy(bytes.data() + bytes.find("PK\x01\x02") + kSizeInEntry, &harmless, sizeof harmless);
  EXPECT_EQ(table_error(bytes), "the archive of NumPy arrays is damaged");
}

TEST(OtherFiles, AreNamedWithWhatConvertsThem) {
  const auto expect = [](const std::string& bytes, const std::string& name,
                         const std::string& remedy) {
    const std::string error = table_error(bytes);
    EXPECT_NE(error.find(name), std::string::npos) << error;
    EXPECT_NE(error.find(remedy), std::string::npos) << error;
  };
  const std::string zip("PK\x03\x04\x14\0", 6);
  expect(zip + "[Content_Types].xml ... xl/workbook.xml", "Excel workbook", "CSV UTF-8");
  expect(zip + "mimetypeapplication/vnd.oasis.opendocument.spreadsheet", "OpenDocument", "CSV");
  expect(zip + "a.csv", "ZIP archive", "unzip");
  expect(std::string("\x89HDF\r\n\x1a\n\0", 9), "HDF5", "Python");
  expect(std::string("PAR1\x15\x04\0", 7), "Parquet", "read_parquet");
  expect(std::string("\x80\x04\x95\0", 4), "pickle", "numpy.save");
  expect(std::string("%PDF-1.7\n"), "PDF", "pdftotext");
  expect(std::string("\x89PNG\r\n\x1a\n\0\0", 10), "PNG", "data");
  expect(std::string("SQLite format 3\0\x10", 17), "SQLite", "sqlite3 -csv");
  expect(std::string("#ROSBAG V2.0\n\x45\0\0", 16), "ROS 1", "rostopic");
  expect(std::string("\x89MCAP0\r\n\x01\0", 10), "MCAP", "mcap_to_csv.py");
  expect(std::string("MATLAB 7.3 MAT-file, \0\2", 23), "MATLAB 7.3", "writematrix");
  expect(std::string("<?xml version=\"1.0\"?><gnm:Workbook xmlns=\"gnumeric\">"), "Gnumeric",
         "ssconvert");
  // Text that only begins as one of them is a table.
  EXPECT_EQ(values_of("PAR1,1,2\nPAR2,1,2\nPAR3,1,2\n", Sensor::kRange, {.layout = Layout::kWide})
                .history.names[0],
            "PAR1");
}

TEST(ForeignLandmarks, MayHaveOtherHeadersAndSpellings) {
  for (const char* text :
       {"tag_id;x [cm];y [cm]\na;150;25\nb;200;100\n", "a 1.5 0.25\nb 2 1\n",
        "name;x;y\na;1,5;0,25\nb;2;1\n", "X,Y,Landmark ID,note\n1.5,0.25,a,x\n2,1,b,y\n"}) {
    SCOPED_TRACE(text);
    const TemporaryFolder folder;
    const NamedPoints points = read_landmarks(folder.file("l", text));
    EXPECT_EQ(points.names, (std::vector<std::string>{"a", "b"}));
  }
}

TEST(ForeignPaths, OfTumAndKittiAreTheSamePath) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& text, const Eigen::VectorXd& times_s) {
    ByteSource source(folder.file("path.txt", text));
    EXPECT_TRUE(is_path_text(source));
    return read_path_text(source, times_s);
  };
  // A quarter turn to the left, after two metres ahead.
  const double half = std::sqrt(0.5);
  const Trajectory tum =
      read(fmt::format(
               "# t x y z qx qy qz qw\n0 0 0 0 0 0 0 1\n1 2 0 0 0 0 {0} {0}\n2 2 3 0 0 0 {0} {0}\n",
               half),
           {});
  const Eigen::Vector3d times(0.0, 1.0, 2.0);
  const Trajectory kitti =
      read("1 0 0 0 0 1 0 0 0 0 1 0\n0 -1 0 2 1 0 0 0 0 0 1 0\n0 -1 0 2 1 0 0 3 0 0 1 0\n", times);
  // The same in a camera's frame: x to the right, y down, z ahead.
  const Trajectory camera =
      read("1 0 0 0 0 1 0 0 0 0 1 0\n0 0 -1 0 0 1 0 0 1 0 0 2\n0 0 -1 -3 0 1 0 0 1 0 0 2\n", times);
  for (const Trajectory& path : {kitti, camera}) {
    EXPECT_TRUE(path.positions_m.isApprox(tum.positions_m, 1e-12));
    EXPECT_TRUE(path.heading_rad.isApprox(tum.heading_rad, 1e-12));
    EXPECT_EQ(path.time_s, tum.time_s);
  }
  EXPECT_NE(error_of([&] { read("1 0 0 0 0 1 0 0 0 0 1 0\n", times); }).find("times.txt"),
            std::string::npos);
}

}  // namespace
}  // namespace mapproof
