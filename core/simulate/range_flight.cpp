#include "core/simulate/range_flight.hpp"

#include <cmath>

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
  if (!(o.turn_sigma_rad >= 0.0)) throw InvalidInput("turns must not be negative");
}

Eigen::RowVector3d uniform_place(const RangeFlightOptions& options, Random& random) {
  const double x = random.uniform(-options.half_width_m, options.half_width_m);
  const double y = random.uniform(-options.half_width_m, options.half_width_m);
  return {x, y, random.uniform(0.0, options.height_m)};
}

Eigen::RowVector3d normal_vector(Random& random) {
  const double x = random.normal(), y = random.normal();
  return {x, y, random.normal()};
}

bool is_inside(const Eigen::RowVector3d& place, const RangeFlightOptions& options) {
  return place.head<2>().cwiseAbs().maxCoeff() <= options.half_width_m && place.z() >= 0.0 &&
         place.z() <= options.height_m;
}

SpacePoints fly(const RangeFlightOptions& options, Random& random) {
  SpacePoints positions_m(options.steps, 3);
  Eigen::RowVector3d position = uniform_place(options, random);
  Eigen::RowVector3d direction = normal_vector(random).normalized();
  for (Eigen::Index t = 0; t < options.steps; ++t) {
    positions_m.row(t) = position;
    const Eigen::RowVector3d wavering = direction + options.turn_sigma_rad * normal_vector(random);
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

}  // namespace

RangeFlight simulate_range_flight(const RangeFlightOptions& options, std::uint64_t seed) {
  check(options);
  Random random(seed);
  RangeFlight flight;
  flight.landmarks_m.resize(options.landmarks, 3);
  for (Eigen::Index n = 0; n < options.landmarks; ++n)
    flight.landmarks_m.row(n) = uniform_place(options, random);
  flight.positions_m = fly(options, random);
  flight.ranges_m = simulated_ranges(flight.landmarks_m, flight.positions_m, options.noise, random);
  return flight;
}

}  // namespace mapproof
