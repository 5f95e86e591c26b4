#include "core/records/slam_run_json.hpp"

#include <limits>

#include "core/base/not_finite.hpp"
#include "core/json/json_text.hpp"
#include "core/json/text_input.hpp"
#include "core/records/json_values.hpp"
#include "core/records/provenance_values.hpp"
#include "core/records/slam_experiment_json.hpp"
#include "core/records/slam_values.hpp"
#include "core/records/space_values.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

Json windows_value(const std::optional<WindowCurve>& windows) {
  if (!windows) return nullptr;
  Json held_out = Json::array();
  for (const double error : windows->held_out_m) held_out.push_back(optional_value(error));
  return {{"lengths_s", windows->lengths_s},
          {"held_out_m", std::move(held_out)},
          {"chosen_s", number_value(windows->chosen_s)}};
}

std::optional<WindowCurve> read_windows(const JsonCursor& value) {
  if (value.is_null()) return std::nullopt;
  value.allow_only({"lengths_s", "held_out_m", "chosen_s"});
  const Eigen::VectorXd lengths = read_finite(value.at("lengths_s"));
  WindowCurve windows;
  windows.lengths_s.assign(lengths.begin(), lengths.end());
  windows.held_out_m =
      value.at("held_out_m").numbers_or_null(0.0, kInfinity, windows.lengths_s.size());
  windows.chosen_s = value.at("chosen_s").number(0.0, kInfinity);
  return windows;
}

Json starts_value(const std::vector<RefinementStart>& starts) {
  Json values = Json::array();
  for (const RefinementStart& start : starts)
    values.push_back({{"method", info(start.method).name},
                      {"number", start.number},
                      {"cost", optional_value(start.cost)},
                      {"path_mean_m", optional_value(start.mean_m)},
                      {"iterations", start.iterations},
                      {"converged", start.converged}});
  return values;
}

RefinementStart read_refinement_start(const JsonCursor& value) {
  constexpr int kMost = std::numeric_limits<int>::max();
  value.allow_only({"method", "number", "cost", "path_mean_m", "iterations", "converged"});
  return {.method = read_slam_method(value.at("method")),
          .number = value.at("number").integer32(1, kMost),
          .cost = value.at("cost").number_or_null(-kInfinity, kInfinity),
          .mean_m = read_optional(value.at("path_mean_m")),
          .iterations = value.at("iterations").integer32(0, kMost),
          .converged = value.at("converged").boolean()};
}

/// Empty: the figure has a usual id.
std::string read_figure(const JsonCursor& value) {
  return value.text().empty() ? std::string() : read_id(value);
}

Json point_value(const ConvergencePoint& point) {
  return {{"steps", point.steps},
          {"observation_error", mean_value(point.observation)},
          {"landmarks_m", mean_value(point.landmarks_m)},
          {"positions_m", mean_value(point.positions_m)},
          {"sine", mean_value(point.sine)},
          {"bound", optional_value(point.bound)}};
}

ConvergencePoint read_point(const JsonCursor& value) {
  value.allow_only({"steps", "observation_error", "landmarks_m", "positions_m", "sine", "bound"});
  return {.steps = value.at("steps").integer32(1, kMostSteps),
          .observation = read_mean(value.at("observation_error")),
          .landmarks_m = read_mean(value.at("landmarks_m")),
          .positions_m = read_mean(value.at("positions_m")),
          .sine = read_mean(value.at("sine")),
          .bound = value.at("bound").number_or_null(0.0, kInfinity)};
}

Json history_map_value(const RangeHistoryMap& map) {
  Json value = Json::object();
  if (map.setting) put_setting(value, *map.setting);
  value["squared"] = map.squared;
  value["score"] = map.score ? score_value(*map.score) : Json(nullptr);
  value["statuses"] = statuses_value(map.statuses);
  value["positions_m"] = points_value(map.positions_m);
  return value;
}

RangeHistoryMap read_history_map(const JsonCursor& value, Eigen::Index landmarks) {
  std::vector<std::string_view> keys = {"squared", "score", "statuses", "positions_m"};
  RangeHistoryMap map;
  if (value.find("method")) map.setting = read_setting(value, keys);
  value.allow_only(keys);
  map.squared = value.at("squared").boolean();
  if (const JsonCursor score = value.at("score"); !score.is_null()) map.score = read_score(score);
  map.statuses = read_statuses(value.at("statuses"));
  map.positions_m = read_points(value.at("positions_m"));
  if (map.positions_m.rows() != landmarks)
    value.at("positions_m").fail("expected a place, or null, for each landmark");
  return map;
}

}  // namespace

std::string slam_run_json(const SlamRun& run) {
  Json records = Json::array();
  for (const SlamRecord& record : run.records) records.push_back(slam_record_value(record));
  return json_text({{"schema", schema_value("mapproof.slam_run")},
                    {"id", run.id},
                    {"figure", run.figure},
                    {"simulated", run.simulated},
                    {"log", range_log_value(run.log)},
                    {"known", indices_value(run.known)},
                    {"windows", windows_value(run.windows)},
                    {"records", std::move(records)},
                    {"starts", starts_value(run.starts)},
                    {"upgrade", run.upgrade ? upgrade_value(*run.upgrade) : Json(nullptr)},
                    {"published", published_drive_value(run.published)}});
}

SlamRun parse_slam_run(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  const JsonCursor root = document.cursor();
  expect_schema(root, "mapproof.slam_run");
  root.allow_only({"schema", "id", "figure", "simulated", "log", "known", "windows", "records",
                   "starts", "upgrade", "published"});
  SlamRun run;
  run.id = read_id(root.at("id"));
  run.figure = read_figure(root.at("figure"));
  run.simulated = root.at("simulated").boolean();
  run.log = read_range_log_value(root.at("log"));
  const auto landmarks = static_cast<Eigen::Index>(run.log.landmarks.size());
  run.known = read_indices(root.at("known"), landmarks);
  run.windows = read_windows(root.at("windows"));
  for (const JsonCursor& record : root.at("records").elements(0, all_slam_methods().size()))
    run.records.push_back(read_slam_record(record, landmarks));
  for (const JsonCursor& start : root.at("starts").elements(0, 1000))
    run.starts.push_back(read_refinement_start(start));
  // Not in studies of older versions.
  if (const auto upgrade = root.find("upgrade"); upgrade && !upgrade->is_null())
    run.upgrade = read_upgrade(*upgrade);
  run.published = read_published_drive(root.at("published"));
  return run;
}

std::string convergence_json(const ConvergenceCurve& curve) {
  Json points = Json::array();
  for (const ConvergencePoint& point : curve.points) points.push_back(point_value(point));
  return json_text({{"schema", schema_value("mapproof.slam_convergence")},
                    {"id", curve.id},
                    {"title", curve.title},
                    {"landmarks", curve.landmarks},
                    {"slope", optional_value(curve.slope)},
                    {"points", std::move(points)}});
}

ConvergenceCurve parse_convergence(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  const JsonCursor root = document.cursor();
  expect_schema(root, "mapproof.slam_convergence");
  root.allow_only({"schema", "id", "title", "landmarks", "slope", "points"});
  ConvergenceCurve curve{.id = read_id(root.at("id")),
                         .title = root.at("title").text(200),
                         .landmarks = root.at("landmarks").integer32(1, kMostLandmarks),
                         .points = {},
                         .slope = root.at("slope").number_or_null(-kInfinity, kInfinity)};
  for (const JsonCursor& point : root.at("points").elements(0, 1000))
    curve.points.push_back(read_point(point));
  return curve;
}

std::string range_histories_json(const RangeHistoryStudy& histories) {
  Json maps = Json::array();
  for (const RangeHistoryMap& map : histories.maps) maps.push_back(history_map_value(map));
  return json_text({{"schema", schema_value("mapproof.range_histories")},
                    {"steps", histories.steps},
                    {"landmarks_m", points_value(histories.landmarks_m)},
                    {"maps", std::move(maps)}});
}

RangeHistoryStudy parse_range_histories(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  const JsonCursor root = document.cursor();
  expect_schema(root, "mapproof.range_histories");
  root.allow_only({"schema", "steps", "landmarks_m", "maps"});
  RangeHistoryStudy histories;
  histories.steps = root.at("steps").integer32(1, kMostSteps);
  histories.landmarks_m = read_points(root.at("landmarks_m"));
  for (const JsonCursor& map : root.at("maps").elements(0, 1000))
    histories.maps.push_back(read_history_map(map, histories.landmarks_m.rows()));
  return histories;
}

std::string slam_study_json(const SlamExperiment& experiment, const Provenance& provenance) {
  return json_text({{"schema", schema_value("mapproof.slam_study")},
                    {"experiment", slam_experiment_value(experiment)},
                    {"provenance", provenance_value(provenance)}});
}

SlamOrder parse_slam_study(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  const JsonCursor root = document.cursor();
  expect_schema(root, "mapproof.slam_study");
  root.allow_only({"schema", "experiment", "provenance"});
  return {.experiment = read_slam_experiment(root.at("experiment")),
          .provenance = read_provenance(root.at("provenance"))};
}

}  // namespace mapproof
