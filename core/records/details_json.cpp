#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/json/json_text.hpp"
#include "core/json/text_input.hpp"
#include "core/records/json_values.hpp"
#include "core/records/run_json.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

Eigen::VectorXd read_numbers(const JsonCursor& value, std::optional<std::size_t> size = {}) {
  const std::vector<double> numbers = value.numbers_or_null(-kInfinity, kInfinity, size);
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), std::ssize(numbers));
}

Json path_value(const Path& path) {
  return {{"positions_m", points_value(path.positions_m)},
          {"headings_rad", numbers_value(path.headings_rad)}};
}

Path read_path(const JsonCursor& value) {
  value.allow_only({"positions_m", "headings_rad"});
  Path path;
  const std::vector<JsonCursor> rows = value.at("positions_m").elements(1, kMostSteps);
  path.positions_m.resize(std::ssize(rows), 2);
  for (std::size_t i = 0; i < rows.size(); ++i)
    path.positions_m.row(static_cast<Eigen::Index>(i)) = read_numbers(rows[i], 2).transpose();
  path.headings_rad = read_numbers(value.at("headings_rad"), rows.size());
  return path;
}

Json look_value(const SensorDetails& sensor) {
  Json value = {{"step", sensor.look_step}, {"reach_m", sensor.reach_m}};
  Json& views = value["views"] = Json::array();
  for (const View view : sensor.views) views.push_back(name(view));
  value["values"] = numbers_value(sensor.values);
  return value;
}

void read_look(const JsonCursor& value, Eigen::Index path_steps, SensorDetails& sensor) {
  value.allow_only({"step", "reach_m", "views", "values"});
  sensor.look_step = value.at("step").integer32(1, static_cast<int>(path_steps));
  sensor.reach_m = value.at("reach_m").number(0.0, kFarthest_m);
  sensor.values = read_numbers(value.at("values"));
  const JsonCursor views = value.at("views");
  for (const JsonCursor& item : views.elements(0, kMostLandmarks)) {
    const std::optional<View> view = view_named(item.text());
    if (!view) item.fail("expected visible, hidden or out_of_reach, got " + in_quotes(item.text()));
    sensor.views.push_back(*view);
  }
  if (!sensor.views.empty() && std::ssize(sensor.views) != sensor.values.size())
    views.fail(fmt::format("expected {} views, one a value, got {}", sensor.values.size(),
                           sensor.views.size()));
}

Json manifold_value(const ObservationManifold& manifold) {
  Json coordinates = Json::array();
  for (const auto& row : manifold.coordinates.rowwise())
    coordinates.push_back(numbers_value(row.transpose()));
  return {{"coordinates", std::move(coordinates)},
          {"shares", manifold.shares},
          {"K", manifold.neighbours},
          {"edges", manifold.edges}};
}

ObservationManifold read_manifold(const JsonCursor& value, std::size_t landmarks) {
  value.allow_only({"coordinates", "shares", "K", "edges"});
  ObservationManifold manifold;
  const std::vector<JsonCursor> rows = value.at("coordinates").elements(landmarks, landmarks);
  manifold.coordinates.resize(std::ssize(rows), 3);
  for (std::size_t i = 0; i < rows.size(); ++i)
    manifold.coordinates.row(static_cast<Eigen::Index>(i)) = read_numbers(rows[i], 3).transpose();
  const std::vector<double> shares = value.at("shares").numbers_or_null(0.0, 1e9, 3);
  std::ranges::copy(shares, manifold.shares.begin());
  const int last = static_cast<int>(landmarks) - 1;
  manifold.neighbours = value.at("K").integer32(1, std::max(last, 1));
  for (const JsonCursor& edge : value.at("edges").elements(0, landmarks * landmarks)) {
    const std::vector<JsonCursor> ends = edge.elements(2, 2);
    manifold.edges.emplace_back(ends[0].integer32(0, last), ends[1].integer32(0, last));
  }
  return manifold;
}

Json sensor_value(const SensorDetails& sensor) {
  Json first = Json::array();
  for (const auto& row : sensor.first_steps.rowwise())
    first.push_back(numbers_value(row.transpose()));
  Json spectra = Json::array();
  for (const auto& [setting, values] : sensor.spectra) {
    Json& spectrum = spectra.emplace_back(Json::object());
    put_setting(spectrum, setting);
    spectrum["values"] = numbers_value(values);
  }
  Json value = {{"sensor", name(sensor.sensor)},
                {"look", look_value(sensor)},
                {"first_steps", std::move(first)},
                {"step", sensor.step},
                {"distances", numbers_value(sensor.distances)},
                {"spectra", std::move(spectra)}};
  if (sensor.manifold) value["manifold"] = manifold_value(*sensor.manifold);
  return value;
}

SensorDetails read_sensor_details(const JsonCursor& value, Eigen::Index path_steps) {
  value.allow_only({"sensor", "look", "first_steps", "step", "distances", "spectra", "manifold"});
  SensorDetails sensor;
  sensor.sensor = read_sensor(value.at("sensor"));
  read_look(value.at("look"), path_steps, sensor);
  const std::vector<JsonCursor> rows =
      value.at("first_steps")
          .elements(static_cast<std::size_t>(sensor.values.size()),
                    static_cast<std::size_t>(sensor.values.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i == 0)
      sensor.first_steps.resize(std::ssize(rows), static_cast<Eigen::Index>(rows[0].size()));
    sensor.first_steps.row(static_cast<Eigen::Index>(i)) =
        read_numbers(rows[i], rows[0].size()).transpose();
  }
  sensor.step = value.at("step").integer32(1, kMostSteps);
  const auto M = static_cast<std::size_t>(sensor.values.size());
  sensor.distances = read_numbers(value.at("distances"), M * (M - (M > 0)) / 2);
  if (const auto manifold = value.find("manifold")) sensor.manifold = read_manifold(*manifold, M);
  for (const JsonCursor& item : value.at("spectra").elements(0, 1'000'000)) {
    std::vector<std::string_view> keys = {"values"};
    const MethodSetting setting = read_setting(item, keys);
    item.allow_only(keys);
    sensor.spectra.emplace_back(setting, read_numbers(item.at("values")));
  }
  return sensor;
}

}  // namespace

std::string details_json(const RunDetails& details) {
  Json sensors = Json::array();
  for (const SensorDetails& sensor : details.sensors) sensors.push_back(sensor_value(sensor));
  return json_text({{"schema", schema_value("mapproof.details")},
                    {"run", run_id_value(details.id)},
                    {"path", path_value(details.path)},
                    {"sensors", std::move(sensors)}});
}

RunDetails parse_details(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  const JsonCursor root = document.cursor();
  expect_schema(root, "mapproof.details");
  root.allow_only({"schema", "run", "path", "sensors"});
  RunDetails details;
  details.id = read_run_id(root.at("run"));
  details.path = read_path(root.at("path"));
  for (const JsonCursor& sensor : root.at("sensors").elements(0, 100))
    details.sensors.push_back(read_sensor_details(sensor, details.path.positions_m.rows()));
  return details;
}

}  // namespace mapproof
