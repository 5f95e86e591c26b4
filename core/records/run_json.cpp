#include "core/records/run_json.hpp"

#include <cmath>
#include <limits>

#include "core/base/not_finite.hpp"
#include "core/json/json_text.hpp"
#include "core/records/certificate_values.hpp"
#include "core/records/experiment_values.hpp"
#include "core/records/json_values.hpp"
#include "core/records/map_values.hpp"
#include "core/records/provenance_values.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMostIterations = std::numeric_limits<int>::max();
constexpr std::size_t kMostRecords = 1'000'000;

Json world_value(const World& world) {
  return {{"side_m", world.side_m},
          {"landmark_diameter_m", world.landmark_diameter_m},
          {"landmarks_m", points_value(world.landmarks_m)}};
}

World read_world(const JsonCursor& value) {
  value.allow_only({"side_m", "landmark_diameter_m", "landmarks_m"});
  return {.side_m = value.at("side_m").number(0.0, kFarthest_m),
          .landmark_diameter_m = value.at("landmark_diameter_m").number(0.0, kFarthest_m),
          .landmarks_m = read_points(value.at("landmarks_m"))};
}

Json record_value(const RunRecord& record) {
  Json value = {{"sensor", name(record.sensor)}};
  put_setting(value, record.setting);
  value["step"] = record.step;
  value["score"] = record.score ? score_value(*record.score) : Json(nullptr);
  value["iterations"] = record.iterations;
  value["stress"] = record.stress ? Json(*record.stress) : Json(nullptr);
  if (record.certificate) value["certificate"] = certificate_value(*record.certificate);
  value["statuses"] = statuses_value(record.statuses);
  return value;
}

RunRecord read_record(const JsonCursor& value) {
  std::vector<std::string_view> keys = {"sensor", "step",     "score",      "iterations",
                                        "stress", "statuses", "certificate"};
  RunRecord record;
  record.setting = read_setting(value, keys);
  value.allow_only(keys);
  record.sensor = read_sensor(value.at("sensor"));
  record.step = value.at("step").integer32(0, kMostSteps);
  if (const JsonCursor score = value.at("score"); !score.is_null())
    record.score = read_score(score);
  record.iterations = value.at("iterations").integer32(0, kMostIterations);
  if (const JsonCursor stress = value.at("stress"); !stress.is_null())
    record.stress = stress.number(-kInfinity, kInfinity);
  if (const auto certificate = value.find("certificate"))
    record.certificate = read_certificate(*certificate);
  record.statuses = read_statuses(value.at("statuses"));
  return record;
}

Json occlusion_value(const std::optional<Occlusion>& occlusion) {
  if (!occlusion) return nullptr;
  return {{"within_reach", occlusion->within_reach}, {"hidden", occlusion->hidden}};
}

std::optional<Occlusion> read_occlusion(const JsonCursor& value) {
  if (value.is_null()) return std::nullopt;
  constexpr std::int64_t kMostLooks = std::int64_t{kMostLandmarks} * kMostSteps;
  value.allow_only({"within_reach", "hidden"});
  Occlusion occlusion;
  occlusion.within_reach = value.at("within_reach").integer(0, kMostLooks);
  occlusion.hidden = value.at("hidden").integer(0, occlusion.within_reach);
  return occlusion;
}

Json variation_record_value(const VariationRecord& record) {
  Json value = {{"variation", record.variation}, {"level", number_value(record.level)}};
  put_setting(value, record.setting);
  value["score"] = record.score ? score_value(*record.score) : Json(nullptr);
  value["statuses"] = statuses_value(record.statuses);
  return value;
}

VariationRecord read_variation_record(const JsonCursor& value) {
  std::vector<std::string_view> keys = {"variation", "level", "score", "statuses"};
  VariationRecord record;
  record.setting = read_setting(value, keys);
  value.allow_only(keys);
  record.variation = value.at("variation").text(64);
  record.level = value.at("level").number(-kInfinity, kInfinity);
  if (const JsonCursor score = value.at("score"); !score.is_null())
    record.score = read_score(score);
  record.statuses = read_statuses(value.at("statuses"));
  return record;
}

}  // namespace

std::string run_json(const Run& run) {
  Json records = Json::array();
  for (const RunRecord& record : run.records) records.push_back(record_value(record));
  Json variations = Json::array();
  for (const VariationRecord& record : run.variations)
    variations.push_back(variation_record_value(record));
  return json_text({{"schema", schema_value("mapproof.run")},
                    {"run", run_id_value(run.id)},
                    {"world", world_value(run.world)},
                    {"anchors", indices_value(run.anchors)},
                    {"occlusion", occlusion_value(run.occlusion)},
                    {"records", std::move(records)},
                    {"variations", std::move(variations)}});
}

Run parse_run(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  const JsonCursor root = document.cursor();
  expect_schema(root, "mapproof.run");
  root.allow_only({"schema", "run", "world", "anchors", "occlusion", "records", "variations"});
  Run run;
  run.id = read_run_id(root.at("run"));
  run.world = read_world(root.at("world"));
  run.anchors = read_indices(root.at("anchors"), run.world.landmarks_m.rows());
  for (const JsonCursor& record : root.at("records").elements(0, kMostRecords))
    run.records.push_back(read_record(record));
  // Studies made before there were variations do not have these.
  if (const auto occlusion = root.find("occlusion")) run.occlusion = read_occlusion(*occlusion);
  if (const auto variations = root.find("variations"))
    for (const JsonCursor& record : variations->elements(0, kMostRecords))
      run.variations.push_back(read_variation_record(record));
  return run;
}

std::string maps_json(const RunMaps& maps) {
  const MapRecord shared = maps.maps.empty() ? MapRecord{} : maps.maps.front();
  Json value = {{"schema", schema_value("mapproof.maps")}, {"run", run_id_value(maps.run)}};
  put_landmarks(value, shared);
  value["maps"] = Json::array();
  for (const MapRecord& map : maps.maps) value["maps"].push_back(map_value(map, &shared));
  return json_text(value);
}

RunMaps parse_maps(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  const JsonCursor root = document.cursor();
  expect_schema(root, "mapproof.maps");
  root.allow_only({"schema", "run", "names", "anchors", "truth_m", "maps"});
  for (const char* key : {"names", "anchors", "truth_m"}) root.at(key);
  RunMaps maps;
  maps.run = read_run_id(root.at("run"));
  MapRecord shared;
  read_landmarks(root, shared);
  for (const JsonCursor& map : root.at("maps").elements(0, kMostRecords))
    maps.maps.push_back(read_map(map, &shared));
  return maps;
}

std::string study_json(const Experiment& experiment, const Provenance& provenance) {
  return json_text({{"schema", schema_value("mapproof.study")},
                    {"experiment", experiment_value(experiment)},
                    {"provenance", provenance_value(provenance)}});
}

Study parse_study(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  const JsonCursor root = document.cursor();
  expect_schema(root, "mapproof.study");
  root.allow_only({"schema", "experiment", "provenance"});
  return {.experiment = read_experiment(root.at("experiment")),
          .provenance = read_provenance(root.at("provenance")),
          .runs = {}};
}

}  // namespace mapproof
