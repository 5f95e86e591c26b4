#include "core/follow/incremental_log.hpp"

#include <cmath>

#include "core/base/errors.hpp"

namespace mapproof {

void IncrementalLog::add(const ScanKey& scan, const std::vector<Detection>& detections) {
  if (scan.robot < 0 || scan.robot > std::ssize(robots_) || !std::isfinite(scan.key))
    throw InvalidInput("robots are numbered as they come, and their scans have a step or time");
  if (scan.robot == std::ssize(robots_)) robots_.emplace_back();
  Robot& robot = robots_[static_cast<std::size_t>(scan.robot)];
  if (!robot.keys.empty() && scan.key <= robot.keys.back())
    throw InvalidInput("a robot's scans come in ascending order");
  for (Detection seen : detections) {
    seen.step = static_cast<int>(robot.keys.size());
    robot.detections.push_back(seen);
  }
  robot.keys.push_back(scan.key);
  ++steps_;
}

DetectionLog IncrementalLog::log(const std::vector<std::string>& names, bool is_timed) const {
  DetectionLog log;
  log.names = names;
  log.scans = scans();
  for (const Robot& robot : robots_) {
    for (Detection seen : robot.detections) {
      seen.step += log.steps;
      log.detections.push_back(seen);
    }
    log.steps += static_cast<int>(robot.keys.size());
    if (is_timed) log.times_s.insert(log.times_s.end(), robot.keys.begin(), robot.keys.end());
  }
  return log;
}

std::vector<ScanKey> IncrementalLog::scans() const {
  std::vector<ScanKey> scans;
  for (std::size_t k = 0; k < robots_.size(); ++k)
    for (const double key : robots_[k].keys) scans.push_back({static_cast<int>(k), key});
  return scans;
}

}  // namespace mapproof
