#include "reports/sections/results/given_figures.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/base/text/slug.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/curves/thinning.hpp"
#include "render/figures/maps/map.hpp"
#include "render/figures/score_text.hpp"
#include "reports/sections/figures/map_scenes.hpp"
#include "reports/sections/figures/map_walls.hpp"
#include "reports/sections/results/results_conventions.hpp"

namespace mapproof {
namespace {

/// An id that no figure of the group has.
std::string free_id(const FigureGroup& group, const std::string& id) {
  std::string free = id;
  for (int i = 2; std::ranges::find(group.figures, free, &Figure::id) != group.figures.end(); ++i)
    free = fmt::format("{}-{}", id, i);
  return free;
}

Polyline path_line(const std::string& label, const Trajectory& path, ThemeColour colour,
                   double width) {
  constexpr double kShareOfSpan = 5e-4;  // Less than a line's width.
  const Eigen::RowVector2d span =
      path.positions_m.colwise().maxCoeff() - path.positions_m.colwise().minCoeff();
  const ThinLine thin = thin_path(path, kShareOfSpan * span.maxCoeff());
  return {.label = label, .x = thin.x, .y = thin.y, .colour = colour, .width = width};
}

std::string alignment_words(const GivenPath& path) {
  switch (path.alignment) {
    case Alignment::kRigid:
      return ", to which it was aligned by rotation and translation";
    case Alignment::kSimilarity:
      return ", to which it was aligned by rotation, translation and scale";
    default:
      return ", as it was given: nothing was aligned";
  }
}

Figure path_figure(const GivenPath& path, std::string id) {
  Figure figure;
  figure.id = std::move(id);
  figure.title = path.id;
  figure.record_ids = {"paths/" + path.id};
  Panel& panel = figure.panels.emplace_back();
  panel.x.label = "x [m]";
  panel.y.label = "y [m]";
  panel.equal_aspect = true;
  if (path.ground_truth)
    panel.layers.emplace_back(
        path_line("ground truth", *path.ground_truth, ThemeColour::kText, 0.6));
  panel.layers.emplace_back(path_line("estimate", path.path, ThemeColour::kSeries1, 1.0));
  figure.caption =
      fmt::format("The path {} of {}{}{}.", path.id, counted(path.path.size(), "pose"),
                  path.ground_truth ? " and its ground truth" : "", alignment_words(path));
  constexpr double kMicrometres = 1e6;  // Below, a distance is rounding alone.
  if (path.rms_m)
    figure.caption += fmt::format(" RMS distance from the ground truth: {:.3g} m.",
                                  std::round(kMicrometres * *path.rms_m) / kMicrometres);
  figure.alt = figure.caption;
  require_valid(figure);
  return figure;
}

}  // namespace

FigureGroup given_figures(const ResultsStudy& study, const std::vector<MapRecord>& maps,
                          const std::vector<GivenPath>& paths) {
  FigureGroup group{study.name + "-maps", "Maps and paths", "", {}};
  std::vector<MapInSpace> titled;
  std::vector<std::pair<std::string, const MapRecord*>> named;
  for (const MapRecord& map : maps) named.emplace_back(map.id, &map);
  group.figures = map_walls(study.name, named);
  for (Figure& wall : group.figures)
    for (std::string& id : wall.record_ids) id = "maps/" + id;
  for (const MapRecord& map : maps) {
    const std::string id = free_id(group, id_below(study.name, "map-" + slug_of(map.id)));
    group.figures.push_back(map_figure(map, id, map.id));
    group.figures.back().record_ids = {"maps/" + map.id};
    titled.push_back({title_with_error(map.id, map), "the map " + map.id, &map});
  }
  group.scenes = best_map_scene("scene-" + study.name + "-map", titled);
  for (const GivenPath& path : paths)
    group.figures.push_back(
        path_figure(path, free_id(group, id_below(study.name, "path-" + slug_of(path.id)))));
  return group;
}

}  // namespace mapproof
