#include "real_looks.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "core/records/mrclam.hpp"

namespace mapproof::test {

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

}  // namespace mapproof::test
