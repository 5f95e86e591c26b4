#include "core/labels/scan_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/base/errors.hpp"
#include "core/pairs/pair_distances.hpp"

namespace mapproof {
namespace {

bool located(const Detection& detection) {
  return !std::isnan(detection.range_m) && !std::isnan(detection.bearing_rad);
}

void check(const DetectionLog& log) {
  int step = 0;
  for (const Detection& detection : log.detections) {
    if (detection.landmark < 0 || detection.landmark >= std::ssize(log.names))
      throw InvalidInput("a detection of a landmark that the log does not name");
    if (detection.step < step || detection.step >= log.steps)
      throw InvalidInput("detections whose steps descend or are not the log's");
    if (std::isinf(detection.range_m) || std::isinf(detection.bearing_rad))
      throw InvalidInput("a detection with an infinite value");
    step = detection.step;
  }
}

/// The row after the last of the scan that begins at `row`.
std::size_t end_of_scan(const DetectionLog& log, std::size_t row) {
  std::size_t end = row;
  while (end < log.detections.size() && log.detections[end].step == log.detections[row].step) ++end;
  return end;
}

std::size_t pairs_in(const DetectionLog& log, std::size_t begin, std::size_t end) {
  std::size_t count = 0;
  for (std::size_t row = begin; row < end; ++row) count += located(log.detections[row]) ? 1 : 0;
  return count < 2 ? 0 : count * (count - 1) / 2;
}

}  // namespace

std::vector<ScanPair> scan_pairs(const DetectionLog& log, std::size_t most) {
  check(log);
  std::size_t total = 0;
  for (std::size_t row = 0, end = 0; row < log.detections.size(); row = end) {
    end = end_of_scan(log, row);
    total += pairs_in(log, row, end);
  }
  const std::size_t stride =
      std::max<std::size_t>(1, (total + most - 1) / std::max<std::size_t>(most, 1));
  std::vector<ScanPair> pairs;
  pairs.reserve(total / stride + 1);
  std::size_t scan = 0;
  for (std::size_t row = 0, end = 0; row < log.detections.size(); row = end) {
    end = end_of_scan(log, row);
    if (pairs_in(log, row, end) == 0 || scan++ % stride != 0) continue;
    for (std::size_t a = row; a < end; ++a)
      for (std::size_t b = a + 1; b < end; ++b)
        if (located(log.detections[a]) && located(log.detections[b]))
          pairs.push_back(
              {log.detections[a].step, a, b, scan_distance(log.detections[a], log.detections[b])});
  }
  return pairs;
}

std::vector<int> given_labels(const DetectionLog& log) {
  std::vector<int> labels(log.detections.size());
  std::ranges::transform(log.detections, labels.begin(), &Detection::landmark);
  return labels;
}

}  // namespace mapproof
