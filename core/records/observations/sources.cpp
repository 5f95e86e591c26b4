#include "core/records/observations/sources.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/records/tables/cells.hpp"

namespace mapproof {

ObservationSource observations_of(DetectionSource source, Sensor sensor) {
  check_size(source.path, "as a whole", source.log.names.size(),
             static_cast<std::size_t>(source.log.steps));
  ObservationHistory history = history_of(source.log, sensor);
  if (history.values.array().isNaN().all())
    throw IoError(source.path, fmt::format("holds no {}", name(sensor)));
  if (sensor == Sensor::kRange) remark_on_angles(history, source.remarks);
  return {.history = std::move(history),
          .ground_truth_m = std::move(source.ground_truth_m),
          .remarks = std::move(source.remarks),
          .locations = std::move(source.locations),
          .path = std::move(source.path),
          .reading = std::move(source.reading)};
}

}  // namespace mapproof
