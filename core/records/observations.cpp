#include "core/records/observations.hpp"

#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/json/json_text.hpp"
#include "core/json/text_input.hpp"
#include "core/records/json_values.hpp"
#include "core/records/mrclam.hpp"
#include "core/records/observation_values.hpp"

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
  root.allow_only({"schema", "sensor", "landmarks", "values"});
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
    const std::vector<double> row = rows.element(i).numbers_or_null(-INFINITY, INFINITY, steps);
    for (std::size_t j = 0; j < steps; ++j) {
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

ObservationSource read_observations(const std::filesystem::path& path, std::optional<Sensor> kind,
                                    Layout layout) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    return read_mrclam(path, kind.value_or(Sensor::kVisibility));
  const std::string source = path.string();
  const std::string bytes = read_file(path);
  const std::string_view text = checked_text(bytes, source);
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  if (path.extension() == ".json" || (start != std::string_view::npos && text[start] == '{'))
    return parse_observations(text, source, kind);
  if (!kind)
    throw IoError(source,
                  "does not say what it holds: visibility, bearing or range has to be given");
  if (layout == Layout::kAuto)
    layout = has_long_header(text, source) ? Layout::kLong : Layout::kWide;
  return layout == Layout::kLong ? read_long(text, source, *kind) : read_wide(text, source, *kind);
}

}  // namespace mapproof
