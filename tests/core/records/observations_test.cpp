#include "core/records/observations/observations.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/records/detections/detections.hpp"
#include "core/records/observations/observation_json.hpp"
#include "tests/core/records/samples.hpp"

namespace mapproof {
namespace {

using test::data_file;
using test::error_of;
using test::TemporaryFolder;

ObservationSource read_text(const std::string& text, Sensor sensor, Layout layout = Layout::kAuto) {
  const TemporaryFolder folder;
  return read_observations(folder.file("o.csv", text), sensor, {.layout = layout});
}

/// The error behind the path.
std::string error_with(const std::string& text, Sensor sensor, Layout layout = Layout::kAuto) {
  const TemporaryFolder folder;
  const std::string path = folder.file("o.csv", text).string();
  const std::string error = error_of([&] { read_observations(path, sensor, {.layout = layout}); });
  return error.starts_with(path + ": ") ? error.substr(path.size() + 2) : error;
}

void expect_values(const ObservationHistory& history, const Eigen::MatrixXd& expected) {
  ASSERT_EQ(history.values.rows(), expected.rows());
  ASSERT_EQ(history.values.cols(), expected.cols());
  for (Eigen::Index i = 0; i < expected.rows(); ++i)
    for (Eigen::Index j = 0; j < expected.cols(); ++j)
      if (std::isnan(expected(i, j)))
        EXPECT_TRUE(std::isnan(history.values(i, j))) << i << " " << j;
      else
        EXPECT_EQ(history.values(i, j), expected(i, j)) << i << " " << j;
}

TEST(WideObservations, AreReadWithNamesHeaderAndComments) {
  const ObservationSource source =
      read_observations(data_file("observations/wide_named.csv"), Sensor::kVisibility);
  EXPECT_EQ(source.history.names,
            (std::vector<std::string>{"door", "window", "desk, left", "shelf"}));
  EXPECT_EQ(source.locations[2], "line 5");
  Eigen::MatrixXd expected(4, 5);
  expected << 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, kNaN, 1, 0, 0, 1, 1;
  expect_values(source.history, expected);
}

TEST(WideObservations, AreNamedByTheirRowsWithoutNames) {
  const ObservationSource source =
      read_observations(data_file("observations/wide_plain.csv"), Sensor::kVisibility);
  EXPECT_EQ(source.history.names, (std::vector<std::string>{"L1", "L2", "L3", "L4"}));
  Eigen::MatrixXd expected(4, 4);
  expected << 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 1, 1, 0, kNaN, 1;
  expect_values(source.history, expected);
}

TEST(WideObservations, MayBeSeparatedBySemicolonsWithWindowsLineEnds) {
  const ObservationSource source =
      read_observations(data_file("observations/wide_semicolon.csv"), Sensor::kBearing);
  EXPECT_EQ(source.history.names, (std::vector<std::string>{"A", "B", "C"}));
  Eigen::MatrixXd expected(3, 3);
  expected << 0.5, -1.25, 3.1, kNaN, 0.75, -3.1, 1e-3, 2, kNaN;
  expect_values(source.history, expected);
}

TEST(WideObservations, MayBeSeparatedByTabsUnderNumberedSteps) {
  const ObservationSource source =
      read_observations(data_file("observations/wide_tabs.tsv"), Sensor::kRange);
  EXPECT_EQ(source.history.names, (std::vector<std::string>{"red", "green", "blue"}));
  Eigen::MatrixXd expected(3, 3);
  expected << 2.5, 1.5, kNaN, kNaN, 0.25, 4, 3, 3.5, 1;
  expect_values(source.history, expected);
}

TEST(WideObservations, KeepNumbersAsNamesUnderAHeaderThatSaysSo) {
  const ObservationSource source = read_text("id,a,b\n6,0,1\n20,1,1\n", Sensor::kVisibility);
  EXPECT_EQ(source.history.names, (std::vector<std::string>{"6", "20"}));
}

TEST(WideObservations, KeepHostileNamesAsTheyAre) {
  const std::string name = "<script>\"\n\xE2\x80\xAE=1+1";
  const ObservationSource source =
      read_text("\"<script>\"\"\n\xE2\x80\xAE=1+1\",0,1\n" + std::string(10'000, 'a') + ",1,0\n",
                Sensor::kVisibility);
  EXPECT_EQ(source.history.names[0], name);
  EXPECT_EQ(source.history.names[1].size(), 10'000U);
  EXPECT_EQ(source.locations[1], "line 3");
}

TEST(WideObservations, NameTheLineAndCountsOfARaggedRow) {
  EXPECT_EQ(error_with("a,0,1\nb,0\n", Sensor::kVisibility),
            "line 2: has 2 cells where line 1 has 3");
}

TEST(WideObservations, NameTheCellThatIsWrong) {
  EXPECT_EQ(error_with("a,0,1\nb,0,2\n", Sensor::kVisibility),
            "line 2, column 3: visibility is 0 or 1, got 2");
  EXPECT_EQ(error_with("0.5,180\n", Sensor::kBearing),
            "line 1, column 2: bearings are in radians from the heading, counter-clockwise, "
            "within a full turn; 180 looks like degrees: "
            "--degrees");
  EXPECT_EQ(error_with("a,-1\n", Sensor::kRange),
            "line 1, column 2: a range cannot be negative, got -1: is it a bearing?");
  EXPECT_EQ(error_with("a,1,inf\n", Sensor::kRange), "line 1, column 3: an infinite value");
  EXPECT_EQ(error_with("a,1,x1\n", Sensor::kRange), "line 1, column 3: \"x1\" is not a number");
  EXPECT_EQ(error_with("a,1,\"1,5\"\n", Sensor::kRange),
            "line 1, column 3: \"1,5\" is not a number: the decimal separator is a point");
}

TEST(WideObservations, NameBothLinesOfARepeatedName) {
  EXPECT_EQ(error_with("a,0,1\n\nb,0,1\na,1,1\n", Sensor::kVisibility),
            "line 4: landmark \"a\" is already on line 1");
}

TEST(WideObservations, RefuseWhatHoldsNoRows) {
  EXPECT_EQ(error_with("", Sensor::kRange), "is empty");
  EXPECT_EQ(error_with("# nothing\n\n", Sensor::kRange), "holds no rows");
  EXPECT_EQ(error_with("name,s1,s2\n", Sensor::kRange), "holds a header and no rows");
}

TEST(WideObservations, RefuseBrokenQuotesAndBytes) {
  EXPECT_EQ(error_with("a,0,1\n\"b,0,1\nc,0,1\n", Sensor::kVisibility),
            "line 2: a cell in quotes does not end");
  EXPECT_EQ(error_with("\"a\"b,0,1\n", Sensor::kVisibility),
            "line 1: text behind a closing quote: \"b\"");
  EXPECT_EQ(error_with("a,0,1\nb\x81,0,1\n", Sensor::kVisibility),
            "line 2: byte 0x81 is not UTF-8");
  EXPECT_EQ(error_with(std::string("a,0,1\nb,\0,1\n", 12), Sensor::kVisibility),
            "line 2: holds a NUL byte: not a text file");
}

TEST(WideObservations, TakeTimeInProportionToTheirSizeWithNamesInQuotes) {
  std::string text = "\"a\"";
  for (int i = 0; i < 300'000; ++i) text += ",0";
  EXPECT_EQ(read_text(text + "\n", Sensor::kVisibility).history.steps(), 300'000);
}

TEST(WideObservations, GiveOneShortLineForANumberOfAMillionDigits) {
  const std::string error = error_with("a,1," + std::string(1'000'000, '9') + "\n", Sensor::kRange);
  EXPECT_NE(error.find("is beyond what a double holds"), std::string::npos);
  EXPECT_LT(error.size(), 120U);
}

TEST(WideObservations, RefuseATableThatShouldBeTurned) {
  std::string text;
  for (int i = 0; i < 5001; ++i) text += "0,1\n";
  EXPECT_NE(error_with(text, Sensor::kVisibility).find("--layout transposed"), std::string::npos);
  EXPECT_EQ(read_text(text, Sensor::kVisibility, Layout::kWide).history.landmarks(), 5001);
}

TEST(LongObservations, AreReadByTheNamesOfTheirColumns) {
  const ObservationSource source =
      read_observations(data_file("observations/long.csv"), Sensor::kBearing);
  EXPECT_EQ(source.history.names, (std::vector<std::string>{"oak", "ash", "elm"}));
  Eigen::MatrixXd expected(3, 3);
  expected << 0.5, 0.75, kNaN, -0.5, kNaN, 1.5, kNaN, kNaN, -2;
  expect_values(source.history, expected);
  EXPECT_TRUE(source.remarks.empty());
  EXPECT_EQ(source.locations[2], "line 5");
}

TEST(LongObservations, OfDetectionsAloneTakeTheRestAsNotSeen) {
  const ObservationSource source =
      read_observations(data_file("observations/long_detections.csv"), Sensor::kVisibility,
                        {.layout = Layout::kLong});
  Eigen::MatrixXd expected(3, 3);
  expected << 1, 1, 0, 1, 0, 1, 0, 1, 0;
  expect_values(source.history, expected);
  ASSERT_EQ(source.remarks.size(), 1U);
  EXPECT_NE(source.remarks[0].find("not seen"), std::string::npos);
}

TEST(LongObservations, NameBothLinesOfARepeat) {
  EXPECT_EQ(error_with("step,landmark,value\n1,a,0\n2,a,1\n2,b,1\n1,a,1\n", Sensor::kVisibility),
            "line 5: landmark \"a\" at step 1 is already on line 2");
}

TEST(LongObservations, AreReadAlikeByStepOrByTime) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& text) {
    return read_observations(folder.file("o.csv", text), Sensor::kBearing);
  };
  const ObservationSource steps = read("step,landmark,value\n3,a,0.5\n-1,b,1\n3,b,2\n");
  const ObservationSource times =
      read("Time [s],object,value,note\n1e9,a,0.5,x\n999999999.25,b,1,y\n1e9,b,2,z\n");
  Eigen::MatrixXd expected(2, 2);
  expected << kNaN, 0.5, 1, 2;
  expect_values(steps.history, expected);
  expect_values(times.history, expected);
  EXPECT_TRUE(steps.remarks.empty());
  EXPECT_EQ(times.remarks, std::vector<std::string>{"Columns that are not read: \"note\""});
}

TEST(LongObservations, WithoutAHeaderMayNameALandmarkAsAColumnIs) {
  const TemporaryFolder folder;
  const auto path = folder.file("o.csv", "0,r,1\n0,value,2\n");
  const ObservationSource source =
      read_observations(path, Sensor::kRange, {.layout = Layout::kLong});
  EXPECT_EQ(source.history.names, (std::vector<std::string>{"r", "value"}));
}

TEST(LongObservations, OfSeveralRobotsAreScansOfTheirOwn) {
  const TemporaryFolder folder;
  const auto path = folder.file("o.csv",
                                "robot,time,landmark,value\n"
                                "R1,0.5,a,1\nR2,0.5,a,2\nR1,0.25,b,3\n");
  Eigen::MatrixXd expected(2, 3);
  expected << kNaN, 1, 2, 3, kNaN, kNaN;
  expect_values(read_observations(path, Sensor::kRange).history, expected);
}

TEST(LongObservations, AreReadAsALongStreamReadsThem) {
  const TemporaryFolder folder;
  const auto path = folder.file("o.csv",
                                "stamp,tag,value,robot\n"
                                "7.5,oak,1.5,x\n-2,ash,2.5,x\n7.5,ash,0.5,y\n8,oak,3,y\n");
  const DetectionSource stream =
      read_detections(path, {.unit = AngleUnit::kRadians, .value = Sensor::kBearing});
  const ObservationSource whole = read_observations(path, Sensor::kBearing);
  EXPECT_EQ(whole.history.names, stream.log.names);
  expect_values(whole.history, history_of(stream.log, Sensor::kBearing).values);
}

TEST(LongObservations, RefuseOtherColumnsAndEmptyNames) {
  EXPECT_EQ(error_with("landmark,value\na,0\n", Sensor::kVisibility),
            "line 1: no column is named step or time: which rows are one scan?");
  EXPECT_EQ(error_with("step,landmark,value\nnoon,a,0\n", Sensor::kVisibility),
            "line 2: step: \"noon\" is not a number");
  EXPECT_EQ(error_with("step,landmark,value\n1,,0\n", Sensor::kVisibility),
            "line 2: a landmark without a name");
  EXPECT_EQ(error_with("step,landmark,value\n1,a\n", Sensor::kVisibility),
            "line 2: has 2 cells, expected 3");
  EXPECT_EQ(error_with("step,landmark,value\n", Sensor::kVisibility), "holds no observations");
}

TEST(JsonObservations, NameTheirOwnSensorAndComeBackTheSame) {
  const auto path = data_file("observations/observations.json");
  const ObservationSource source = read_observations(path, std::nullopt);
  EXPECT_EQ(source.history.sensor, Sensor::kBearing);
  Eigen::MatrixXd expected(3, 4);
  expected << 0.5, kNaN, -1.5, 3, -0.25, 1.75, kNaN, 0.125, 2.5, -2.5, 0, kNaN;
  expect_values(source.history, expected);
  EXPECT_EQ(source.locations[1], "/values/1");
  const TemporaryFolder folder;
  const auto again = folder.file("again.json", observations_json(source.history));
  expect_values(read_observations(again, Sensor::kBearing).history, expected);
  EXPECT_EQ(error_of([&] { read_observations(path, Sensor::kRange); }),
            path.string() + ": /sensor: the file holds bearing, not range");
}

TEST(JsonObservations, NameThePlaceOfWhatIsWrong) {
  const auto error = [](const std::string& values) {
    const TemporaryFolder folder;
    const std::string path =
        folder
            .file("o.json", R"({"schema": {"name": "mapproof.observations", "version": 1},
            "sensor": "visibility", "landmarks": ["a", "b"], "values": )" +
                                values + "}")
            .string();
    return error_of([&] { read_observations(path, std::nullopt); }).substr(path.size() + 2);
  };
  EXPECT_EQ(error("[[0, 1], [1, 0.5]]"), "/values/1/1: visibility is 0 or 1, got 0.5");
  EXPECT_EQ(error("[[0, 1], [1]]"), "/values/1: expected 2 elements, got 1");
  EXPECT_EQ(error("[[0, 1]]"), "/values: expected 2 rows, one per landmark, got 1");
  EXPECT_EQ(error("[[], []]"), "/values/0: expected at least 1 elements, got 0");
  EXPECT_EQ(error("[[0, \"1\"], [0, 1]]"), "/values/0/1: expected a number, got \"1\"");
}

TEST(Observations, AskForTheKindThatATableDoesNotTell) {
  EXPECT_NE(error_of([] {
              read_observations(data_file("observations/wide_plain.csv"), std::nullopt);
            }).find("--sensor bearing (radians"),
            std::string::npos);
}

TEST(Observations, RefuseWhatIsNotThere) {
  const TemporaryFolder folder;
  EXPECT_EQ(error_of([&] { read_observations(folder / "no.csv", Sensor::kRange); }),
            (folder / "no.csv").string() + ": cannot be opened: No such file or directory");
  EXPECT_EQ(error_of([&] { read_observations(folder.path(), Sensor::kRange); }),
            folder.path().string() + ": is a folder without MRCLAM's RobotN_Measurement.dat");
}

}  // namespace
}  // namespace mapproof
