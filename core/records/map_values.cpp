#include "core/records/map_values.hpp"

#include <limits>

#include <fmt/format.h>

#include "core/json/text_input.hpp"
#include "core/records/certificate_values.hpp"
#include "core/records/json_values.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

Frame read_frame(const JsonCursor& value) {
  const std::string text = value.text();
  if (const std::optional<Frame> frame = frame_named(text)) return *frame;
  value.fail("expected truth or similarity, got " + in_quotes(text));
}

Json truth_value(const MapRecord& map) {
  return map.truth_m ? points_value(*map.truth_m) : Json(nullptr);
}

/// What was mapped and how.
void read_origin(const JsonCursor& object, MapRecord& map, std::vector<std::string_view>& keys) {
  const JsonCursor sensor = object.at("sensor");
  const JsonCursor method = object.at("method");
  map.of_pairs = sensor.text() == kRangeBearing;
  if (!map.of_pairs) {
    map.setting = read_setting(object, keys);
    map.sensor = read_sensor(sensor);
    return;
  }
  if (method.text() != kPairs)
    method.fail("expected pairs for range-bearing, got " + in_quotes(method.text()));
  keys.push_back("method");
  map.sensor = Sensor::kRange;
  map.setting = {Method::kSmacof, std::nullopt};
}

void check_rows(const JsonCursor& value, const Points& points, const MapRecord& map) {
  if (points.rows() != static_cast<Eigen::Index>(map.names.size()))
    value.fail(
        fmt::format("expected {} rows, one a name, got {}", map.names.size(), points.rows()));
}

}  // namespace

void put_landmarks(Json& object, const MapRecord& map) {
  object["names"] = map.names;
  object["anchors"] = indices_value(map.anchors);
  object["truth_m"] = truth_value(map);
}

void read_landmarks(const JsonCursor& object, MapRecord& map) {
  if (const auto names = object.find("names")) map.names = read_names(*names);
  if (const auto anchors = object.find("anchors"))
    map.anchors = read_indices(*anchors, static_cast<Eigen::Index>(map.names.size()));
  if (const auto truth = object.find("truth_m")) {
    map.truth_m.reset();
    if (truth->is_null()) return;
    map.truth_m = read_points(*truth);
    check_rows(*truth, *map.truth_m, map);
  }
}

Json map_value(const MapRecord& map, const MapRecord* shared) {
  Json value = {{"id", map.id}, {"sensor", map.of_pairs ? kRangeBearing : name(map.sensor)}};
  if (map.of_pairs)
    value["method"] = kPairs;
  else
    put_setting(value, map.setting);
  value["step"] = map.step;
  value["frame"] = name(map.frame);
  value["score"] = map.score ? score_value(*map.score) : Json(nullptr);
  if (map.certificate) value["certificate"] = certificate_value(*map.certificate);
  value["statuses"] = statuses_value(map.statuses);
  Json landmarks;
  put_landmarks(landmarks, map);
  Json common;
  if (shared != nullptr) put_landmarks(common, *shared);
  for (auto& [key, item] : landmarks.items())
    if (shared == nullptr || common[key] != item) value[key] = std::move(item);
  value["estimate"] = points_value(map.estimate);
  return value;
}

MapRecord read_map(const JsonCursor& object, const MapRecord* shared,
                   const std::vector<std::string_view>& extra_keys) {
  std::vector<std::string_view> keys = {"id",      "sensor",   "step",       "frame",
                                        "score",   "statuses", "names",      "anchors",
                                        "truth_m", "estimate", "certificate"};
  keys.insert(keys.end(), extra_keys.begin(), extra_keys.end());
  MapRecord map;
  read_origin(object, map, keys);
  object.allow_only(keys);
  map.id = object.at("id").text();
  map.step = object.at("step").integer32(0, kMostSteps);
  map.frame = read_frame(object.at("frame"));
  if (const JsonCursor score = object.at("score"); !score.is_null()) map.score = read_score(score);
  if (const auto certificate = object.find("certificate"))
    map.certificate = read_certificate(*certificate);
  map.statuses = read_statuses(object.at("statuses"));
  if (shared != nullptr) {
    map.names = shared->names;
    map.anchors = shared->anchors;
    map.truth_m = shared->truth_m;
  } else {
    for (const char* key : {"names", "anchors", "truth_m"}) object.at(key);
  }
  read_landmarks(object, map);
  map.estimate = read_points(object.at("estimate"));
  check_rows(object.at("estimate"), map.estimate, map);
  return map;
}

}  // namespace mapproof
