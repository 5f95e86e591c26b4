// Slow: how often a landmark of the real logs, in which nothing moved, is reported as moved, and
// how often a move that was planted is found. Prints the tables of docs/methods/moved-landmarks.md.
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/association/moved.hpp"
#include "core/association/scan_pose.hpp"
#include "core/base/random.hpp"
#include "core/pairs/pair_graph.hpp"
#include "real_scans.hpp"

namespace mapproof::test {
namespace {

struct RealLog {
  std::string name;
  DetectionLog log;
  Points landmarks_m;
};

DetectionLog some_of(DetectionLog log, const std::function<bool(int)>& is_taken) {
  std::erase_if(log.detections, [&](const Detection& seen) { return !is_taken(seen.step); });
  return log;
}

/// A set, each robot's log, and the halves of both.
std::vector<RealLog> logs_of(const std::string& set) {
  std::vector<RealLog> logs;
  const std::optional<DetectionSource> source = real_scans(set);
  if (!source) return logs;
  const DetectionLog& log = source->log;
  const double middle_s = middle_time_s(log);
  for (int robot = -1; robot < static_cast<int>(log.robots.size()); ++robot)
    for (const int half : {0, 1, 2})
      logs.push_back({fmt::format("{}, {}, {}", set,
                                  robot < 0 ? "all robots" : fmt::format("robot {}", robot + 1),
                                  half == 0 ? "whole" : fmt::format("half {}", half)),
                      some_of(log,
                              [&](int step) {
                                const auto k = static_cast<std::size_t>(step);
                                return (robot < 0 || log.scans[k].robot == robot) &&
                                       (half == 0 || (log.times_s[k] < middle_s) == (half == 1));
                              }),
                      *source->ground_truth_m});
  return logs;
}

bool is_alarm(const DetectionLog& log) {
  return !find_moved(log, {.is_contrasted = true}).moved.empty();
}

/// The log with a landmark at another position from a time on: each of its detections is shifted as
/// the other landmarks of the scan determine the robot's heading, by the true positions.
DetectionLog with_move(const RealLog& real, int landmark, const Eigen::RowVector2d& by_m,
                       double from_s) {
  DetectionLog log = real.log;
  for (std::size_t begin = 0, end = 0; begin < log.detections.size(); begin = end) {
    std::vector<Eigen::RowVector2d> mapped;
    std::vector<Eigen::RowVector2d> seen;
    std::size_t own = log.detections.size();
    for (end = begin;
         end < log.detections.size() && log.detections[end].step == log.detections[begin].step;
         ++end) {
      mapped.push_back(real.landmarks_m.row(log.detections[end].landmark));
      seen.push_back(position_observed(log.detections[end]));
      if (log.detections[end].landmark == landmark) own = end;
    }
    if (own == log.detections.size() || mapped.size() < 2 ||
        log.times_s[static_cast<std::size_t>(log.detections[begin].step)] < from_s)
      continue;
    const ScanPose pose(mapped, seen);
    const Eigen::RowVector2d at = real.landmarks_m.row(landmark);
    Detection& moved = log.detections[own];
    const Eigen::RowVector2d now =
        position_observed(moved) + pose.to_robot(at + by_m) - pose.to_robot(at);
    moved.range_m = now.norm();
    moved.bearing_rad = std::atan2(now.y(), now.x());
  }
  return log;
}

/// Detections of a landmark in scans that show others.
int shared_by(const DetectionLog& log, int landmark) {
  std::map<int, int> size;
  for (const Detection& seen : log.detections) ++size[seen.step];
  int count = 0;
  for (const Detection& seen : log.detections)
    count += seen.landmark == landmark && size[seen.step] > 1 ? 1 : 0;
  return count;
}

TEST(MovedInRealLogs, AtMostOneLogInTwentyHasAFalseAlarm) {
  int logs = 0;
  int alarms = 0;
  for (const char* set : {"dataset1", "dataset2", "dataset3", "dataset6"})
    for (const RealLog& real : logs_of(set)) {
      ++logs;
      if (!is_alarm(real.log)) continue;
      ++alarms;
      std::cout << real.name << ": an alarm\n";
    }
  if (logs == 0) GTEST_SKIP() << "MAPPROOF_MRCLAM does not name the folder of the sets";
  std::cout << fmt::format("{} of {} logs have an alarm\n", alarms, logs);
  EXPECT_GE(logs, 60);
  EXPECT_LE(alarms, logs / 20);
}

TEST(MovedInRealLogs, PlantedMovesAreFoundByLengthAndByHowOftenALandmarkIsSeen) {
  struct Count {
    int found = 0;
    int all = 0;
  };
  std::map<std::pair<double, int>, Count> counts;
  Random random(7);
  for (const char* set : {"dataset2", "dataset3"}) {
    const std::vector<RealLog> logs = logs_of(set);
    if (logs.empty()) GTEST_SKIP() << "MAPPROOF_MRCLAM does not name the folder of the sets";
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}, std::size_t{9}})
      for (int landmark = 0; landmark < 15; landmark += 2)
        for (const double length_m : {0.25, 0.5, 1.0}) {
          const double angle = 2.0 * std::numbers::pi * random.uniform();
          const int seen = shared_by(logs[k].log, landmark);
          const DetectionLog moved = with_move(
              logs[k], landmark, length_m * Eigen::RowVector2d(std::cos(angle), std::sin(angle)),
              middle_time_s(logs[k].log));
          bool is_found = false;
          for (const MovedLandmark& one : find_moved(moved, {.is_contrasted = true}).moved)
            is_found = is_found || one.landmark == landmark;
          Count& count = counts[{length_m, seen < 500 ? 0 : seen < 1500 ? 1 : 2}];
          ++count.all;
          count.found += is_found ? 1 : 0;
        }
  }
  for (const auto& [at, count] : counts)
    std::cout << fmt::format("{:.2f} m, seen {}: {} of {}\n", at.first,
                             at.second == 0   ? "below 500"
                             : at.second == 1 ? "500 to 1500"
                                              : "1500 and more",
                             count.found, count.all);
  const Count& best = counts[{1.0, 2}];
  EXPECT_GE(2 * best.found, best.all);
}

}  // namespace
}  // namespace mapproof::test
