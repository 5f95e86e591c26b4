#include "tests/support/samples/scans.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/base/random.hpp"

namespace mapproof::test {
namespace {

std::vector<int> nearest(const Points& landmarks, const Eigen::RowVector2d& location, int count) {
  std::vector<int> order(static_cast<std::size_t>(landmarks.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int i) { return (landmarks.row(i) - location).norm(); });
  order.resize(static_cast<std::size_t>(count));
  std::ranges::sort(order);
  return order;
}

}  // namespace

DetectionLog scans_at(const Points& landmarks, int scans, int seen, std::uint64_t seed) {
  DetectionLog log;
  for (int i = 0; i < static_cast<int>(landmarks.rows()); ++i)
    log.names.push_back(i < 26 ? std::string(1, static_cast<char>('A' + i)) : std::to_string(i));
  const Eigen::RowVector2d low = landmarks.colwise().minCoeff();
  const Eigen::RowVector2d extent = landmarks.colwise().maxCoeff() - low;
  Random random(seed);
  for (log.steps = 0; log.steps < scans; ++log.steps) {
    // One after the other: compilers differ in which argument of a call they draw first.
    const double y = low.y() + random.uniform() * extent.y();
    const double x = low.x() + random.uniform() * extent.x();
    const Eigen::RowVector2d location(x, y);
    const double heading = 2.0 * std::numbers::pi * random.uniform();
    for (const int i : nearest(landmarks, location, seen)) {
      const Eigen::RowVector2d to = landmarks.row(i) - location;
      log.detections.push_back({.step = log.steps,
                                .landmark = i,
                                .range_m = to.norm(),
                                .bearing_rad = std::remainder(std::atan2(to.y(), to.x()) - heading,
                                                              2.0 * std::numbers::pi)});
    }
  }
  return log;
}

}  // namespace mapproof::test
