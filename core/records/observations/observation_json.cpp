#include "core/records/observations/observation_json.hpp"

#include <tuple>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/json/record_reader.hpp"
#include "core/json/record_writer.hpp"
#include "core/records/tables/cells.hpp"

namespace mapproof {

ObservationSource parse_observations(std::string_view text, const std::string& source,
                                     std::optional<Sensor> kind) {
  auto file = from_json_text<ObservationsFile>(text, source);
  const Sensor sensor = file.history.sensor;
  Eigen::MatrixXd& values = file.history.values;
  if (kind && *kind != sensor)
    throw IoError(source, "/sensor",
                  fmt::format("the file holds {}, not {}", name(sensor), name(*kind)));
  check_size(source, "/values", file.history.names.size(), static_cast<std::size_t>(values.cols()));
  if (sensor == Sensor::kBearing && file.unit == AngleUnit::kDegrees)
    values = values.unaryExpr([](double degrees) { return in_radians(degrees); });
  ObservationSource result{.history = std::move(file.history),
                           .ground_truth_m = std::nullopt,
                           .remarks = {},
                           .locations = {},
                           .path = source};
  result.locations.reserve(result.history.names.size());
  for (Eigen::Index i = 0; i < result.history.landmarks(); ++i) {
    for (Eigen::Index j = 0; j < result.history.steps(); ++j)
      if (const auto problem = observation_problem(sensor, result.history.values(i, j));
          !problem.empty())
        throw IoError(source, fmt::format("/values/{}/{}", i, j), problem);
    result.locations.push_back(fmt::format("/values/{}", i));
  }
  return result;
}

std::string observations_json(const ObservationHistory& history) {
  return to_json_text(ObservationsFile{.history = history});
}

DetectionSource parse_detections(std::string_view text, const std::string& source) {
  auto [log, unit] = from_json_text<DetectionsFile>(text, source);
  check_size(source, "/landmarks", log.names.size(), 1);
  DetectionSource result{
      .log = std::move(log), .ground_truth_m = {}, .remarks = {}, .locations = {}, .path = source};
  for (std::size_t i = 0; i < result.log.names.size(); ++i)
    result.locations.push_back(fmt::format("/landmarks/{}", i));
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

}  // namespace mapproof
