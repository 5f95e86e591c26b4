#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/json/text_input.hpp"
#include "core/records/experiment_values.hpp"
#include "core/records/json_values.hpp"

namespace mapproof {
namespace {

constexpr double kLongest_m = 1000.0;

void read_sensor_options(const JsonCursor& object, SensorOptions& options) {
  const bool is_visibility = options.sensor == Sensor::kVisibility;
  if (is_visibility) {
    read_if_there(object, "visual_angle_rad", 1e-6, std::numbers::pi, options.visual_angle_rad);
    if (const auto occlusion = object.find("occlusion")) options.occlusion = occlusion->boolean();
  } else {
    read_if_there(object, "reach_m", 1e-6, kLongest_m, options.reach_m);
  }
  read_if_there(object, "noise", 0.0, is_visibility ? 0.5 : kLongest_m, options.noise);
  read_if_there(object, "dropout_share", 0.0, 0.99, options.dropout_share);
}

SensorStudy read_sensor_study(Sensor sensor, const JsonCursor& object, std::optional<int> steps) {
  std::vector<std::string_view> keys = {"noise", "dropout_share", "methods"};
  if (!steps) keys.insert(keys.end(), {"checkpoints", "published"});
  if (sensor == Sensor::kVisibility)
    keys.insert(keys.end(), {"visual_angle_rad", "occlusion"});
  else
    keys.push_back("reach_m");
  object.allow_only(keys);
  SensorStudy study;
  study.sensor.sensor = sensor;
  read_sensor_options(object, study.sensor);
  if (steps)
    study.checkpoints = {*steps};
  else
    study.checkpoints = read_ascending<int>(object.at("checkpoints"), [](const JsonCursor& item) {
      return item.integer32(3, kMostSteps);
    });
  study.methods = read_methods(object.at("methods"));
  if (const auto published = object.find("published")) study.published = read_published(*published);
  return study;
}

AffineFit read_affine_fit(const JsonCursor& value) {
  const std::string text = value.text();
  if (const std::optional<AffineFit> fit = affine_fit_named(text)) return *fit;
  value.fail("expected least_distances or least_squares, got " + in_quotes(text));
}

void read_solver(const JsonCursor& object, SolverOptions& solver) {
  object.allow_only({"smacof_relative_fall", "smacof_knn_relative_fall", "only_seen_together"});
  read_if_there(object, "smacof_relative_fall", 0.0, 1.0, solver.smacof_relative_fall);
  read_if_there(object, "smacof_knn_relative_fall", 0.0, 1.0, solver.smacof_knn_relative_fall);
  if (const auto only = object.find("only_seen_together"))
    solver.only_seen_together = only->boolean();
}

}  // namespace

std::vector<SensorStudy> read_sensors(const JsonCursor& object, std::optional<int> steps) {
  object.allow_only({"visibility", "bearing", "range"});
  std::vector<SensorStudy> studies;
  for (const Sensor sensor : {Sensor::kVisibility, Sensor::kBearing, Sensor::kRange})
    if (const auto found = object.find(std::string(name(sensor))))
      studies.push_back(read_sensor_study(sensor, *found, steps));
  if (studies.empty()) object.fail("expected at least one of visibility, bearing, range");
  return studies;
}

WorldOptions read_world_options(const JsonCursor& object) {
  object.allow_only({"side_m", "landmarks", "landmark_diameter_m", "gap_m", "wall_margin_m"});
  WorldOptions world;
  read_if_there(object, "side_m", 0.01, kLongest_m, world.side_m);
  read_if_there(object, "landmarks", 4, kMostLandmarks, world.landmarks);
  read_if_there(object, "landmark_diameter_m", 1e-6, kLongest_m, world.landmark_diameter_m);
  read_if_there(object, "gap_m", 0.0, kLongest_m, world.gap_m);
  read_if_there(object, "wall_margin_m", 0.0, kLongest_m, world.wall_margin_m);
  return world;
}

WalkOptions read_walk_options(const JsonCursor& object) {
  object.allow_only({"step_m", "turn_rad", "substep_m", "clearance_m", "wall_margin_m"});
  WalkOptions walk;
  read_if_there(object, "step_m", 1e-4, kLongest_m, walk.step_m);
  read_if_there(object, "turn_rad", 0.0, std::numbers::pi, walk.turn_rad);
  read_if_there(object, "substep_m", 1e-4, kLongest_m, walk.substep_m);
  read_if_there(object, "clearance_m", 0.0, kLongest_m, walk.clearance_m);
  read_if_there(object, "wall_margin_m", 0.0, kLongest_m, walk.wall_margin_m);
  return walk;
}

Experiment read_experiment(const JsonCursor& document) {
  expect_schema(document, "mapproof.experiment");
  document.allow_only({"schema", "name", "title", "seed", "layouts", "poses", "world", "walk",
                       "anchors", "anchor_placement", "affine_fit", "solver", "sensors",
                       "variations", "figures"});
  Experiment experiment;
  experiment.name = read_study_name(document.at("name"));
  experiment.title = experiment.name;
  if (const auto title = document.find("title")) experiment.title = title->text(200);
  if (const auto seed = document.find("seed")) experiment.seed = seed->unsigned_integer();
  read_if_there(document, "layouts", 1, kMostLayouts, experiment.layouts);
  read_if_there(document, "poses", 1, kMostPoses, experiment.poses);
  if (const auto world = document.find("world")) experiment.world = read_world_options(*world);
  if (const auto walk = document.find("walk")) experiment.walk = read_walk_options(*walk);
  read_if_there(document, "anchors", 3, 1000, experiment.anchors);
  if (const auto fit = document.find("affine_fit")) experiment.affine_fit = read_affine_fit(*fit);
  if (const auto placement = document.find("anchor_placement"))
    experiment.anchor_placement = read_anchor_placement(*placement);
  if (const auto solver = document.find("solver")) read_solver(*solver, experiment.solver);
  experiment.sensors = read_sensors(document.at("sensors"));
  read_extras(document, experiment);
  check_experiment(experiment, document);
  return experiment;
}

}  // namespace mapproof
