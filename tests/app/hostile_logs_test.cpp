// Logs of ranges that no path or no map should come of, by every kind of range-only SLAM.
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/child_process.hpp"
#include "core/base/files/files.hpp"
#include "tests/app/range_logs.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

struct HostileLog {
  std::string name;
  std::function<void(RangeLog&)> change;
};

std::ostream& operator<<(std::ostream& out, const HostileLog& one) { return out << one.name; }

void scale_ranges(RangeLog& log, double factor) {
  for (RangeMeasurement& one : log.ranges) one.range_m *= factor;
}

std::vector<HostileLog> hostile_logs() {
  return {{"AllRangesZero", [](RangeLog& log) { scale_ranges(log, 0.0); }},
          {"TinyRanges", [](RangeLog& log) { scale_ranges(log, 1e-300); }},
          {"DenormalRanges", [](RangeLog& log) { scale_ranges(log, 5e-324); }},
          {"FarRanges", [](RangeLog& log) { scale_ranges(log, 1e4); }},
          {"HugeRanges", [](RangeLog& log) { scale_ranges(log, 1e300); }},
          {"EqualRanges",
           [](RangeLog& log) {
             for (RangeMeasurement& one : log.ranges) one.range_m = 7.0;
           }},
          {"OneRange", [](RangeLog& log) { log.ranges.resize(1); }},
          {"TwoRanges", [](RangeLog& log) { log.ranges.resize(2); }},
          {"EveryRangeTwice",
           [](RangeLog& log) {
             const std::vector<RangeMeasurement> once = log.ranges;
             log.ranges.clear();
             for (const RangeMeasurement& one : once) log.ranges.insert(log.ranges.end(), 2, one);
           }},
          {"LandmarksInOnePlace",
           [](RangeLog& log) {
             for (RangeMeasurement& one : log.ranges) one.range_m = 5.0 + 0.01 * one.time_s;
             log.true_landmarks->rowwise() = log.true_landmarks->row(0).eval();
           }},
          {"LandmarksOnALine", [](RangeLog& log) { log.true_landmarks->col(1).setZero(); }},
          {"RobotStandsStill",
           [](RangeLog& log) {
             for (Motion& one : log.odometry)
               one.distance_m = one.heading_change_rad = one.sideways_m = 0.0;
           }},
          {"RobotDrivesStraight",
           [](RangeLog& log) {
             for (Motion& one : log.odometry) one.heading_change_rad = 0.0;
           }},
          {"RobotSpins",
           [](RangeLog& log) {
             for (Motion& one : log.odometry) one.heading_change_rad = 3.0, one.distance_m = 0.0;
           }},
          {"RobotJumps", [](RangeLog& log) { log.odometry[50].distance_m = 1e5; }},
          {"TinyMotions",
           [](RangeLog& log) {
             for (Motion& one : log.odometry)
               one.distance_m *= 1e-300, one.heading_change_rad *= 1e-300;
           }},
          {"OneMotion", [](RangeLog& log) { log.odometry.resize(1); }},
          {"TimesNearlyEqual",
           [](RangeLog& log) {
             for (RangeMeasurement& one : log.ranges) one.time_s *= 1e-12;
             for (Motion& one : log.odometry) one.time_s *= 1e-12;
             log.ground_truth->time_s *= 1e-12;
           }},
          {"LongAgo", [](RangeLog& log) {
             for (RangeMeasurement& one : log.ranges) one.time_s += 1.7e9;
             for (Motion& one : log.odometry) one.time_s += 1.7e9;
             log.start.time_s += 1.7e9;
             log.ground_truth->time_s.array() += 1.7e9;
           }}};
}

class HostileLogs : public ::testing::TestWithParam<HostileLog> {};

TEST_P(HostileLogs, GiveAPathOrAReasonInWords) {
  const TemporaryFolder folder;
  RangeLog log = drive_log();
  GetParam().change(log);
  write_log(log, folder / "log");
  const Outcome outcome = mapproof({"slam", folder / "log", "--out", folder / "out", "--json"});
  ASSERT_TRUE(outcome.exit_code >= 0 && outcome.exit_code <= 2)
      << outcome.exit_code << outcome.error;
  if (outcome.exit_code == 2) {
    EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
    EXPECT_FALSE(fs::exists(folder / "out"));
    return;
  }
  if (outcome.exit_code == 1) {
    const std::string last = last_line(outcome.error);
    EXPECT_TRUE(last.starts_with("mapproof: " + (folder / "log").string() + ": no map was made: "))
        << last;
    EXPECT_EQ(last.find("no method gave one"), std::string::npos) << last;
  }
  const nlohmann::json result = nlohmann::json::parse(outcome.out);
  EXPECT_FALSE(result.at("methods").empty());
  EXPECT_EQ(mapproof({"validate", folder / "out"}).exit_code, 0);
  const std::string report = read_file(folder / "out/report.html");
  for (const char* words : {">nan", ">-nan", ">inf", ">-inf", " nan m", " inf m"})
    EXPECT_EQ(report.find(words), std::string::npos) << words;
}

INSTANTIATE_TEST_SUITE_P(Slam, HostileLogs, ::testing::ValuesIn(hostile_logs()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace mapproof::test
