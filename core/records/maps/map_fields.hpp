#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/model/map_uncertainty.hpp"
#include "core/model/sensor.hpp"
#include "core/records/fit_fields.hpp"
#include "core/records/value_fields.hpp"

namespace mapproof {

// The fields of maps in files (core/json/fields.hpp): of one map alone, and of all of a run.

// What a map was made of, as files name it: a sensor, or one of these two.
enum class MappedSensor {
  kOfSeveral = static_cast<int>(Sensor::kRange) + 1,
  kOfBoth,
};
inline EnumNames enum_names(MappedSensor) {
  static const std::vector<std::string_view> names = [] {
    const EnumNames sensors = enum_names(Sensor{});
    std::vector<std::string_view> all(sensors.names.begin(), sensors.names.end());
    all.insert(all.end(), {kMixed, kRangeBearing});
    return all;
  }();
  return {"mapped_sensor", names};
}

/// The methods of mapproof and what stands for one in other maps.
inline std::span<const std::string_view> mapped_methods() {
  static const std::vector<std::string_view> names = [] {
    const EnumNames methods = enum_names(Method{});
    std::vector<std::string_view> all(methods.names.begin(), methods.names.end());
    all.insert(all.end(), {kPairs, kSpectralMap});
    return all;
  }();
  return names;
}

/// The value that files call so; it must be one.
template <typename Enum>
Enum value_named(std::string_view name) {
  const auto names = enum_names(Enum{}).names;
  return static_cast<Enum>(std::ranges::find(names, name) - names.begin());
}

template <typename Visitor>
void origin_fields(Visitor& v, MapRecord& map) {
  const auto* several = std::get_if<FromSensors>(&map.origin);
  const MethodSetting* setting = setting_of(map);
  auto sensor = value_named<MappedSensor>(sensor_name(map));
  std::string method(method_name(map));
  auto sensors = several != nullptr ? several->sensors : std::vector<Sensor>();
  MethodSetting mapped = setting != nullptr ? *setting : MethodSetting{};
  v.field(
      "sensor", sensor,
      {.description = "mixed: a joint map of several sensors. range-bearing: a map of pair "
                      "distances measured by range and bearing together; its method is pairs."});
  const bool is_joint = sensor == MappedSensor::kOfSeveral;
  v.field("sensors", sensors,
          {.description = "Of a joint map.", .unique = true, .max_items = 3, .key = Key::kIfAny});
  if (is_joint && sensors.empty()) v.refuse("sensor", "mixed needs the key \"sensors\"");
  if (!is_joint && !sensors.empty()) v.refuse("sensors", "is of a joint map alone");
  v.field("method", method,
          {.description = "spectral: a range-only map by factorisation. One of others is described "
                          "by external.",
           .max_bytes = 60,
           .form = &kPlainId,
           .decides = true,
           .known = mapped_methods()});
  const bool is_pairs = method == kPairs, is_spectral = method == kSpectralMap;
  if (is_pairs != (sensor == MappedSensor::kOfBoth))
    v.refuse("method", fmt::format("expected {}, got {}",
                                   is_pairs ? "a method of one sensor" : "pairs for range-bearing",
                                   in_quotes(method)));
  if (is_spectral && sensor != static_cast<MappedSensor>(Sensor::kRange))
    v.refuse("method", "expected spectral for range alone");
  const auto known = mapped_methods();
  method_fields(v, method, std::ranges::find(known, method) != known.end(), mapped);
  if constexpr (Visitor::kReads) {
    if (is_pairs)
      map.origin = FromPairs{};
    else if (is_spectral)
      map.origin = FromRanges{};
    else if (is_joint)
      map.origin = FromSensors{std::move(sensors), mapped};
    else
      map.origin = FromSensor{static_cast<Sensor>(sensor), mapped};
  }
}

/// Whether both are the same, rows that are not there included.
inline bool same_points(const std::optional<Points>& a, const std::optional<Points>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  if (a->rows() != b->rows()) return false;
  for (Eigen::Index i = 0; i < a->rows(); ++i)
    if (a->row(i) != b->row(i) && (a->row(i).allFinite() || b->row(i).allFinite())) return false;
  return true;
}

template <typename Visitor>
void check_row_count(Visitor& v, std::string_view key, const Points& points, const MapRecord& map) {
  if (points.rows() != std::ssize(map.names))
    v.refuse(key,
             fmt::format("expected {} rows, one a name, got {}", map.names.size(), points.rows()));
}

/// @param shared  The maps of one run leave out what is the same there; null: nothing is left out.
template <typename Visitor>
void landmark_fields(Visitor& v, MapRecord& map, const MapRecord* shared) {
  using namespace record_rules;
  const Key key = shared == nullptr ? Key::kRequired : Key::kOptional;
  v.field("names", map.names,
          {.unique = true,
           .max_items = kMostLandmarks,
           .not_empty = true,
           .max_bytes = kLongestName,
           .key = key,
           .written = shared == nullptr || map.names != shared->names});
  v.field("anchors", map.anchors,
          {.description = "Rows of the landmarks whose true position was given, counted from 0.",
           .minimum = 0,
           .maximum = kMostLandmarks - 1,
           .unique = true,
           .max_items = kMostLandmarks,
           .key = key,
           .written = shared == nullptr || map.anchors != shared->anchors});
  check_rows(v, "anchors", map.anchors, std::ssize(map.names));
  v.field(
      "ground_truth_m", map.ground_truth_m,
      {.nullable = true,
       .max_items = kMostLandmarks,
       .key = key,
       .written = shared == nullptr || !same_points(map.ground_truth_m, shared->ground_truth_m)});
  if (map.ground_truth_m) check_row_count(v, "ground_truth_m", *map.ground_truth_m, map);
}

template <typename Visitor>
void map_fields(Visitor& v, MapRecord& map, const MapRecord* shared) {
  using namespace record_rules;
  v.field("id", map.id);
  origin_fields(v, map);
  v.field("step", map.step, kStep);
  v.field("frame", map.frame);
  v.field("score", map.score);
  v.field("certificate", map.certificate, {.key = Key::kIfAny});
  v.field("statuses", map.statuses, kStatuses);
  landmark_fields(v, map, shared);
  v.field("estimate", map.estimate,
          {.description = "In metres if the frame is that of the ground truth.",
           .nullable = true,
           .max_items = kMostLandmarks});
  check_row_count(v, "estimate", map.estimate, map);
}

/// A map by itself.
template <typename Visitor>
void fields(Visitor& v, MapRecord& map) {
  map_fields(v, map, nullptr);
}

template <typename Visitor>
void fields(Visitor& v, MapUncertainty& uncertainty) {
  v.type("uncertainty");
  v.about("Ellipses of a map: (x - position)' C^-1 (x - position) up to squared_radius.");
  v.field("confidence", uncertainty.confidence, {.minimum = 0.0, .maximum = 1.0});
  v.field("squared_radius", uncertainty.squared_radius, {.minimum = 0.0, .maximum = 1e300});
  v.field("replicates", uncertainty.replicates, {.minimum = 0, .maximum = 1e6});
  v.field("maps", uncertainty.maps, {.minimum = 0, .maximum = 1e6});
  if (uncertainty.maps > uncertainty.replicates)
    v.refuse("maps", fmt::format("expected an integer from 0 to {}, got {}", uncertainty.replicates,
                                 uncertainty.maps));
  v.field("block_steps", uncertainty.block_steps, {.minimum = 1, .maximum = kMostSteps});
  v.field(
      "covariances", uncertainty.covariances,
      {.description = "[xx, xy, yy] of each landmark, in the map's unit squared; null: not known.",
       .minimum = -1e300,
       .maximum = 1e300,
       .nullable = true,
       .upper_triangle = true,
       .max_items = kMostLandmarks});
  for (std::size_t i = 0; i < uncertainty.covariances.size(); ++i) {
    const Eigen::Matrix2d& C = uncertainty.covariances[i];
    // Rounding leaves a covariance on one line a little less than singular.
    if (std::min(C(0, 0), C(1, 1)) < 0.0 ||
        std::abs(C(0, 1)) > std::sqrt(C(0, 0)) * std::sqrt(C(1, 1)) * (1.0 + 1e-9))
      v.refuse("covariances", i, "expected a covariance, xy^2 <= xx yy");
  }
}

template <typename Visitor>
void fields(Visitor& v, SensorShare& share) {
  v.field("sensor", share.sensor);
  v.field("reliability", share.reliability, {.minimum = 0.0, .maximum = 1.0});
  v.field("weight", share.weight, {.minimum = 0.0, .maximum = 1.0});
  v.field("share", share.share, {.minimum = 0.0, .maximum = 1.0});
  v.field("continuity", share.continuity, {.minimum = -1e300, .maximum = 1.0, .nullable = true});
}

template <typename Visitor>
void fields(Visitor& v, MapSensors& sensors) {
  v.type("mixed");
  v.about(
      "The sensors of a joint map: how far the distances of each one repeat, its weight in the "
      "start and its share in the joint map, and how well each sensor's own map and the joint "
      "one (continuity) keep the neighbourhoods of all sensors; null: not known.");
  v.field("sensors", sensors.sensors, {.min_items = 1, .max_items = 3});
  v.field("continuity", sensors.continuity, {.minimum = -1e300, .maximum = 1.0, .nullable = true});
}

/// map.json.
struct MapFile {
  MapRecord map;
  std::optional<MapUncertainty> uncertainty;
  std::optional<MapSensors> sensors;
  std::optional<Fit> fit;
};

template <typename Visitor>
void fields(Visitor& v, MapFile& file) {
  v.file("mapproof.map", "One map, of a study or of a user's observations.");
  map_fields(v, file.map, nullptr);
  v.field("uncertainty", file.uncertainty, {.key = Key::kIfAny});
  if (file.uncertainty && file.uncertainty->covariances.size() != file.map.names.size())
    v.refuse("uncertainty/covariances",
             fmt::format("expected {} covariances, one a name, got {}", file.map.names.size(),
                         file.uncertainty->covariances.size()));
  v.field("mixed", file.sensors, {.key = Key::kIfAny});
  v.field("fit", file.fit, {.key = Key::kIfAny});
}

/// A map of many that have landmarks in common.
struct SharingMap {
  MapRecord map;
  const MapRecord* shared = nullptr;
};

template <typename Visitor>
void fields(Visitor& v, SharingMap& sharing) {
  static const MapRecord kNothing;
  map_fields(v, sharing.map, sharing.shared == nullptr ? &kNothing : sharing.shared);
}

/// The maps of a run; a new one has the landmarks that all share.
class SharingMaps {
 public:
  using value_type = SharingMap;

  MapRecord shared;

  SharingMap& emplace_back() { return maps_.emplace_back(shared, &shared); }
  void add(const MapRecord& map) { maps_.emplace_back(map, &shared); }
  void clear() { maps_.clear(); }
  auto begin() const { return maps_.begin(); }
  auto end() const { return maps_.end(); }

 private:
  std::vector<SharingMap> maps_;
};

/// maps/layout-L-pose-P.json.
struct MapsFile {
  RunId run;
  SharingMaps maps;
};

template <typename Visitor>
void fields(Visitor& v, MapsFile& file) {
  v.file("mapproof.maps", "maps/layout-L-pose-P.json: all maps of one run.");
  v.field("run", file.run);
  landmark_fields(v, file.maps.shared, nullptr);
  v.field("maps", file.maps,
          {.description =
               "A map that leaves out names, anchors or ground_truth_m has those of the file.",
           .max_items = record_rules::kMostRecords});
}

}  // namespace mapproof
