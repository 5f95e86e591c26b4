#include "noisy_scans.hpp"

#include <algorithm>
#include <set>
#include <tuple>

#include "core/base/random.hpp"
#include "tests/support/samples/drawn_points.hpp"
#include "tests/support/samples/scans.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof::test {
namespace {

std::tuple<int, int> key(const Detection& one) { return {one.step, one.landmark}; }

}  // namespace

Points noisy_landmarks() {
  Points positions = 2.0 * grid(5, 3);
  Random random(3);
  for (Eigen::Index i = 0; i < positions.rows(); ++i)
    positions.row(i) += uniform_point(random, -0.4, 0.4);
  return positions;
}

DetectionLog noisy_scans(int scans, std::uint64_t seed) {
  DetectionLog log = scans_at(noisy_landmarks(), scans, 4, seed);
  Random random(seed + 1);
  for (Detection& detection : log.detections) {
    detection.range_m *= 1.0 + 0.03 * random.normal();
    detection.bearing_rad += 0.0175 * random.normal();
  }
  return log;
}

DetectionLog scans_with_move(int scans, int landmark, const Eigen::RowVector2d& by_m, int from) {
  Points positions = noisy_landmarks();
  DetectionLog log = scans_at(positions, scans, 5, 11);
  positions.row(landmark) += by_m;
  const DetectionLog later = scans_at(positions, scans, 5, 11);
  std::erase_if(log.detections, [&](const Detection& one) { return one.step >= from; });
  for (const Detection& one : later.detections)
    if (one.step >= from) log.detections.push_back(one);
  Random random(5);
  for (Detection& one : log.detections) {
    one.range_m *= 1.0 + 0.02 * random.normal();
    one.bearing_rad += 0.0175 * random.normal();
  }
  return log;
}

DetectionLog swapped(DetectionLog log, int first, int second,
                     const std::function<bool(int)>& in_step) {
  for (Detection& detection : log.detections) {
    if (!in_step(detection.step)) continue;
    if (detection.landmark == first)
      detection.landmark = second;
    else if (detection.landmark == second)
      detection.landmark = first;
  }
  std::ranges::stable_sort(log.detections, {}, key);
  return log;
}

DetectionLog called(DetectionLog log, int landmark, int other,
                    const std::function<bool(int)>& in_step) {
  std::set<int> taken;
  for (const Detection& detection : log.detections)
    if (detection.landmark == other) taken.insert(detection.step);
  for (Detection& detection : log.detections)
    if (detection.landmark == landmark && in_step(detection.step) &&
        !taken.contains(detection.step))
      detection.landmark = other;
  std::ranges::stable_sort(log.detections, {}, key);
  return log;
}

int wrong_ids(const DetectionLog& log, const DetectionLog& ground_truth) {
  std::set<std::tuple<int, int>> right;
  for (const Detection& detection : ground_truth.detections) right.insert(key(detection));
  return static_cast<int>(std::ranges::count_if(
      log.detections, [&](const Detection& detection) { return !right.contains(key(detection)); }));
}

}  // namespace mapproof::test
