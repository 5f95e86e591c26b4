#include "tests/core/range_slam/drives.hpp"

#include <cmath>

#include "core/base/random.hpp"
#include "tests/core/range_slam/range_worlds.hpp"

namespace mapproof::test {

Drive drive(const DriveOptions& options, std::uint64_t seed) {
  constexpr Eigen::Index kPoses = 2001;
  constexpr double kStep = 0.1;
  Random random(seed);
  Drive drive;
  Trajectory ground_truth;
  ground_truth.time_s = Eigen::VectorXd::LinSpaced(kPoses, 0.0, kStep * double(kPoses - 1));
  ground_truth.positions_m = Points::Zero(kPoses, 2);
  ground_truth.heading_rad = Eigen::VectorXd::Zero(kPoses);
  drive.odometry = ground_truth;
  drive.odometry.heading_rad(0) = 2.0;  // a frame of its own
  for (Eigen::Index t = 1; t < kPoses; ++t) {
    const double turn = kStep * (0.25 * std::sin(0.11 * ground_truth.time_s(t)) + 0.12);
    for (Trajectory* path : {&ground_truth, &drive.odometry}) {
      const double heading = path->heading_rad(t - 1);
      path->positions_m.row(t) = path->positions_m.row(t - 1) +
                                 kStep * Eigen::RowVector2d(std::cos(heading), std::sin(heading));
      path->heading_rad(t) = heading + turn;
    }
    drive.odometry.heading_rad(t) += kStep * options.gyro_drift;
  }
  const Points landmarks = points_about(6, random, 25.0, ground_truth.positions_m.colwise().mean());
  for (Eigen::Index t = 1; t < kPoses; t += 2) {
    const Eigen::Index n = (t / 2) % 6;
    const double range = (landmarks.row(n) - ground_truth.positions_m.row(t)).norm();
    drive.log.ranges.push_back({.time_s = ground_truth.time_s(t),
                                .landmark = n,
                                .range_m = std::abs(options.range_scale * range +
                                                    options.range_sigma_m * random.normal())});
  }
  for (Eigen::Index n = 0; n < 6; ++n) drive.log.landmarks.push_back(std::to_string(n));
  drive.log.ground_truth = ground_truth;
  drive.log.true_landmarks = landmarks;
  return drive;
}

}  // namespace mapproof::test
