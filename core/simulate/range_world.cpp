#include "core/simulate/range_world.hpp"

#include <cmath>
#include <numbers>

#include "core/base/angle.hpp"
#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/simulate/range_noise.hpp"

namespace mapproof {
namespace {

void check(const RangeWorldOptions& o) {
  if (o.landmarks < 1 || o.steps < 1) throw InvalidInput("a world needs a landmark and a step");
  if (!(o.half_width_m > 0.0 && std::isfinite(o.half_width_m)))
    throw InvalidInput("a world's half width must be above 0");
  if (!(o.step_m > 0.0 && o.step_m <= o.half_width_m))
    throw InvalidInput("a step must be above 0 and at most the half width");
  if (!(o.turn_sigma_rad >= 0.0)) throw InvalidInput("turns must not be negative");
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
    heading = wrapped(heading + options.turn_sigma_rad * random.normal());
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
