#include "core/records/observations/input_summary.hpp"

#include <algorithm>

namespace mapproof {

InputSummary summary_of(const ObservationSource& source) {
  const auto entries = static_cast<double>(std::max<Eigen::Index>(source.history.values.size(), 1));
  return {
      .landmarks = source.history.landmarks(),
      .steps = source.history.steps(),
      .sensor = std::string(name(source.history.sensor)),
      .missing_share = static_cast<double>(source.history.values.array().isNaN().count()) / entries,
      .reading = source.reading};
}

InputSummary summary_of(const PackedSource& source) {
  const PackedHistory& history = source.history;
  const double entries =
      std::max(1.0, static_cast<double>(history.landmarks()) * static_cast<double>(history.steps));
  return {.landmarks = history.landmarks(),
          .steps = history.steps,
          .sensor = std::string(name(history.sensor)),
          .missing_share = history.missing / entries,
          .reading = source.reading};
}

InputSummary summary_of(const DetectionSource& source, const std::string& sensor) {
  const auto landmarks = std::ssize(source.log.names);
  const double entries =
      std::max(1.0, static_cast<double>(landmarks) * static_cast<double>(source.log.steps));
  const auto listed = static_cast<double>(source.log.detections.size());
  return {.landmarks = landmarks,
          .steps = source.log.steps,
          .sensor = sensor,
          .missing_share = 1.0 - listed / entries,
          .detections = std::ssize(source.log.detections),
          .reading = source.reading};
}

}  // namespace mapproof
