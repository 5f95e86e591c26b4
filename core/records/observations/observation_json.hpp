#pragma once

#include <array>
#include <string_view>
#include <tuple>

#include "core/model/observation_history.hpp"
#include "core/records/observations/sources.hpp"
#include "core/records/value_fields.hpp"

namespace mapproof {

// The fields of observations and detections as JSON (core/json/fields.hpp).

inline EnumNames enum_names(AngleUnit) {
  static constexpr std::array<std::string_view, 2> kNames = {"rad", "deg"};
  return {"unit", kNames};
}

namespace record_rules {

inline FieldRule some_names() {
  FieldRule rule = kNames;
  rule.min_items = 1;
  return rule;
}

}  // namespace record_rules

struct ObservationsFile {
  ObservationHistory history;  ///< Bearings in the unit of the file.
  AngleUnit unit = AngleUnit::kRadians;
};

template <typename Visitor>
void fields(Visitor& v, ObservationsFile& file) {
  v.file("mapproof.observations", "What one sensor observed of M landmarks over N steps.");
  v.field("sensor", file.history.sensor);
  v.field("unit", file.unit,
          {.description = "Of bearings; rad if left out.",
           .key = Key::kOptional,
           .written = file.unit != AngleUnit::kRadians});
  v.field("landmarks", file.history.names, record_rules::some_names());
  v.field("values", file.history.values,
          {.description =
               "A row per landmark, a column per step: 0 or 1, rad, or m; null where missing.",
           .nullable_entries = true,
           .min_items = 1,
           .max_items = kMostLandmarks,
           .not_empty = true});
  if (file.history.landmarks() != std::ssize(file.history.names))
    v.refuse("values", fmt::format("expected {} rows, one per landmark, got {}",
                                   file.history.names.size(), file.history.landmarks()));
}

inline auto as_tuple(Detection& seen) {
  return std::tie(seen.step, seen.landmark, seen.range_m, seen.bearing_rad);
}

struct DetectionsFile {
  DetectionLog log;  ///< Bearings in the unit of the file.
  AngleUnit unit = AngleUnit::kRadians;
};

template <typename Visitor>
void fields(Visitor& v, DetectionsFile& file) {
  DetectionLog& log = file.log;
  v.file("mapproof.detections", "What scans showed of M landmarks: range and bearing of each.");
  v.field("landmarks", log.names, record_rules::some_names());
  v.field("unit", file.unit,
          {.description = "Of bearings; rad if left out.", .key = Key::kOptional});
  v.field("steps", log.steps, {.description = "Scans.", .minimum = 1, .maximum = kMostSteps});
  v.field("detections", log.detections,
          {.description = "[scan, landmark, range in m, bearing], both numbered from 0; null: not "
                          "measured. Ascending by scan, then landmark.",
           .nullable = true,
           .min_items = 1});
  if constexpr (Visitor::kReads)
    for (std::size_t i = 0; i < log.detections.size(); ++i) {
      const Detection& seen = log.detections[i];
      const auto location = [i](int column) { return fmt::format("detections/{}/{}", i, column); };
      if (seen.step < 0 || seen.landmark < 0) v.refuse("detections", i, "expected 0 or more");
      if (seen.step >= log.steps) check_at_most(v, location(0), seen.step, 0, log.steps - 1);
      if (seen.landmark >= std::ssize(log.names))
        check_at_most(v, location(1), seen.landmark, 0, static_cast<int>(log.names.size()) - 1);
      if (i > 0 && std::tuple(seen.step, seen.landmark) <=
                       std::tuple(log.detections[i - 1].step, log.detections[i - 1].landmark))
        v.refuse("detections", i, "detections ascend by step, then landmark, none twice");
    }
}

/// mapproof.observations from the text of a file. @param kind  What the values are, if the caller
/// knows: another one is refused. @throws IoError with the location.
ObservationSource parse_observations(std::string_view text, const std::string& source,
                                     std::optional<Sensor> kind);

/// mapproof.detections from the text of a file.
DetectionSource parse_detections(std::string_view text, const std::string& source);

/// mapproof's own JSON (mapproof.observations), NaN as null.
std::string observations_json(const ObservationHistory& history);

/// mapproof's own JSON (mapproof.detections), bearings in radians, NaN as null.
std::string detections_json(const DetectionLog& log);

}  // namespace mapproof
