#include "core/records/sightings.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/input_file.hpp"
#include "core/json/json_text.hpp"
#include "core/json/text_input.hpp"
#include "core/records/input_kind.hpp"
#include "core/records/json_values.hpp"
#include "core/records/limits.hpp"
#include "core/records/mrclam.hpp"
#include "core/records/observation_values.hpp"
#include "core/records/sighting_columns.hpp"
#include "core/records/sighting_values.hpp"
#include "core/records/table_stream.hpp"

namespace mapproof {
namespace {

constexpr const char* kSightingsSchema = "mapproof.sightings";

double read_value(const JsonCursor& value, Sensor sensor, AngleUnit unit) {
  const double number = value.number_or_null(-INFINITY, INFINITY);
  const bool is_degrees = sensor == Sensor::kBearing && unit == AngleUnit::kDegrees;
  const double inner = is_degrees ? number * std::numbers::pi / 180.0 : number;
  if (const std::string problem = observation_problem(sensor, inner); !problem.empty())
    value.fail(problem);
  return inner;
}

}  // namespace

std::optional<double> sighting_value(std::string_view cell, Sensor sensor, AngleUnit unit) {
  if (sensor != Sensor::kBearing || unit == AngleUnit::kRadians || is_missing(cell))
    return observation_in(cell, sensor);
  const std::optional<double> degrees = number_in(cell);
  if (!degrees || !(std::abs(*degrees) <= 360.0 + 1e-3)) return std::nullopt;
  return *degrees * std::numbers::pi / 180.0;
}

std::string sighting_problem(std::string_view cell, Sensor sensor, AngleUnit unit) {
  const std::optional<double> degrees = number_in(cell);
  if (sensor == Sensor::kBearing && unit == AngleUnit::kDegrees && degrees &&
      std::isfinite(*degrees))
    return fmt::format("bearings are within a full turn of 360 degrees, got {}", *degrees);
  return cell_problem(cell, sensor);
}

AngleUnit read_angle_unit(const JsonCursor& object) {
  const auto unit = object.find("unit");
  if (!unit) return AngleUnit::kRadians;
  const std::string word = unit->text();
  if (word == "rad") return AngleUnit::kRadians;
  if (word == "deg") return AngleUnit::kDegrees;
  unit->fail("expected rad or deg, got " + in_quotes(word));
}

SightingSource parse_sightings(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  const JsonCursor root = document.cursor();
  expect_schema(root, kSightingsSchema);
  root.allow_only({"schema", "landmarks", "unit", "steps", "sightings"});
  const AngleUnit unit = read_angle_unit(root);
  SightingSource result{.log = {}, .truth_m = {}, .remarks = {}, .places = {}, .path = source};
  SightingLog& log = result.log;
  log.names = read_names(root.at("landmarks"));
  log.steps = root.at("steps").integer32(1, kMostSteps);
  check_size(source, "/landmarks", log.names.size(), 1);
  for (std::size_t i = 0; i < log.names.size(); ++i)
    result.places.push_back(fmt::format("/landmarks/{}", i));
  for (const JsonCursor& row : root.at("sightings").elements()) {
    row.elements(4, 4);
    const Sighting seen{
        .step = row.element(0).integer32(0, log.steps - 1),
        .landmark = row.element(1).integer32(0, static_cast<int>(log.names.size()) - 1),
        .range_m = read_value(row.element(2), Sensor::kRange, unit),
        .bearing_rad = read_value(row.element(3), Sensor::kBearing, unit)};
    if (!log.sightings.empty() &&
        std::tuple(seen.step, seen.landmark) <=
            std::tuple(log.sightings.back().step, log.sightings.back().landmark))
      row.fail("sightings ascend by step, then landmark, none twice");
    log.sightings.push_back(seen);
  }
  if (log.sightings.empty()) root.at("sightings").fail("expected at least one sighting");
  return result;
}

std::string sightings_json(const SightingLog& log) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Sighting& seen : log.sightings)
    rows.push_back({seen.step, seen.landmark, seen.range_m, seen.bearing_rad});
  return json_text({{"schema", schema_value(kSightingsSchema)},
                    {"landmarks", log.names},
                    {"unit", "rad"},
                    {"steps", log.steps},
                    {"sightings", std::move(rows)}});
}

bool is_sightings(ByteSource& source) {
  if (is_json(source)) return json_schema(source) == kSightingsSchema;
  return first_row_is(source, names_sighting_columns);
}

bool is_large_long_table(ByteSource& source) {
  constexpr std::size_t kLarge = 64'000'000;
  if (is_json(source)) return false;
  const auto is_long = [](const TableRow& row) {
    return names_sighting_columns(row) || names_value_columns(row);
  };
  return first_row_is(source, is_long) && source.holds_more_than(kLarge);
}

SightingSource read_sightings(ByteSource& source, const SightingFormat& format) {
  if (!is_json(source)) return read_long_sightings(source, format);
  const std::string bytes = source.rest();
  return parse_sightings(checked_text(bytes, source.name()), source.name());
}

SightingSource read_sightings(const std::filesystem::path& path, const SightingFormat& format) {
  if (is_folder(path)) return read_mrclam_sightings(path);
  ByteSource source(path);
  return read_sightings(source, format);
}

}  // namespace mapproof
