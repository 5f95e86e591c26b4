#include "real_looks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <set>

#include "core/align/rigid.hpp"
#include "core/base/random.hpp"
#include "core/pairs/pair_map.hpp"
#include "core/records/mrclam.hpp"
#include "noisy_looks.hpp"

namespace mapproof::test {
namespace {

/// The log without sightings of one landmark in looks that another is in too: under one label both
/// are one.
SightingLog without(SightingLog log, int landmark, int other,
                    const std::function<bool(int)>& in_step) {
  std::set<int> taken;
  for (const Sighting& seen : log.sightings)
    if (seen.landmark == other && in_step(seen.step)) taken.insert(seen.step);
  std::erase_if(log.sightings, [&](const Sighting& seen) {
    return seen.landmark == landmark && taken.contains(seen.step);
  });
  return log;
}

}  // namespace

std::optional<SightingSource> real_looks(const std::string& set) {
  const char* folder = std::getenv("MAPPROOF_MRCLAM");
  if (folder == nullptr) return std::nullopt;
  return read_mrclam_sightings(std::filesystem::path(folder) / set);
}

std::vector<int> robots_of(const SightingLog& log) {
  std::vector<int> robots;
  for (std::size_t k = 0; k < log.times_s.size(); ++k) {
    const bool next = k > 0 && log.times_s[k] < log.times_s[k - 1];
    robots.push_back(k == 0 ? 0 : robots.back() + (next ? 1 : 0));
  }
  return robots;
}

double middle_time_s(const SightingLog& log) {
  std::vector<double> times = log.times_s;
  const auto middle = times.begin() + std::ssize(times) / 2;
  std::ranges::nth_element(times, middle);
  return *middle;
}

int shared_sightings(const SightingLog& log, const std::vector<int>& robots, int robot,
                     int landmark) {
  int count = 0;
  const std::vector<Sighting>& rows = log.sightings;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].landmark != landmark || robots[static_cast<std::size_t>(rows[k].step)] != robot)
      continue;
    const bool shared = (k > 0 && rows[k - 1].step == rows[k].step) ||
                        (k + 1 < rows.size() && rows[k + 1].step == rows[k].step);
    count += shared ? 1 : 0;
  }
  return count;
}

SightingLog with_fault(const SightingLog& log, const std::string& kind, int first, int second,
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

double map_error_m(const SightingLog& log, const Points& truth_m) {
  const Points map = sighted_map(log).embedding.coordinates;
  if (!map.allFinite()) return HUGE_VAL;
  return (fit_similarity(map, truth_m, Alignment::kRigid)(map) - truth_m).rowwise().norm().mean();
}

}  // namespace mapproof::test
