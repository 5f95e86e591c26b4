#include "core/records/observations.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/input_file.hpp"
#include "core/json/json_text.hpp"
#include "core/json/text_input.hpp"
#include "core/records/input_kind.hpp"
#include "core/records/json_values.hpp"
#include "core/records/mrclam.hpp"
#include "core/records/observation_values.hpp"
#include "core/records/sighting_values.hpp"
#include "core/records/table_reader.hpp"

namespace mapproof {
namespace {

std::string value_place(const JsonCursor& rows, std::size_t row, std::size_t column) {
  return fmt::format("{}/{}/{}", rows.pointer(), row, column);
}

}  // namespace

ObservationSource parse_observations(std::string_view text, const std::string& source,
                                     std::optional<Sensor> kind) {
  const JsonDocument document = parse_json(text, source);
  const JsonCursor root = document.cursor();
  expect_schema(root, "mapproof.observations");
  root.allow_only({"schema", "sensor", "unit", "landmarks", "values"});
  ObservationSource result{.history = {.sensor = read_sensor(root.at("sensor")),
                                       .names = read_names(root.at("landmarks")),
                                       .values = {}},
                           .truth_m = std::nullopt,
                           .remarks = {},
                           .places = {},
                           .path = source};
  const Sensor sensor = result.history.sensor;
  if (kind && *kind != sensor)
    root.at("sensor").fail(fmt::format("the file holds {}, not {}", name(sensor), name(*kind)));
  const bool is_degrees =
      sensor == Sensor::kBearing && read_angle_unit(root) == AngleUnit::kDegrees;
  const std::size_t landmarks = result.history.names.size();
  if (landmarks == 0) root.at("landmarks").fail("expected at least one landmark");
  const JsonCursor rows = root.at("values");
  rows.elements(landmarks, landmarks);
  const std::size_t steps = rows.element(0).numbers_or_null(-INFINITY, INFINITY).size();
  if (steps == 0) rows.element(0).fail("expected at least one step");
  check_size(source, rows.pointer(), landmarks, steps);
  result.history.values.resize(static_cast<Eigen::Index>(landmarks),
                               static_cast<Eigen::Index>(steps));
  for (std::size_t i = 0; i < landmarks; ++i) {
    std::vector<double> row = rows.element(i).numbers_or_null(-INFINITY, INFINITY, steps);
    for (std::size_t j = 0; j < steps; ++j) {
      if (is_degrees) row[j] *= std::numbers::pi / 180.0;
      const std::string problem = observation_problem(sensor, row[j]);
      if (!problem.empty()) throw IoError(source, value_place(rows, i, j), problem);
      result.history.values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = row[j];
    }
    result.places.push_back(rows.element(i).pointer());
  }
  return result;
}

std::string observations_json(const ObservationHistory& history) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < history.landmarks(); ++i) {
    nlohmann::ordered_json& row = rows.emplace_back(nlohmann::ordered_json::array());
    for (Eigen::Index j = 0; j < history.steps(); ++j) row.push_back(history.values(i, j));
  }
  return json_text({{"schema", schema_value("mapproof.observations")},
                    {"sensor", name(history.sensor)},
                    {"landmarks", history.names},
                    {"values", std::move(rows)}});
}

ObservationSource observations_of(SightingSource source, Sensor sensor) {
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
  if (layout == Layout::kAuto && is_sightings(source)) {
    if (!kind)
      throw IoError(name,
                    "holds sightings: range-bearing, range, bearing or visibility has to be given");
    return observations_of(read_sightings(source, {.unit = unit, .value = std::nullopt}), *kind);
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
