#include "core/records/experiment_json.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/spelling.hpp"
#include "core/json/json_text.hpp"
#include "core/json/text_input.hpp"
#include "core/records/experiment_values.hpp"
#include "core/records/json_values.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

Json sensor_value(const SensorStudy& study) {
  Json value = Json::object();
  if (study.sensor.sensor == Sensor::kVisibility) {
    value["visual_angle_rad"] = study.sensor.visual_angle_rad;
    value["occlusion"] = study.sensor.occlusion;
  }
  value["noise"] = study.sensor.noise;
  value["dropout_share"] = study.sensor.dropout_share;
  value["checkpoints"] = study.checkpoints;
  value["methods"] = methods_value(study.methods);
  if (!study.published.source.empty()) value["published"] = published_value(study.published);
  return value;
}

/// "it has "a", "b" and 3 more": at most five of them.
std::string known_profiles(const std::vector<std::pair<std::string, JsonCursor>>& profiles) {
  constexpr std::size_t kShown = 5;
  if (profiles.empty()) return "it has none";
  std::vector<std::string> shown;
  for (std::size_t i = 0; i < std::min(profiles.size(), kShown); ++i)
    shown.push_back(in_quotes(profiles[i].first));
  const std::string rest =
      profiles.size() > kShown ? fmt::format(" and {} more", profiles.size() - kShown) : "";
  return fmt::format("it has {}{}", fmt::join(shown, ", "), rest);
}

/// The document's profiles; an object of patches, empty if it has none.
std::vector<std::pair<std::string, JsonCursor>> profile_members(const JsonCursor& document) {
  const std::optional<JsonCursor> profiles = document.find("profiles");
  if (!profiles) return {};
  for (const auto& [key, patch] : profiles->members()) {
    if (!patch.is_object()) patch.fail("expected an object: a merge patch of the experiment");
    for (const char* fixed : {"schema", "profiles"})
      if (const auto found = patch.find(fixed)) found->fail("a profile cannot change this");
  }
  return profiles->members();
}

}  // namespace

Json experiment_value(const Experiment& experiment) {
  const WorldOptions& world = experiment.world;
  const WalkOptions& walk = experiment.walk;
  Json sensors = Json::object();
  for (const SensorStudy& study : experiment.sensors)
    sensors[std::string(name(study.sensor.sensor))] = sensor_value(study);
  Json value = {{"schema", schema_value("mapproof.experiment")},
                {"name", experiment.name},
                {"title", experiment.title},
                {"seed", experiment.seed},
                {"layouts", experiment.layouts},
                {"poses", experiment.poses},
                {"world",
                 {{"side_m", world.side_m},
                  {"landmarks", world.landmarks},
                  {"landmark_diameter_m", world.landmark_diameter_m},
                  {"gap_m", world.gap_m},
                  {"wall_margin_m", world.wall_margin_m}}},
                {"walk",
                 {{"step_m", walk.step_m},
                  {"turn_rad", walk.turn_rad},
                  {"substep_m", walk.substep_m},
                  {"clearance_m", walk.clearance_m},
                  {"wall_margin_m", walk.wall_margin_m}}},
                {"anchors", experiment.anchors},
                {"anchor_placement", name(experiment.anchor_placement)},
                {"affine_fit", name(experiment.affine_fit)},
                {"solver",
                 {{"smacof_relative_fall", experiment.solver.smacof_relative_fall},
                  {"smacof_knn_relative_fall", experiment.solver.smacof_knn_relative_fall},
                  {"only_seen_together", experiment.solver.only_seen_together}}},
                {"sensors", std::move(sensors)}};
  put_extras(value, experiment);
  return value;
}

std::string experiment_json(const Experiment& experiment) {
  return json_text(experiment_value(experiment));
}

Experiment parse_experiment(std::string_view text, const std::string& source,
                            const std::string& profile) {
  JsonDocument document = parse_json(text, source);
  expect_schema(document.cursor(), "mapproof.experiment");
  nlohmann::json patch;
  const auto members = profile_members(document.cursor());
  if (!profile.empty()) {
    if (!document.root.contains("profiles") || !document.root["profiles"].contains(profile))
      throw IoError(source, "/profiles",
                    "no profile " + in_quotes(profile) + ": " + known_profiles(members));
    patch = document.root["profiles"][profile];
    document.source = fmt::format("{} with profile {}", source, printable(profile, 40));
  }
  document.root.erase("profiles");
  if (!profile.empty()) document.root.merge_patch(patch);
  return read_experiment(document.cursor());
}

std::vector<std::string> profiles(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  expect_schema(document.cursor(), "mapproof.experiment");
  std::vector<std::string> names;
  for (const auto& [key, patch] : profile_members(document.cursor())) names.push_back(key);
  return names;
}

}  // namespace mapproof
