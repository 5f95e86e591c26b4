#include "core/records/experiment_json.hpp"

#include <utility>

#include "core/json/json_text.hpp"
#include "core/records/experiment_values.hpp"
#include "core/records/json_values.hpp"
#include "core/records/profiles.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kExperimentSchema = "mapproof.experiment";

Json sensor_value(const SensorStudy& study, bool has_checkpoints) {
  Json value = Json::object();
  if (study.sensor.sensor == Sensor::kVisibility) {
    value["visual_angle_rad"] = study.sensor.visual_angle_rad;
    value["occlusion"] = study.sensor.occlusion;
  }
  value["noise"] = study.sensor.noise;
  value["dropout_share"] = study.sensor.dropout_share;
  if (study.sensor.reach_m > 0.0) value["reach_m"] = study.sensor.reach_m;
  if (has_checkpoints) value["checkpoints"] = study.checkpoints;
  value["methods"] = methods_value(study.methods);
  if (!study.published.source.empty()) value["published"] = published_value(study.published);
  return value;
}

}  // namespace

Json sensors_value(const std::vector<SensorStudy>& sensors, std::optional<int> steps) {
  Json value = Json::object();
  for (const SensorStudy& study : sensors)
    value[std::string(name(study.sensor.sensor))] = sensor_value(study, !steps);
  return value;
}

Json world_value(const WorldOptions& world) {
  return {{"side_m", world.side_m},
          {"landmarks", world.landmarks},
          {"landmark_diameter_m", world.landmark_diameter_m},
          {"gap_m", world.gap_m},
          {"wall_margin_m", world.wall_margin_m}};
}

Json walk_value(const WalkOptions& walk) {
  return {{"step_m", walk.step_m},
          {"turn_rad", walk.turn_rad},
          {"substep_m", walk.substep_m},
          {"clearance_m", walk.clearance_m},
          {"wall_margin_m", walk.wall_margin_m}};
}

Json experiment_value(const Experiment& experiment) {
  Json value = {{"schema", schema_value(kExperimentSchema)},
                {"name", experiment.name},
                {"title", experiment.title},
                {"seed", experiment.seed},
                {"layouts", experiment.layouts},
                {"poses", experiment.poses},
                {"world", world_value(experiment.world)},
                {"walk", walk_value(experiment.walk)},
                {"anchors", experiment.anchors},
                {"anchor_placement", name(experiment.anchor_placement)},
                {"affine_fit", name(experiment.affine_fit)},
                {"solver",
                 {{"smacof_relative_fall", experiment.solver.smacof_relative_fall},
                  {"smacof_knn_relative_fall", experiment.solver.smacof_knn_relative_fall},
                  {"only_seen_together", experiment.solver.only_seen_together}}},
                {"sensors", sensors_value(experiment.sensors)}};
  put_extras(value, experiment);
  return value;
}

std::string experiment_json(const Experiment& experiment) {
  return json_text(experiment_value(experiment));
}

Experiment parse_experiment(std::string_view text, const std::string& source,
                            const std::string& profile) {
  const JsonDocument document = parse_with_profile(text, source, kExperimentSchema, profile);
  return read_experiment(document.cursor());
}

std::vector<std::string> profiles(std::string_view text, const std::string& source) {
  return profile_names(text, source, kExperimentSchema);
}

}  // namespace mapproof
