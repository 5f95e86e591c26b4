#include "core/simulate/range_world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/base/angle.hpp"
#include "core/base/errors.hpp"
#include "core/base/random.hpp"

namespace mapproof {
namespace {

void check(const RangeFlightOptions& o) {
  if (o.landmarks < 1 || o.steps < 1) throw InvalidInput("a world needs a landmark and a step");
  if (!(o.half_width_m > 0.0 && std::isfinite(o.half_width_m)))
    throw InvalidInput("a world's half width must be above 0");
  if (!(o.height_m > 0.0 && o.height_m <= 2.0 * o.half_width_m))
    throw InvalidInput("a world's height must be above 0 and at most its width");
  if (!(o.step_m > 0.0 && o.step_m <= 0.5 * o.height_m))
    throw InvalidInput("a step must be above 0 and at most half the height");
  if (!(o.heading_change_sigma_rad >= 0.0))
    throw InvalidInput("heading changes must not be negative");
}

Eigen::RowVector3d uniform_position(const RangeFlightOptions& options, Random& random) {
  const double x = random.uniform(-options.half_width_m, options.half_width_m);
  const double y = random.uniform(-options.half_width_m, options.half_width_m);
  return {x, y, random.uniform(0.0, options.height_m)};
}

Eigen::RowVector3d normal_vector(Random& random) {
  const double x = random.normal(), y = random.normal();
  return {x, y, random.normal()};
}

bool is_inside(const Eigen::RowVector3d& position, const RangeFlightOptions& options) {
  return position.head<2>().cwiseAbs().maxCoeff() <= options.half_width_m && position.z() >= 0.0 &&
         position.z() <= options.height_m;
}

SpacePoints fly(const RangeFlightOptions& options, Random& random) {
  SpacePoints positions_m(options.steps, 3);
  Eigen::RowVector3d position = uniform_position(options, random);
  Eigen::RowVector3d direction = normal_vector(random).normalized();
  for (Eigen::Index t = 0; t < options.steps; ++t) {
    positions_m.row(t) = position;
    const Eigen::RowVector3d wavering =
        direction + options.heading_change_sigma_rad * normal_vector(random);
    if (wavering.squaredNorm() > 0.0) direction = wavering.normalized();
    Eigen::RowVector3d next;
    // A step of at most half the height stays inside in an eighth of all directions or more.
    while (true) {
      next = position + options.step_m * direction;
      if (is_inside(next, options)) break;
      direction = normal_vector(random).normalized();
    }
    position = next;
  }
  return positions_m;
}

void check(const RangeWorldOptions& o) {
  if (o.landmarks < 1 || o.steps < 1) throw InvalidInput("a world needs a landmark and a step");
  if (!(o.half_width_m > 0.0 && std::isfinite(o.half_width_m)))
    throw InvalidInput("a world's half width must be above 0");
  if (!(o.step_m > 0.0 && o.step_m <= o.half_width_m))
    throw InvalidInput("a step must be above 0 and at most the half width");
  if (!(o.heading_change_sigma_rad >= 0.0))
    throw InvalidInput("heading changes must not be negative");
}

Eigen::RowVector2d uniform_point(double half_width, Random& random) {
  const double x = random.uniform(-half_width, half_width);
  return {x, random.uniform(-half_width, half_width)};
}

void walk(RangeWorld& world, const RangeWorldOptions& options, Random& random) {
  world.positions_m.resize(options.steps, 2);
  world.heading_rad.resize(options.steps);
  Eigen::RowVector2d position = uniform_point(options.half_width_m, random);
  double heading = random.uniform(-std::numbers::pi, std::numbers::pi);
  for (Eigen::Index t = 0; t < options.steps; ++t) {
    world.positions_m.row(t) = position;
    heading = wrapped(heading + options.heading_change_sigma_rad * random.normal());
    Eigen::RowVector2d next;
    // A step of at most the half width stays inside in a quarter of all directions or more.
    while (true) {
      next = position + options.step_m * Eigen::RowVector2d(std::cos(heading), std::sin(heading));
      if (next.cwiseAbs().maxCoeff() <= options.half_width_m) break;
      heading = random.uniform(-std::numbers::pi, std::numbers::pi);
    }
    world.heading_rad(t) = heading;
    position = next;
  }
}

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

Eigen::MatrixXd simulated_ranges(const Eigen::MatrixXd& landmarks_m,
                                 const Eigen::MatrixXd& positions_m,
                                 const SimulatedRangeNoise& noise, Random& random) {
  if (landmarks_m.cols() != positions_m.cols())
    throw InvalidInput("landmarks and positions must have the same dimension");
  if (!(noise.sigma_m >= 0.0 && noise.share >= 0.0))
    throw InvalidInput("noise must not be negative");
  if (!(noise.correlation >= 0.0 && noise.correlation < 1.0))
    throw InvalidInput("the correlation of noise must be at least 0 and below 1");
  const double rho = noise.correlation;
  const double fresh = std::sqrt(1.0 - rho * rho);
  Eigen::MatrixXd ranges_m(landmarks_m.rows(), positions_m.rows());
  for (Eigen::Index n = 0; n < ranges_m.rows(); ++n) {
    double error = random.normal();
    for (Eigen::Index t = 0; t < ranges_m.cols(); ++t) {
      if (t > 0) error = rho * error + fresh * random.normal();
      const double range = (landmarks_m.row(n) - positions_m.row(t)).norm();
      const double sigma = std::hypot(noise.sigma_m, noise.share * range);
      ranges_m(n, t) = std::max(0.0, range + sigma * error);
    }
  }
  return ranges_m;
}

RangeFlight simulate_range_flight(const RangeFlightOptions& options, std::uint64_t seed) {
  check(options);
  Random random(seed);
  RangeFlight flight;
  flight.landmarks_m.resize(options.landmarks, 3);
  for (Eigen::Index n = 0; n < options.landmarks; ++n)
    flight.landmarks_m.row(n) = uniform_position(options, random);
  flight.positions_m = fly(options, random);
  flight.ranges_m = simulated_ranges(flight.landmarks_m, flight.positions_m, options.noise, random);
  return flight;
}

RangeWorld simulate_range_world(const RangeWorldOptions& options, std::uint64_t seed) {
  check(options);
  Random random(seed);
  RangeWorld world;
  world.landmarks_m.resize(options.landmarks, 2);
  for (Eigen::Index n = 0; n < options.landmarks; ++n)
    world.landmarks_m.row(n) = uniform_point(options.half_width_m, random);
  walk(world, options, random);

  world.ranges_m = simulated_ranges(world.landmarks_m, world.positions_m,
                                    {.sigma_m = options.noise_m,
                                     .share = options.noise_share,
                                     .correlation = options.noise_correlation},
                                    random);
  return world;
}

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
