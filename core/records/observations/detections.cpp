#include "core/records/observations/detections.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/input_file.hpp"
#include "core/json/record_json.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/observations/detection_columns.hpp"
#include "core/records/observations/detection_values.hpp"
#include "core/records/observations/input_kind.hpp"
#include "core/records/observations/mrclam.hpp"
#include "core/records/observations/observation_fields.hpp"
#include "core/records/observations/observation_values.hpp"
#include "core/records/observations/table_stream.hpp"

namespace mapproof {
namespace {

constexpr const char* kDetectionsSchema = "mapproof.detections";

}  // namespace

std::optional<double> detection_value(std::string_view cell, Sensor sensor, AngleUnit unit) {
  if (sensor != Sensor::kBearing || unit == AngleUnit::kRadians || is_missing(cell))
    return observation_in(cell, sensor);
  const std::optional<double> degrees = number_in(cell);
  if (!degrees || !(std::abs(*degrees) <= 360.0 + 1e-3)) return std::nullopt;
  return in_radians(*degrees);
}

std::string detection_problem(std::string_view cell, Sensor sensor, AngleUnit unit) {
  const std::optional<double> degrees = number_in(cell);
  if (sensor == Sensor::kBearing && unit == AngleUnit::kDegrees && degrees &&
      std::isfinite(*degrees))
    return fmt::format("bearings are within a full turn of 360 degrees, got {}", *degrees);
  return cell_problem(cell, sensor);
}

DetectionSource parse_detections(std::string_view text, const std::string& source) {
  auto [log, unit] = from_json_text<DetectionsFile>(text, source);
  check_size(source, "/landmarks", log.names.size(), 1);
  DetectionSource result{
      .log = std::move(log), .truth_m = {}, .remarks = {}, .places = {}, .path = source};
  for (std::size_t i = 0; i < result.log.names.size(); ++i)
    result.places.push_back(fmt::format("/landmarks/{}", i));
  for (std::size_t i = 0; i < result.log.detections.size(); ++i) {
    Detection& seen = result.log.detections[i];
    if (unit == AngleUnit::kDegrees) seen.bearing_rad = in_radians(seen.bearing_rad);
    for (const auto& [column, sensor, value] : {std::tuple(2, Sensor::kRange, seen.range_m),
                                                std::tuple(3, Sensor::kBearing, seen.bearing_rad)})
      if (const auto problem = observation_problem(sensor, value); !problem.empty())
        throw IoError(source, fmt::format("/detections/{}/{}", i, column), problem);
  }
  return result;
}

std::string detections_json(const DetectionLog& log) {
  return to_json_text(DetectionsFile{.log = log});
}

bool is_detections(ByteSource& source) {
  if (is_json(source)) return json_schema(source) == kDetectionsSchema;
  return first_row_is(source, names_detection_columns);
}

bool is_large_long_table(ByteSource& source) {
  constexpr std::size_t kLarge = 64'000'000;
  if (is_json(source)) return false;
  const auto is_long = [](const TableRow& row) {
    return names_detection_columns(row) || names_value_columns(row);
  };
  return first_row_is(source, is_long) && source.holds_more_than(kLarge);
}

DetectionSource read_detections(ByteSource& source, const DetectionFormat& format) {
  if (!is_json(source)) return read_long_detections(source, format);
  const std::string bytes = source.rest();
  return parse_detections(checked_text(bytes, source.name()), source.name());
}

DetectionSource read_detections(const std::filesystem::path& path, const DetectionFormat& format) {
  if (is_folder(path)) return read_mrclam_detections(path);
  ByteSource source(path);
  return read_detections(source, format);
}

}  // namespace mapproof
