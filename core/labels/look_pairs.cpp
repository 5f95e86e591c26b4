#include "core/labels/look_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/base/errors.hpp"
#include "core/pairs/pair_distances.hpp"

namespace mapproof {
namespace {

bool located(const Sighting& sighting) {
  return !std::isnan(sighting.range_m) && !std::isnan(sighting.bearing_rad);
}

void check(const SightingLog& log) {
  int step = 0;
  for (const Sighting& sighting : log.sightings) {
    if (sighting.landmark < 0 || sighting.landmark >= std::ssize(log.names))
      throw InvalidInput("a sighting of a landmark that the log does not name");
    if (sighting.step < step || sighting.step >= log.steps)
      throw InvalidInput("sightings whose steps descend or are not the log's");
    if (std::isinf(sighting.range_m) || std::isinf(sighting.bearing_rad))
      throw InvalidInput("a sighting with an infinite value");
    step = sighting.step;
  }
}

/// The row after the last of the look that begins at `row`.
std::size_t end_of_look(const SightingLog& log, std::size_t row) {
  std::size_t end = row;
  while (end < log.sightings.size() && log.sightings[end].step == log.sightings[row].step) ++end;
  return end;
}

std::size_t pairs_in(const SightingLog& log, std::size_t begin, std::size_t end) {
  std::size_t count = 0;
  for (std::size_t row = begin; row < end; ++row) count += located(log.sightings[row]) ? 1 : 0;
  return count < 2 ? 0 : count * (count - 1) / 2;
}

}  // namespace

std::vector<LookPair> look_pairs(const SightingLog& log, std::size_t most) {
  check(log);
  std::size_t total = 0;
  for (std::size_t row = 0, end = 0; row < log.sightings.size(); row = end) {
    end = end_of_look(log, row);
    total += pairs_in(log, row, end);
  }
  const std::size_t stride =
      std::max<std::size_t>(1, (total + most - 1) / std::max<std::size_t>(most, 1));
  std::vector<LookPair> pairs;
  pairs.reserve(total / stride + 1);
  std::size_t look = 0;
  for (std::size_t row = 0, end = 0; row < log.sightings.size(); row = end) {
    end = end_of_look(log, row);
    if (pairs_in(log, row, end) == 0 || look++ % stride != 0) continue;
    for (std::size_t a = row; a < end; ++a)
      for (std::size_t b = a + 1; b < end; ++b)
        if (located(log.sightings[a]) && located(log.sightings[b]))
          pairs.push_back(
              {log.sightings[a].step, a, b, look_distance(log.sightings[a], log.sightings[b])});
  }
  return pairs;
}

std::vector<int> given_labels(const SightingLog& log) {
  std::vector<int> labels(log.sightings.size());
  std::ranges::transform(log.sightings, labels.begin(), &Sighting::landmark);
  return labels;
}

}  // namespace mapproof
