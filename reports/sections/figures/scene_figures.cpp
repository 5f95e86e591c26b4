#include "reports/sections/figures/figure_builders.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/base/text/number_text.hpp"
#include "render/scene/forming_scene.hpp"
#include "render/scene/map_scene.hpp"
#include "render/scene/observation_scenes.hpp"
#include "render/scene/room.hpp"
#include "reports/sections/figures/method_styles.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

/// The first run that has what a scan needs.
void add_scan(FigureSource& source, Sensor sensor, std::vector<Scene>& scenes) {
  if (sensor != Sensor::kVisibility && sensor != Sensor::kBearing) return;
  for (const Run& run : source.study().runs)
    if (const SensorDetails* details = source.details(run.id, sensor);
        details != nullptr && has_room(run.world)) {
      scenes.push_back(measurement_scene(measurement(*source.details(run.id), *details, run.world),
                                         fmt::format("scene-scan-{}", name(sensor))));
      return;
    }
}

/// Whether three dimensions show what the observations of the landmarks hold.
std::string manifold_title(Sensor sensor, const ObservationManifold& manifold) {
  double shown = 0.0;
  for (const double share : manifold.shares) shown += share;
  const std::string subject = title_of(sensor) + ", landmarks in observation space";
  return std::isfinite(shown) ? fmt::format("{}: three coordinates hold {:.0f} % of the spread",
                                            subject, 100.0 * shown)
                              : subject;
}

/// The median run of the best method: its room, and where its landmarks lie in the space of their
/// observations.
void add_best(FigureSource& source, const SettingSummary& best, std::vector<Scene>& scenes) {
  const auto id = median_run(source.study(), best);
  if (!id) return;
  const Run* run = source.run(*id);
  const MapRecord* map = source.map(*id, best.sensor, best.setting, best.step);
  const SensorDetails* details = source.details(*id, best.sensor);
  if (run == nullptr || map == nullptr || map->frame != Frame::kGroundTruth || details == nullptr ||
      !has_room(run->world))
    return;
  MapSceneSpec spec{
      .id = fmt::format("scene-world-{}", name(best.sensor)),
      .title =
          fmt::format("{}, {}: {}after {} steps", title_of(best.sensor), short_label(best.setting),
                      map->score ? error_text(map->score->mpe_m) + " off " : "the map ", best.step),
      .where = fmt::format("Layout {}, pose {}", id->layout, id->pose),
      .map = *map,
      .world = run->world,
      .path_m = source.details(*id)->path.positions_m};
  scenes.push_back(map_scene(spec));
  if (!details->manifold || !has_manifold_scene(*details->manifold)) return;
  scenes.push_back(manifold_scene(
      {.id = fmt::format("scene-manifold-{}", name(best.sensor)),
       .title = manifold_title(best.sensor, *details->manifold),
       .caption = "The landmarks of the median run at the first three principal coordinates of "
                  "their observation histories, joined to their neighbours. Where true x and true "
                  "y both run along the surface without folds, a map of two dimensions can come "
                  "out of observations alone.",
       .manifold = *details->manifold,
       .ground_truth_m = run->world.landmarks_m,
       .side_m = run->world.side_m,
       .record_ids = {map->id}}));
}

/// The median run of the best method, at every checkpoint that has a map in the frame of the ground
/// truth; empty with fewer than two.
std::optional<FormingSceneSpec> forming_of(FigureSource& source, const SensorStudy& sensor) {
  const std::vector<SettingSummary> all = source.best(sensor);
  const SettingSummary* best = best_of(all);
  const auto id = best != nullptr ? median_run(source.study(), *best) : std::nullopt;
  const Run* run = id ? source.run(*id) : nullptr;
  if (run == nullptr || !has_room(run->world)) return std::nullopt;
  FormingSceneSpec spec{
      .id = fmt::format("scene-forming-{}", name(best->sensor)),
      .title = fmt::format("{}, {}: the map forms", title_of(best->sensor), label(best->setting)),
      .world = run->world,
      .maps = {}};
  for (const int step : sensor.checkpoints) {
    const MapRecord* map = source.map(*id, best->sensor, best->setting, step);
    if (map != nullptr && map->frame == Frame::kGroundTruth) spec.maps.push_back(*map);
  }
  if (spec.maps.size() < 2) return std::nullopt;
  if (const std::string errors = errors_over_steps(spec.maps); !errors.empty())
    spec.title =
        fmt::format("{}, {}: {}", title_of(best->sensor), short_label(best->setting), errors);
  if (const RunDetails* details = source.details(*id);
      details != nullptr && details->path.positions_m.rows() >= spec.maps.back().step)
    spec.path_m = details->path.positions_m;
  return spec;
}

}  // namespace

std::vector<Scene> study_scenes(FigureSource& source) {
  std::vector<Scene> scenes;
  for (const SensorStudy& sensor : source.study().experiment.sensors) {
    add_scan(source, sensor.sensor.sensor, scenes);
    const std::vector<SettingSummary> all = source.best(sensor);
    if (const SettingSummary* best = best_of(all)) add_best(source, *best, scenes);
    if (const auto forming = forming_of(source, sensor)) scenes.push_back(forming_scene(*forming));
  }
  return scenes;
}

std::vector<Film> study_films(FigureSource& source) {
  std::vector<Film> films;
  for (const SensorStudy& sensor : source.study().experiment.sensors)
    if (const auto forming = forming_of(source, sensor)) films.push_back(forming_film(*forming));
  return films;
}

}  // namespace mapproof
