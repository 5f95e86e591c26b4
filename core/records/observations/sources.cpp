#include "core/records/observations/sources.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/records/limits.hpp"
#include "core/records/tables/cells.hpp"

namespace mapproof {

void refuse_unmeasured(const std::string& source, Sensor sensor) {
  throw IoError(source, fmt::format("holds no {}", name(sensor)));
}

ObservationSource observations_of(DetectionSource source, Sensor sensor) {
  const std::size_t landmarks = source.log.names.size();
  const auto steps = static_cast<std::size_t>(source.log.steps);
  if (sensor == Sensor::kVisibility &&
      static_cast<double>(landmarks) * static_cast<double>(steps) > kMostEntries)
    throw IoError(source.path, "as a whole",
                  fmt::format("an array of {} landmarks x {} steps has more than {:.0f} entries; "
                              "--method landmark-isomap maps such a list without it",
                              landmarks, steps, kMostEntries));
  check_size(source.path, "as a whole", landmarks, steps);
  ObservationHistory history = history_of(source.log, sensor);
  if (history.values.array().isNaN().all()) refuse_unmeasured(source.path, sensor);
  if (sensor == Sensor::kRange) remark_on_angles(history, source.remarks);
  return {.history = std::move(history),
          .ground_truth_m = std::move(source.ground_truth_m),
          .remarks = std::move(source.remarks),
          .locations = std::move(source.locations),
          .path = std::move(source.path),
          .reading = std::move(source.reading)};
}

ObservationHistory PackedHistory::array() const {
  return array_of(blocks());
}

ObservationSource unpacked(const PackedSource& source) {
  return {.history = source.history.array(),
          .ground_truth_m = std::nullopt,
          .remarks = source.remarks,
          .locations = source.locations,
          .path = source.path,
          .reading = source.reading};
}

}  // namespace mapproof
