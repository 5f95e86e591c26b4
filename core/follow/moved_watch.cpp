#include "core/follow/moved_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/errors.hpp"

namespace mapproof {

void IncrementalLog::add(const ScanKey& scan, const std::vector<Detection>& detections) {
  if (scan.robot < 0 || scan.robot > std::ssize(robots_) || !std::isfinite(scan.key))
    throw InvalidInput("robots are numbered as they appear, and their scans need a step or a time");
  if (scan.robot == std::ssize(robots_)) robots_.emplace_back();
  Robot& robot = robots_[static_cast<std::size_t>(scan.robot)];
  if (!robot.keys.empty() && scan.key <= robot.keys.back())
    throw InvalidInput("a robot's scans must be in ascending order");
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

std::vector<NoticedMove> MovedWatch::check(const IncrementalLog& scans, const DetectionLog& log) {
  ++checks_;
  next_ = log.steps + std::max(1, log.steps / 4);
  MovedOptions options = options_;
  options.level /= static_cast<double>(checks_) * (checks_ + 1);
  const std::vector<ScanKey> all = scans.scans();
  std::vector<NoticedMove> fresh;
  for (const MovedLandmark& found : find_moved(log, options).moved) {
    const NoticedMove now{found, all[static_cast<std::size_t>(found.step)]};
    const auto known = std::ranges::find_if(
        moved_, [&](const NoticedMove& move) { return move.found.landmark == found.landmark; });
    if (known != moved_.end()) {
      *known = now;  // More scans determine the time better.
      continue;
    }
    moved_.push_back(now);
    fresh.push_back(now);
  }
  return fresh;
}

DetectionLog MovedWatch::split(const IncrementalLog& scans, DetectionLog log) const {
  if (moved_.empty()) return log;
  const std::vector<ScanKey> all = scans.scans();
  const bool is_timed = !log.times_s.empty();
  for (const NoticedMove& moved : moved_) {
    const auto fresh = static_cast<int>(log.names.size());
    log.names.push_back(log.names[static_cast<std::size_t>(moved.found.landmark)] + " (moved)");
    for (Detection& seen : log.detections) {
      const ScanKey& scan = all[static_cast<std::size_t>(seen.step)];
      const bool is_later = is_timed ? scan.key >= moved.from.key : scan >= moved.from;
      if (seen.landmark == moved.found.landmark && is_later) seen.landmark = fresh;
    }
  }
  sort_detections(log.detections);
  return log;
}

}  // namespace mapproof
