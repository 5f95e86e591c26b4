#include "core/simulate/range_drive.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr double kDriveStep_s = 0.2;
constexpr double kDriveStep_m = 0.2;
constexpr double kMostCurvature = 0.35;  ///< 1/m.

/// A path that curves this way and that, and back when it nears the border.
Trajectory drive_path(const RangeDriveOptions& options, Random& random) {
  const Eigen::Index poses = options.steps + 1;
  Trajectory path{.time_s = Eigen::VectorXd::LinSpaced(poses, 0.0, kDriveStep_s * options.steps),
                  .positions_m = Points(poses, 2),
                  .heading_rad = Eigen::VectorXd(poses)};
  Eigen::Vector3d pose(0.0, 0.0, random.uniform(-3.0, 3.0));
  double curvature = 0.0;
  for (Eigen::Index i = 0; i < poses; ++i) {
    path.positions_m.row(i) = pose.head<2>().transpose();
    path.heading_rad(i) = pose(2);
    curvature =
        std::clamp(0.98 * curvature + 0.03 * random.normal(), -kMostCurvature, kMostCurvature);
    double turn = curvature;
    if (pose.head<2>().cwiseAbs().maxCoeff() > 0.8 * options.half_width_m) {
      const double home = std::atan2(-pose(1), -pose(0));
      turn = std::clamp(std::remainder(home - pose(2), 6.283185307179586), -kMostCurvature,
                        kMostCurvature);
    }
    pose.head<2>() += kDriveStep_m * Eigen::Vector2d(std::cos(pose(2)), std::sin(pose(2)));
    pose(2) += kDriveStep_m * turn;
  }
  return path;
}

void add_odometry(const RangeDriveOptions& options, const DriveFaults& faults, Random& random,
                  RangeLog& log) {
  const Trajectory& path = *log.ground_truth;
  const double middle_s = 0.5 * path.time_s(path.size() - 1);
  for (Eigen::Index i = 1; i < path.size(); ++i) {
    Motion motion{.time_s = path.time_s(i),
                  .distance_m = kDriveStep_m + options.forward_sigma_m * random.normal(),
                  .heading_change_rad = path.heading_rad(i) - path.heading_rad(i - 1) +
                                        options.heading_change_sigma_rad * random.normal()};
    const double since_s = motion.time_s - middle_s;
    if (since_s > 0.0 && since_s < faults.gap_s) continue;
    if (since_s > 0.0 && since_s < faults.frozen_s)
      motion.distance_m = motion.heading_change_rad = 0.0;
    log.odometry.push_back(motion);
  }
}

void add_ranges(const RangeDriveOptions& options, const DriveFaults& faults, Random& random,
                RangeLog& log) {
  const Trajectory& path = *log.ground_truth;
  const double end_s = path.time_s(path.size() - 1);
  const auto landmarks = static_cast<std::size_t>(options.landmarks);
  std::vector<double> coloured(landmarks, 0.0), offsets(landmarks, 0.0), last_s(landmarks, 0.0);
  for (std::size_t n = 0; n < landmarks; ++n) {
    coloured[n] = random.normal();
    offsets[n] = options.offset_sigma_m * random.normal();
  }
  const double direction = random.uniform(-3.0, 3.0);
  const Eigen::RowVector2d move(faults.moved_m * std::cos(direction),
                                faults.moved_m * std::sin(direction));
  const double share = options.correlation > 0.0 ? 0.5 : 0.0;
  double longest_m = 1.0;
  for (double time_s = 0.1; time_s < end_s; time_s += options.range_every_s) {
    const auto n = static_cast<std::size_t>(
        std::min(random.uniform() * options.landmarks, options.landmarks - 1.0));
    const auto row =
        std::min<Eigen::Index>(static_cast<Eigen::Index>(time_s / kDriveStep_s), path.size() - 2);
    const double part = (time_s - path.time_s(row)) / kDriveStep_s;
    const Eigen::RowVector2d position =
        (1.0 - part) * path.positions_m.row(row) + part * path.positions_m.row(row + 1);
    const bool is_late = time_s > 0.5 * end_s;
    Eigen::RowVector2d landmark = log.true_landmarks->row(static_cast<Eigen::Index>(n));
    if (n == 0 && is_late) landmark += move;
    const double rho = std::pow(options.correlation, time_s - last_s[n]);
    coloured[n] = rho * coloured[n] + std::sqrt(1.0 - rho * rho) * random.normal();
    last_s[n] = time_s;
    const double error = options.range_sigma_m * (std::sqrt(share) * coloured[n] +
                                                  std::sqrt(1.0 - share) * random.normal());
    double range_m = options.range_scale * (position - landmark).norm() + offsets[n] + error +
                     faults.common_offset_m + (n == 0 ? faults.landmark_offset_m : 0.0);
    longest_m = std::max(longest_m, range_m);
    if (random.uniform() < faults.outlier_share) range_m = random.uniform(0.0, longest_m);
    Eigen::Index name = static_cast<Eigen::Index>(n);
    const bool is_exchanged =
        is_late && time_s < end_s * (0.5 + 0.5 * faults.exchanged_share) && n < 2;
    if (is_exchanged) name = 1 - name;
    log.ranges.push_back({.time_s = time_s + faults.late_s + (is_late ? faults.jump_s : 0.0),
                          .landmark = name,
                          .range_m = std::max(range_m, 0.01)});
  }
  std::ranges::stable_sort(log.ranges, {}, &RangeMeasurement::time_s);
}

}  // namespace

RangeLog simulate_drive(const RangeDriveOptions& options, const DriveFaults& faults,
                        Random& random) {
  if (options.landmarks < 1 || options.steps < 2)
    throw InvalidInput("a drive needs a landmark and two motions");
  RangeLog log;
  log.name = "simulated drive";
  log.true_landmarks = Points(options.landmarks, 2);
  for (int n = 0; n < options.landmarks; ++n) {
    log.landmarks.push_back(std::to_string(n));
    for (int axis = 0; axis < 2; ++axis)
      (*log.true_landmarks)(n, axis) = random.uniform(-options.half_width_m, options.half_width_m);
  }
  log.ground_truth = drive_path(options, random);
  const Trajectory& path = *log.ground_truth;
  log.start = {.time_s = 0.0,
               .x_m = path.positions_m(0, 0),
               .y_m = path.positions_m(0, 1),
               .heading_rad = path.heading_rad(0)};
  add_odometry(options, faults, random, log);
  add_ranges(options, faults, random, log);
  return log;
}

}  // namespace mapproof
