#include "core/association/log_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

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
      throw InvalidInput("a detection names a landmark that the log does not have");
    if (detection.step < step || detection.step >= log.steps)
      throw InvalidInput("the detections' steps descend or are not the log's");
    if (std::isinf(detection.range_m) || std::isinf(detection.bearing_rad))
      throw InvalidInput("a detection has an infinite value");
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

constexpr int kMostRobots = 64;

/// The time of each step: the log's own, or the step number.
std::vector<double> clock_of(const DetectionLog& log) {
  const auto steps = static_cast<std::size_t>(log.steps);
  if (!log.times_s.empty() && log.times_s.size() != steps)
    throw InvalidInput("a log needs no times, or one per step");
  if (!std::ranges::all_of(log.times_s, [](double time) { return std::isfinite(time); }))
    throw InvalidInput("a log's times must be finite");
  std::vector<double> clock = log.times_s;
  const auto falls = [&](std::size_t step) { return step > 0 && clock[step] < clock[step - 1]; };
  int robots = 1;
  for (std::size_t step = 1; step < clock.size(); ++step) robots += falls(step) ? 1 : 0;
  if (clock.empty() || robots > kMostRobots) {
    clock.resize(steps);
    std::iota(clock.begin(), clock.end(), 0.0);
  }
  return clock;
}

/// The start times of all slices but the first: quantiles of the pairs' times.
std::vector<double> cuts_of(const std::vector<double>& clock, const std::vector<ScanPair>& pairs,
                            int slices) {
  std::vector<double> times;
  for (const ScanPair& pair : pairs) times.push_back(clock[static_cast<std::size_t>(pair.step)]);
  std::ranges::sort(times);
  std::vector<double> cuts;
  for (int k = 1; k < slices && !times.empty(); ++k) {
    const std::size_t at =
        times.size() * static_cast<std::size_t>(k) / static_cast<std::size_t>(slices);
    const double cut = times[at];
    if (cut > times.front() && (cuts.empty() || cut > cuts.back())) cuts.push_back(cut);
  }
  return cuts;
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

std::vector<int> given_ids(const DetectionLog& log) {
  std::vector<int> ids(log.detections.size());
  std::ranges::transform(log.detections, ids.begin(), &Detection::landmark);
  return ids;
}

LogBlocks cut_in_blocks(const DetectionLog& log, const std::vector<ScanPair>& pairs, int slices) {
  if (slices < 1) throw InvalidInput("a log needs one slice or more");
  const std::vector<double> clock = clock_of(log);
  const std::vector<double> cuts = cuts_of(clock, pairs, slices);
  LogBlocks blocks;
  std::map<std::pair<int, int>, int>
      numbers;  // (robot, slice) in order of appearance: robot by robot
  int robot = 0;
  for (std::size_t step = 0; step < clock.size(); ++step) {
    if (step > 0 && clock[step] < clock[step - 1]) ++robot;
    const auto slice = static_cast<int>(std::ranges::upper_bound(cuts, clock[step]) - cuts.begin());
    const auto [found, is_new] = numbers.try_emplace({robot, slice}, blocks.count);
    if (is_new) {
      ++blocks.count;
      blocks.slice.push_back(slice);
    }
    blocks.of_step.push_back(found->second);
  }
  std::vector<int> steps(clock.size());
  std::iota(steps.begin(), steps.end(), 0);
  std::vector<int> order(static_cast<std::size_t>(blocks.count));
  std::iota(order.begin(), order.end(), 0);
  blocks.step_orders.push_back(steps);
  blocks.block_orders.push_back(order);
  if (robot > 0) {
    std::ranges::stable_sort(steps, {},
                             [&](int step) { return clock[static_cast<std::size_t>(step)]; });
    std::ranges::stable_sort(
        order, {}, [&](int block) { return blocks.slice[static_cast<std::size_t>(block)]; });
    blocks.step_orders.push_back(std::move(steps));
    blocks.block_orders.push_back(std::move(order));
  }
  return blocks;
}

}  // namespace mapproof
