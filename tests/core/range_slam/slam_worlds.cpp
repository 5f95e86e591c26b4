#include "tests/core/range_slam/slam_worlds.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/base/random.hpp"

namespace mapproof::test {

RangeLog slam_world(std::uint64_t seed, const SlamWorldOptions& options) {
  Random random(seed);
  RangeLog log{.name = "world",
               .landmarks = {},
               .ranges = {},
               .start = {.time_s = 0.0, .x_m = 1.0, .y_m = -2.0, .heading_rad = 0.3},
               .odometry = {},
               .ground_truth = Trajectory{},
               .true_landmarks = Points(options.landmarks, 2),
               .remarks = {}};
  for (Eigen::Index n = 0; n < options.landmarks; ++n) {
    log.landmarks.push_back(fmt::format("{}", n));
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(n) / static_cast<double>(options.landmarks);
    log.true_landmarks->row(n) << 6.0 * std::cos(angle) + random.uniform(-1.0, 1.0),
        5.0 + 6.0 * std::sin(angle) + random.uniform(-1.0, 1.0);
  }
  const Eigen::Index poses = options.steps + 1;
  Trajectory& path = *log.ground_truth;
  path = {.time_s = Eigen::VectorXd::LinSpaced(poses, 0.0, static_cast<double>(options.steps)),
          .positions_m = Points(poses, 2),
          .heading_rad = Eigen::VectorXd(poses)};
  Eigen::RowVector2d position(log.start.x_m, log.start.y_m);
  double heading = log.start.heading_rad;
  for (Eigen::Index i = 0; i < poses; ++i) {
    path.positions_m.row(i) = position;
    path.heading_rad(i) = heading;
    const Eigen::Index landmark = i % options.landmarks;
    const double distance_m = (log.true_landmarks->row(landmark) - position).norm();
    log.ranges.push_back({.time_s = path.time_s(i),
                          .landmark = landmark,
                          .range_m = std::abs(options.range_scale * distance_m +
                                              options.range_sigma_m * random.normal())});
    if (i + 1 == poses) break;
    const double turn =
        options.is_straight ? 0.0 : 0.12 + 0.15 * std::sin(0.35 * static_cast<double>(i));
    log.odometry.push_back(
        {.time_s = path.time_s(i + 1),
         .distance_m = 0.5 + options.distance_sigma_m * random.normal(),
         .heading_change_rad = turn + options.heading_change_sigma_rad * random.normal(),
         .sideways_m = options.distance_sigma_m * random.normal()});
    position += 0.5 * Eigen::RowVector2d(std::cos(heading), std::sin(heading));
    heading += turn;
  }
  return log;
}

RangeLog noisy_world(std::uint64_t seed, Eigen::Index steps) {
  return slam_world(seed, {.steps = steps,
                           .range_sigma_m = 0.2,
                           .distance_sigma_m = 0.02,
                           .heading_change_sigma_rad = 0.01,
                           .range_scale = 1.05});
}

RangeLog turned_world(double direction_rad) {
  RangeLog log = slam_world(2);
  log.start.heading_rad += direction_rad;
  log.ground_truth->heading_rad.array() += direction_rad;
  for (Motion& motion : log.odometry) {
    const double forward_m = motion.distance_m;
    motion.distance_m = forward_m * std::cos(direction_rad);
    motion.sideways_m = -forward_m * std::sin(direction_rad);
  }
  return log;
}

SlamEstimate ground_truth_as_start(const RangeLog& log) {
  SlamEstimate start;
  start.path = *log.ground_truth;
  start.landmarks_m = *log.true_landmarks;
  return start;
}

}  // namespace mapproof::test
