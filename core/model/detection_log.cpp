#include "core/model/detection_log.hpp"

#include <algorithm>
#include <utility>

#include "core/base/not_finite.hpp"

namespace mapproof {

std::vector<Eigen::Index> unseen_in(const DetectionLog& log) {
  std::vector<bool> is_seen(log.names.size(), false);
  for (const Detection& one : log.detections)
    is_seen[static_cast<std::size_t>(one.landmark)] = true;
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < is_seen.size(); ++i)
    if (!is_seen[i]) rows.push_back(static_cast<Eigen::Index>(i));
  return rows;
}

void sort_detections(std::vector<Detection>& detections) {
  std::ranges::stable_sort(detections, {},
                           [](const Detection& one) { return std::pair(one.step, one.landmark); });
}

double measured(const Detection& seen, Sensor sensor) {
  switch (sensor) {
    case Sensor::kVisibility:
      return 1.0;
    case Sensor::kBearing:
      return seen.bearing_rad;
    case Sensor::kRange:
      return seen.range_m;
  }
  return kNaN;
}

ObservationHistory history_of(const DetectionLog& log, Sensor sensor) {
  const bool is_visibility = sensor == Sensor::kVisibility;
  ObservationHistory history{.sensor = sensor, .names = log.names, .values = {}};
  history.values.setConstant(static_cast<Eigen::Index>(log.names.size()), log.steps,
                             is_visibility ? 0.0 : kNaN);
  for (const Detection& seen : log.detections)
    history.values(seen.landmark, seen.step) = measured(seen, sensor);
  return history;
}

}  // namespace mapproof
