#include "core/model/run_details.hpp"

#include "core/base/errors.hpp"

namespace mapproof {

Measurement measurement(const RunDetails& run, const SensorDetails& sensor, const World& world) {
  const Eigen::Index step = sensor.scan_step;
  if (step < 1 || step > run.path.positions_m.rows())
    throw InvalidInput("a look at a step that the path does not have");
  return {.sensor = sensor.sensor,
          .run = run.id,
          .step = sensor.scan_step,
          .world = world,
          .path_m = run.path.positions_m.topRows(step),
          .robot_m = run.path.positions_m.row(step - 1),
          .heading_rad = run.path.headings_rad(step - 1),
          .reach_m = sensor.reach_m,
          .views = sensor.views,
          .bearings_rad = sensor.sensor == Sensor::kBearing ? sensor.values : Eigen::VectorXd()};
}

}  // namespace mapproof
