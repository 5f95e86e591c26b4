#include "real_scans.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <set>

#include "core/align/rigid.hpp"
#include "core/base/random.hpp"
#include "core/pairs/pair_map.hpp"
#include "core/records/detections/mrclam.hpp"
#include "noisy_scans.hpp"

namespace mapproof::test {
namespace {

/// The log without detections of one landmark in scans that another is in too: under one ID both
/// are one.
DetectionLog without(DetectionLog log, int landmark, int other,
                     const std::function<bool(int)>& in_step) {
  std::set<int> taken;
  for (const Detection& seen : log.detections)
    if (seen.landmark == other && in_step(seen.step)) taken.insert(seen.step);
  std::erase_if(log.detections, [&](const Detection& seen) {
    return seen.landmark == landmark && taken.contains(seen.step);
  });
  return log;
}

}  // namespace

std::optional<DetectionSource> real_scans(const std::string& set) {
  const char* folder = std::getenv("MAPPROOF_MRCLAM");
  if (folder == nullptr) return std::nullopt;
  return read_mrclam_detections(std::filesystem::path(folder) / set);
}

std::vector<int> robots_of(const DetectionLog& log) {
  std::vector<int> robots;
  for (std::size_t k = 0; k < log.times_s.size(); ++k) {
    const bool next = k > 0 && log.times_s[k] < log.times_s[k - 1];
    robots.push_back(k == 0 ? 0 : robots.back() + (next ? 1 : 0));
  }
  return robots;
}

double middle_time_s(const DetectionLog& log) {
  std::vector<double> times = log.times_s;
  const auto middle = times.begin() + std::ssize(times) / 2;
  std::ranges::nth_element(times, middle);
  return *middle;
}

int shared_detections(const DetectionLog& log, const std::vector<int>& robots, int robot,
                      int landmark) {
  int count = 0;
  const std::vector<Detection>& rows = log.detections;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].landmark != landmark || robots[static_cast<std::size_t>(rows[k].step)] != robot)
      continue;
    const bool shared = (k > 0 && rows[k - 1].step == rows[k].step) ||
                        (k + 1 < rows.size() && rows[k + 1].step == rows[k].step);
    count += shared ? 1 : 0;
  }
  return count;
}

DetectionLog with_fault(const DetectionLog& log, const std::string& kind, int first, int second,
                        std::uint64_t seed) {
  std::vector<double> times = log.times_s;
  std::ranges::sort(times);
  const auto quantile = [&](double share) {
    return times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1))];
  };
  const double share = kind == "half" ? 0.5 : kind == "tenth" ? 0.1 : 0.3;
  Random random(seed);
  std::vector<char> at_random;
  for (int step = 0; step < log.steps; ++step)
    at_random.push_back(random.uniform(0.0, 1.0) < share ? 1 : 0);
  const bool in_time = kind == "stretch" || kind == "replaced70";
  const double begin = quantile(0.3);
  const double end = kind == "stretch" ? quantile(0.6) : times.back() + 1.0;
  const auto at_fault = [&](int step) {
    const double time = log.times_s[static_cast<std::size_t>(step)];
    return in_time ? time >= begin && time < end : at_random[static_cast<std::size_t>(step)] != 0;
  };
  if (kind == "replaced30" || kind == "replaced70")
    return called(without(log, first, second, at_fault), first, second, at_fault);
  return swapped(log, first, second, at_fault);
}

double map_error_m(const DetectionLog& log, const Points& ground_truth_m) {
  const Points map = pair_map_of(log).embedding.coordinates;
  if (!map.allFinite()) return HUGE_VAL;
  return (fit_similarity(map, ground_truth_m, Alignment::kRigid)(map) - ground_truth_m)
      .rowwise()
      .norm()
      .mean();
}

}  // namespace mapproof::test
