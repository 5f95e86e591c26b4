#include "core/trials/simulated_detections.hpp"

#include <cmath>

#include "core/base/angle.hpp"
#include "core/simulate/sensors.hpp"

namespace mapproof {

DetectionLog simulated_detections(const World& world, const Path& path,
                                  const DetectionSensor& sensor, const SimulatedMove& move,
                                  Random& random) {
  DetectionLog log;
  log.names = landmark_names(world.landmarks_m.rows());
  log.steps = static_cast<int>(path.positions_m.rows());
  for (int step = 0; step < log.steps; ++step)
    for (Eigen::Index k = 0; k < world.landmarks_m.rows(); ++k) {
      Eigen::RowVector2d to = world.landmarks_m.row(k) - path.positions_m.row(step);
      if (k == move.landmark && step >= move.from_step) to += move.by_m;
      const double range = to.norm();
      if (range > sensor.reach_m) continue;
      const double bearing = std::atan2(to.y(), to.x()) - path.headings_rad(step);
      log.detections.push_back(
          {.step = step,
           .landmark = static_cast<int>(k),
           .range_m = std::abs(range * (1.0 + sensor.range_share * random.normal())),
           .bearing_rad = wrapped(bearing + sensor.bearing_rad * random.normal())});
    }
  return log;
}

}  // namespace mapproof
