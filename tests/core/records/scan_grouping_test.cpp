#include "core/records/detections/scan_grouping.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/records/detections/detection_stream.hpp"
#include "core/records/detections/detections.hpp"
#include "core/records/observations/observation_stream.hpp"
#include "core/records/observations/observations.hpp"
#include "tests/core/records/samples.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

using test::error_of;

/// Scans of a robot, one each 100 ms with pauses, of 1 to 5 landmarks of 8, whose rows have stamps
/// of their own up to `jitter_s` after the scan's.
struct JitteredTable {
  std::string text = "time,landmark,range,bearing\n";
  int scans = 0;
};

JitteredTable jittered(double jitter_s, int scans, std::uint64_t seed) {
  Random random(seed);
  JitteredTable table;
  double time = 1000.0;
  for (int scan = 0; scan < scans; ++scan) {
    time += random.uniform() < 0.05 ? 3.0 : 0.1;
    const int first = static_cast<int>(random.uniform() * 8.0);
    const int count = 1 + static_cast<int>(random.uniform() * 5.0);
    std::vector<double> stamps;
    for (int k = 0; k < count; ++k) stamps.push_back(time + jitter_s * random.uniform());
    std::ranges::sort(stamps);
    for (int k = 0; k < count; ++k)
      table.text += fmt::format("{:.6f},L{},{:.3f},{:.3f}\n", stamps[static_cast<std::size_t>(k)],
                                (first + k) % 8, 1.0 + random.uniform(), random.uniform());
    ++table.scans;
  }
  return table;
}

DetectionSource read_stamped(const std::string& text, std::optional<double> window = {}) {
  const test::TemporaryFolder folder;
  return read_detections(folder.file("a.csv", text), {.scan_window_s = window});
}

TEST(ScanGrouping, RowsSomeMillisecondsApartAreOneScan) {
  for (const double jitter_s : {0.001, 0.004, 0.01}) {
    const JitteredTable table = jittered(jitter_s, 400, 7);
    const DetectionSource source = read_stamped(table.text);
    EXPECT_EQ(source.log.steps, table.scans) << jitter_s;
    ASSERT_EQ(source.remarks.size(), 1U);
    EXPECT_NE(source.remarks[0].find("found from the gaps"), std::string::npos);
  }
}

TEST(ScanGrouping, ScansOfOneStampEachStayAsTheyAre) {
  std::string text = "time,landmark,range,bearing\n";
  double time = 0.0;
  Random random(3);
  for (int scan = 0; scan < 300; ++scan) {
    time += random.uniform() < 0.1 ? 5.0 : 0.1;
    for (int k = 0; k < 3; ++k) text += fmt::format("{:.3f},L{},2,0.1\n", time, (scan + k) % 7);
  }
  const DetectionSource source = read_stamped(text);
  EXPECT_EQ(source.log.steps, 300);
  EXPECT_TRUE(source.remarks.empty());
}

TEST(ScanGrouping, EqualStampsMarkScansWhereMostRowsHaveThem) {
  // As a few clocks do: one scan in ten begins a millisecond after the one before.
  std::string text = "time,landmark,range,bearing\n";
  for (int scan = 0; scan < 300; ++scan)
    for (int k = 0; k < 2; ++k)
      text += fmt::format("{:.3f},L{},2,0.1\n", 0.2 * scan - (scan % 10 == 9 ? 0.199 : 0.0),
                          (2 * scan + k) % 8);
  EXPECT_EQ(read_stamped(text).log.steps, 300);
}

TEST(ScanGrouping, AGivenWindowCounts) {
  const JitteredTable table = jittered(0.004, 100, 5);
  EXPECT_GT(read_stamped(table.text, 0.0).log.steps, table.scans);
  EXPECT_EQ(read_stamped(table.text, 0.05).log.steps, table.scans);
  EXPECT_EQ(scan_window_of("50ms"), 0.05);
  EXPECT_EQ(scan_window_of("0.05"), 0.05);
  EXPECT_EQ(scan_window_of("2s"), 2.0);
  for (const char* text : {"", "ms", "-1", "nan", "inf", "5 parsecs", "4000"})
    EXPECT_THROW(scan_window_of(text), InvalidInput) << text;
}

TEST(ScanGrouping, ALandmarkThatComesAgainBeginsAScan) {
  const DetectionLog log =
      read_stamped("time,landmark,range,bearing\n0,a,1,0\n0.1,b,1,1\n0.2,a,1,0\n0.3,b,1,1\n", 1.0)
          .log;
  EXPECT_EQ(log.steps, 2);
  EXPECT_EQ(log.times_s, (std::vector<double>{0.0, 0.2}));
}

TEST(ScanGrouping, RobotsHaveScansOfTheirOwn) {
  const DetectionLog log = read_stamped(
                               "robot,time,landmark,range,bearing\nA,0,a,1,0\nB,0.001,b,1,1\n"
                               "A,0.002,b,1,1\n",
                               0.01)
                               .log;
  EXPECT_EQ(log.steps, 2);
  EXPECT_EQ(log.detections[1].step, 0);
}

TEST(ScanGrouping, NumberedScansHaveNothingToGroup) {
  for (const char* text : {"step,landmark,range,bearing\n0,a,1,0\n", "0,a,1,0\n"})
    EXPECT_NE(error_of([&] { read_stamped(text, 0.1); }).find("--scan-window"), std::string::npos);
}

TEST(ScanGrouping, AStreamGivesTheScansOfTheFile) {
  const JitteredTable table = jittered(0.004, 300, 11);
  const DetectionLog whole = read_stamped(table.text).log;
  DetectionStream stream("f", {});
  for (std::size_t at = 0; at < table.text.size(); at += 1000)
    stream.take(std::string_view(table.text).substr(at, 1000));
  stream.end();
  const std::vector<StreamedScan> scans = stream.scans();
  ASSERT_EQ(std::ssize(scans), whole.steps);
  std::size_t row = 0;
  for (const StreamedScan& scan : scans)
    for (const Detection& seen : scan.detections)
      EXPECT_EQ(seen.landmark, whole.detections[row++].landmark);
  EXPECT_EQ(stream.remarks().size(), 1U);
}

TEST(ScanGrouping, ValuesOfOneSensorAreGroupedAlike) {
  const JitteredTable table = jittered(0.004, 300, 13);
  std::string values = "time,landmark,value\n";
  for (std::size_t at = table.text.find('\n') + 1; at < table.text.size();) {
    const std::size_t end = table.text.find('\n', at);
    const std::string line = table.text.substr(at, end - at);
    values += line.substr(0, line.rfind(',')) + "\n";
    at = end + 1;
  }
  const ObservationSource source = read_long(values, "f", Sensor::kRange);
  EXPECT_EQ(source.history.steps(), table.scans);
  ObservationStream stream("f", Sensor::kRange);
  stream.take(values);
  stream.end();
  EXPECT_EQ(std::ssize(stream.steps()), table.scans);
}

}  // namespace
}  // namespace mapproof
