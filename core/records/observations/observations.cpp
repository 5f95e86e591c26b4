#include "core/records/observations/observations.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/input_file.hpp"
#include "core/json/record_json.hpp"
#include "core/json/text_input.hpp"
#include "core/records/observations/detection_values.hpp"
#include "core/records/observations/input_kind.hpp"
#include "core/records/observations/mrclam.hpp"
#include "core/records/observations/observation_fields.hpp"
#include "core/records/observations/observation_values.hpp"
#include "core/records/observations/table_reader.hpp"

namespace mapproof {

ObservationSource parse_observations(std::string_view text, const std::string& source,
                                     std::optional<Sensor> kind) {
  const JsonDocument document = parse_json(text, source);
  auto file = from_json_value<ObservationsFile>(document.cursor());
  const Sensor sensor = file.history.sensor;
  Eigen::MatrixXd& values = file.history.values;
  if (kind && *kind != sensor)
    throw IoError(source, "/sensor",
                  fmt::format("the file holds {}, not {}", name(sensor), name(*kind)));
  check_size(source, "/values", file.history.names.size(), static_cast<std::size_t>(values.cols()));
  if (sensor == Sensor::kBearing && file.unit == AngleUnit::kDegrees)
    values = values.unaryExpr([](double degrees) { return in_radians(degrees); });
  ObservationSource result{.history = std::move(file.history),
                           .truth_m = std::nullopt,
                           .remarks = {},
                           .places = {},
                           .path = source};
  for (Eigen::Index i = 0; i < result.history.landmarks(); ++i) {
    for (Eigen::Index j = 0; j < result.history.steps(); ++j)
      if (const auto problem = observation_problem(sensor, result.history.values(i, j));
          !problem.empty())
        throw IoError(source, fmt::format("/values/{}/{}", i, j), problem);
    result.places.push_back(fmt::format("/values/{}", i));
  }
  return result;
}

std::string observations_json(const ObservationHistory& history) {
  return to_json_text(ObservationsFile{.history = history});
}

ObservationSource observations_of(DetectionSource source, Sensor sensor) {
  check_size(source.path, "as a whole", source.log.names.size(),
             static_cast<std::size_t>(source.log.steps));
  ObservationHistory history = history_of(source.log, sensor);
  if (history.values.array().isNaN().all())
    throw IoError(source.path, fmt::format("holds no {}", name(sensor)));
  return {.history = std::move(history),
          .truth_m = std::move(source.truth_m),
          .remarks = std::move(source.remarks),
          .places = std::move(source.places),
          .path = std::move(source.path)};
}

ObservationSource read_observations(ByteSource& source, std::optional<Sensor> kind, Layout layout,
                                    AngleUnit unit) {
  const std::string& name = source.name();
  if (layout == Layout::kAuto && is_detections(source)) {
    if (!kind)
      throw IoError(
          name, "holds detections: range-bearing, range, bearing or visibility has to be given");
    return observations_of(read_detections(source, {.unit = unit, .value = std::nullopt}), *kind);
  }
  const bool holds_json = is_json(source);
  const std::string bytes = source.rest();
  const std::string_view text = checked_text(bytes, name);
  if (holds_json) return parse_observations(text, name, kind);
  if (!kind)
    throw IoError(name, "does not say what it holds: visibility, bearing or range has to be given");
  if (layout == Layout::kAuto) layout = has_long_header(text, name) ? Layout::kLong : Layout::kWide;
  ObservationSource result = layout == Layout::kLong ? read_long(text, name, *kind, unit)
                                                     : read_wide(text, name, *kind, unit);
  if (is_cut_table(text)) result.remarks.emplace_back(kCutRemark);
  return result;
}

ObservationSource read_observations(const std::filesystem::path& path, std::optional<Sensor> kind,
                                    Layout layout, AngleUnit unit) {
  if (is_folder(path)) return read_mrclam(path, kind.value_or(Sensor::kVisibility));
  ByteSource source(path);
  return read_observations(source, kind, layout, unit);
}

}  // namespace mapproof
