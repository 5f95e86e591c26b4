#include "tests/support/sample_scenes.hpp"

#include <cmath>

#include "core/base/random.hpp"
#include "render/scene/error_field_scene.hpp"
#include "render/scene/manifold_scene.hpp"
#include "render/scene/measurement_scene.hpp"
#include "render/scene/projection.hpp"
#include "render/scene/room.hpp"
#include "render/scene/world_scene.hpp"
#include "tests/support/sample_figures.hpp"
#include "tests/support/sample_studies.hpp"

namespace mapproof::test {
namespace {

constexpr double kRoom_m = 2.5;

Points spiral(int steps) {
  Points path(steps, 2);
  for (int i = 0; i < steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const double radius = 0.2 + share;
    path.row(i) << kRoom_m / 2.0 + radius * std::cos(20.0 * share),
        kRoom_m / 2.0 + radius * std::sin(20.0 * share);
  }
  return path;
}

/// Back and forth through the whole room.
Points walk(int steps) {
  Points path(steps, 2);
  for (int i = 0; i < steps; ++i)
    path.row(i) << kRoom_m / 2.0 + 1.15 * std::sin(0.0701 * i),
        kRoom_m / 2.0 + 1.15 * std::sin(0.0533 * i + 0.4);
  return path;
}

WorldSceneSpec world_spec(const std::string& id, double error_m) {
  WorldSceneSpec spec{.id = id,
                      .title = "Bearing, ISOMAP, K = 7 after 2000 steps",
                      .run = {},
                      .world = {},
                      .path_m = spiral(400),
                      .map = sample_map(50, error_m, 7)};
  spec.world = {kRoom_m, 0.048, *spec.map.truth_m};
  return spec;
}

Scene hard_world() {
  WorldSceneSpec spec = world_spec("world-hard", 0.2);
  spec.map.estimate.row(3).setConstant(NAN);
  spec.map.estimate.row(4) << 1e12, -5.0;
  spec.map.names[spec.map.anchors[0]] = "λ₁ = σ² × 10⁻³";
  spec.map.names[spec.map.anchors[1]] = "a landmark of a very long name beside the third window";
  spec.path_m.row(7).setConstant(NAN);
  return world_scene(spec, WorldView::kPerspective);
}

/// A sheet that bends as observation histories do.
Scene bent_sheet() {
  const MapRecord map = sample_map(60, 0.1, 3);
  ManifoldSceneSpec spec;
  spec.id = "manifold-usual";
  spec.title = "Observation manifold";
  spec.caption = "Principal coordinates of a bent sheet.";
  spec.truth_m = *map.truth_m;
  spec.side_m = kRoom_m;
  spec.record_ids = {"r/1"};
  spec.manifold.shares = {0.48, 0.44, 0.05};
  spec.manifold.neighbours = 4;
  spec.manifold.coordinates.resize(60, 3);
  for (Eigen::Index i = 0; i < 60; ++i) {
    const double x = spec.truth_m(i, 0) - 1.25, y = spec.truth_m(i, 1) - 1.25;
    spec.manifold.coordinates.row(i) << std::sin(1.2 * x), std::sin(1.2 * y),
        0.5 * (x * x + y * y) / 1.6;
    for (Eigen::Index j = 0; j < i; ++j)
      if ((spec.truth_m.row(i) - spec.truth_m.row(j)).norm() < 0.42)
        spec.manifold.edges.emplace_back(static_cast<int>(j), static_cast<int>(i));
  }
  return manifold_scene(spec);
}

}  // namespace

Scene small_scene() {
  Scene scene{.id = "small",
              .title = "A scene of every part",
              .caption = "Nothing real.",
              .alt = "A box, a tube, rods, spheres and a field.",
              .record_ids = {"record/1"},
              .lights = usual_lights()};
  Surface sheet{.label = "sheet", .look = {.ink = Ink::kSeries3, .opacity = 0.5}};
  add_rectangle(sheet, {0.1, 0.1, 0.3}, {0.9, 0.1, 0.3}, {0.9, 0.9, 0.3}, {0.1, 0.9, 0.3});
  Tube tube{.label = "tube",
            .points = {{0.0, 0.0, 0.1}, {0.5, 0.2, 0.1}, {1.0, 0.0, 0.4}},
            .radius = 0.03};
  tube.tones = {{0.0, NAN, 2.0}, {0.0, 2.0}};
  Rods rods{.label = "rods", .from = {{0.2, 0.8, 0.0}}, .to = {{0.2, 0.8, 0.5}}, .radius = 0.06};
  rods.look.ink = Ink::kSeries1;
  Rods arrow{.label = "arrow",
             .from = {{0.5, 0.9, 0.05}},
             .to = {{0.9, 0.5, 0.05}},
             .radius = 0.02,
             .arrow = true};
  Spheres spheres{
      .label = "sphere", .at = {{0.75, 0.25, 0.15}}, .radius = 0.1, .look = {.ink = Ink::kSeries2}};
  Field field{.label = "field",
              .points = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {1.0, 1.0, 0.1}}};
  field.tones = {{0.0, 1.0, 1.0, 2.0}, {0.0, 2.0}};
  field.levels = {0.5, 1.5};
  scene.parts = {field, tube, rods, arrow, spheres, sheet};
  Shot view;
  const std::vector<Point3> corners = {
      {-0.2, -0.2, 0.0}, {1.2, -0.2, 0.0}, {1.2, 1.0, 0.0}, {0.0, 1.0, 0.6}};
  view.camera = fitted_camera(corners, {0.4, -1.0, 0.8}, false);
  view.labels = {{{{0.75, 0.25, 0.25}, {0.2, 0.8, 0.5}}, {"σ² = ½", "λ"}, Ink::kText}};
  view.rules = {{.to = {1.0, 0.0, 0.0}, .range = {0.0, 1.0}, .label = "x [m]"}};
  scene.views = {view};
  return scene;
}

std::vector<Scene> sample_scenes() {
  std::vector<Scene> scenes = {
      small_scene(), world_scene(world_spec("world-usual", 0.12), WorldView::kPerspective),
      world_scene(world_spec("world-plan", 0.12), WorldView::kPlan), hard_world(), bent_sheet()};
  scenes.push_back(error_field_scene({.id = "field-two",
                                      .title = "Where maps are wrong",
                                      .side_m = kRoom_m,
                                      .maps = {{"ISOMAP, K = 7", sample_map(50, 0.1, 7)},
                                               {"LLE, K = 9", sample_map(50, 0.3, 7)}}}));
  scenes.push_back(
      measurement_scene(sample_measurement(Sensor::kVisibility, 50), "look-visibility"));
  scenes.push_back(measurement_scene(sample_measurement(Sensor::kBearing, 50), "look-bearing"));
  WorldSceneSpec walked = world_spec("world-walked", 0.12);
  walked.path_m = walk(2000);
  scenes.push_back(world_scene(walked, WorldView::kPerspective));
  return scenes;
}

}  // namespace mapproof::test
