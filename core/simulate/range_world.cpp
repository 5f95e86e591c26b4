#include "core/simulate/range_world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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

}  // namespace mapproof
