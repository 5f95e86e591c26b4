#include "tests/support/samples/observed.hpp"

#include <algorithm>
#include <cmath>

#include "core/observe/proximities.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"

namespace mapproof::test {

Eigen::MatrixXd observed_distances(int landmarks, Sensor sensor, int steps, std::uint64_t seed) {
  Random random(seed);
  WorldOptions room;
  room.landmarks = landmarks;
  room.side_m = 2.5 * std::sqrt(landmarks / 50.0);
  const World world = scatter_landmarks(room, random);
  const Path path = random_walk(world, {}, steps, random);
  const ObservationHistory history = observe(world, path, {.sensor = sensor}, random);
  return proximities(with_rows(history, seen_landmarks(history, steps)), steps).squared_distances.cwiseSqrt();
}

}  // namespace mapproof::test
