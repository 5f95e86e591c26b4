#include "core/follow/moved_watch.hpp"

#include <algorithm>
#include <utility>

namespace mapproof {

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
      *known = now;  // More scans tell the time better.
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
