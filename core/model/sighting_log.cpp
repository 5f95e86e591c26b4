#include "core/model/sighting_log.hpp"

namespace mapproof {

ObservationHistory history_of(const SightingLog& log, Sensor sensor) {
  const bool is_visibility = sensor == Sensor::kVisibility;
  ObservationHistory history{.sensor = sensor, .names = log.names, .values = {}};
  history.values.setConstant(static_cast<Eigen::Index>(log.names.size()), log.steps,
                             is_visibility ? 0.0 : std::numeric_limits<double>::quiet_NaN());
  for (const Sighting& seen : log.sightings)
    history.values(seen.landmark, seen.step) = is_visibility              ? 1.0
                                               : sensor == Sensor::kRange ? seen.range_m
                                                                          : seen.bearing_rad;
  return history;
}

}  // namespace mapproof
