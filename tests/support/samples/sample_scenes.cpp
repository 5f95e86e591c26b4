#include "tests/support/samples/sample_scenes.hpp"

#include <cmath>

#include <fmt/format.h>
#include <Eigen/LU>

#include "core/base/random.hpp"
#include "render/scene/drive_scene.hpp"
#include "render/scene/forming_scene.hpp"
#include "render/scene/map_scene.hpp"
#include "render/scene/observation_scenes.hpp"
#include "render/scene/projection.hpp"
#include "render/scene/quadric_scene.hpp"
#include "render/scene/room.hpp"
#include "render/scene/space_scene.hpp"
#include "tests/support/samples/sample_figures.hpp"
#include "tests/support/samples/sample_slam.hpp"
#include "tests/support/samples/sample_studies.hpp"

namespace mapproof::test {
namespace {

constexpr double kSceneRoom_m = 2.5;

Points spiral(int steps) {
  Points path(steps, 2);
  for (int i = 0; i < steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const double radius = 0.2 + share;
    path.row(i) << kSceneRoom_m / 2.0 + radius * std::cos(20.0 * share),
        kSceneRoom_m / 2.0 + radius * std::sin(20.0 * share);
  }
  return path;
}

/// Back and forth through the whole room.
Points walk(int steps) {
  Points path(steps, 2);
  for (int i = 0; i < steps; ++i)
    path.row(i) << kSceneRoom_m / 2.0 + 1.15 * std::sin(0.0701 * i),
        kSceneRoom_m / 2.0 + 1.15 * std::sin(0.0533 * i + 0.4);
  return path;
}

MapSceneSpec world_spec(const std::string& id, double error_m) {
  MapSceneSpec spec{.id = id,
                    .title = "Bearing, ISOMAP, K = 7 after 2000 steps",
                    .where = "Layout 0, pose 0",
                    .map = sample_map(50, error_m, 7),
                    .path_m = spiral(400)};
  spec.world = {kSceneRoom_m, 0.048, *spec.map.ground_truth_m};
  return spec;
}

Scene hard_world() {
  MapSceneSpec spec = world_spec("world-hard", 0.2);
  spec.map.estimate.row(3).setConstant(NAN);
  spec.map.estimate.row(4) << 1e12, -5.0;
  spec.map.names[spec.map.anchors[0]] = "λ₁ = σ² × 10⁻³";
  spec.map.names[spec.map.anchors[1]] = "a landmark of a very long name beside the third window";
  spec.path_m.row(7).setConstant(NAN);
  return map_scene(spec);
}

/// A map of a yard far from the origin, of which the anchors' true positions alone are known.
Scene open_ground() {
  MapSceneSpec spec{.id = "map-open",
                    .title = "Bearing, ISOMAP, K = 7: up to 0.35 m off at 4 anchors",
                    .map = sample_map(50, 0.12, 7)};
  const Eigen::RowVector2d yard(400.0, -120.0);
  spec.map.estimate = (20.0 * spec.map.estimate).rowwise() + yard;
  Points given = Points::Constant(50, 2, NAN);
  for (const Eigen::Index row : spec.map.anchors)
    given.row(row) = 20.0 * spec.map.ground_truth_m->row(row) + yard;
  spec.map.ground_truth_m = given;
  spec.map.estimate.row(3).setConstant(NAN);
  spec.map.estimate.row(4) << 1e12, -5.0;
  for (int i = 0; i < 50; ++i) spec.half_axes.push_back(0.3 + 0.02 * i);
  return map_scene(spec);
}

/// A sheet that bends as observation histories do.
Scene bent_sheet() {
  const MapRecord map = sample_map(60, 0.1, 3);
  ManifoldSceneSpec spec;
  spec.id = "manifold-usual";
  spec.title = "Observation manifold";
  spec.caption = "Principal coordinates of a bent sheet.";
  spec.ground_truth_m = *map.ground_truth_m;
  spec.side_m = kSceneRoom_m;
  spec.record_ids = {"r/1"};
  spec.manifold.shares = {0.48, 0.44, 0.05};
  spec.manifold.neighbours = 4;
  spec.manifold.coordinates.resize(60, 3);
  for (Eigen::Index i = 0; i < 60; ++i) {
    const double x = spec.ground_truth_m(i, 0) - 1.25, y = spec.ground_truth_m(i, 1) - 1.25;
    spec.manifold.coordinates.row(i) << std::sin(1.2 * x), std::sin(1.2 * y),
        0.5 * (x * x + y * y) / 1.6;
    for (Eigen::Index j = 0; j < i; ++j)
      if ((spec.ground_truth_m.row(i) - spec.ground_truth_m.row(j)).norm() < 0.42)
        spec.manifold.edges.emplace_back(static_cast<int>(j), static_cast<int>(i));
  }
  return manifold_scene(spec);
}

/// Maps of one room after 200 to 2000 steps, ever better.
FormingSceneSpec forming_spec() {
  FormingSceneSpec spec{.id = "forming-usual",
                        .title = "Bearing, ISOMAP, K = 7: the map forms",
                        .world = {},
                        .maps = {}};
  for (int i = 1; i <= 10; ++i) {
    spec.maps.push_back(sample_map(50, 0.9 / i, 7));
    spec.maps.back().step = 200 * i;
    spec.maps.back().id += fmt::format("/{}", i);
  }
  spec.world = {kSceneRoom_m, 0.048, *spec.maps[0].ground_truth_m};
  return spec;
}

}  // namespace

UpgradeClouds sample_clouds(double noise) {
  Random random(5);
  UpgradeClouds clouds;
  clouds.after.points.resize(150, 3);
  for (Eigen::Index t = 0; t < 150; ++t) {
    const double x = 9.0 * std::sin(0.11 * double(t)), y = 8.0 * std::sin(0.07 * double(t) + 1.0);
    clouds.after.points.row(t) << x, y, 0.5 * (x * x + y * y) + noise * random.normal();
    clouds.steps.push_back(3 * t);
  }
  clouds.after.Q.setIdentity();
  clouds.after.Q.bottomRightCorner<2, 2>() << 0.0, -1.0, -1.0, 0.0;
  // Before: seen from another frame, p = A q + b for the points q after.
  Eigen::Matrix4d to_after;
  to_after << 5.0, 1.0, 0.5, 1.0, -1.0, 3.0, 2.0, -2.0, 4.0, -6.0, 21.0, 20.0, 0.0, 0.0, 0.0, 1.0;
  Eigen::MatrixX4d lifted(150, 4);
  lifted << clouds.after.points, Eigen::VectorXd::Ones(150);
  clouds.before.points = (lifted * to_after.inverse().transpose()).leftCols<3>();
  clouds.before.Q = to_after.transpose() * clouds.after.Q * to_after;
  return clouds;
}

SpaceRun sample_space_run() {
  Random random(6);
  SpaceRun run{.landmarks_m = SpacePoints(10, 3),
               .positions_m = SpacePoints(200, 3),
               .known = {0, 1, 2, 3, 4, 5},
               .noise = "white noise, 1 % of the range",
               .records = {}};
  for (auto row : run.landmarks_m.rowwise())
    row << random.uniform(-10.0, 10.0), random.uniform(-10.0, 10.0), random.uniform(0.0, 8.0);
  for (Eigen::Index t = 0; t < 200; ++t) {
    const double a = 0.05 * double(t);
    run.positions_m.row(t) << 9.0 * std::sin(a), 9.0 * std::cos(1.7 * a),
        4.0 + 3.5 * std::sin(2.3 * a);
  }
  for (const double error_m : {0.05, 0.15}) {
    SpaceRecord record{
        .knows_landmarks = error_m < 0.1,
        .estimate = {},
        .alignment = error_m < 0.1 ? Alignment::kNone : Alignment::kRigidWithReflection,
        .landmarks_error_m = error_m,
        .positions_error_m = error_m};
    const auto moved = [&](SpacePoints points) {
      for (double& x : points.reshaped()) x += error_m * random.normal() / std::sqrt(3.0);
      return points;
    };
    record.estimate.landmarks_m = moved(run.landmarks_m);
    record.estimate.positions_m = moved(run.positions_m);
    run.records.push_back(record);
  }
  return run;
}

Film sample_film() {
  FormingSceneSpec spec = forming_spec();
  spec.path_m = walk(2000);
  return forming_film(spec);
}

Scene small_scene() {
  Scene scene{.id = "small",
              .title = "A scene of every part",
              .caption = "Nothing real.",
              .alt = "A box, a tube, rods, spheres and a field.",
              .record_ids = {"record/1"},
              .lights = usual_lights()};
  Surface sheet{.label = "sheet", .style = {.colour = ThemeColour::kSeries3, .opacity = 0.5}};
  add_rectangle(sheet, {0.1, 0.1, 0.3}, {0.9, 0.1, 0.3}, {0.9, 0.9, 0.3}, {0.1, 0.9, 0.3});
  Tube tube{.label = "tube",
            .points = {{0.0, 0.0, 0.1}, {0.5, 0.2, 0.1}, {1.0, 0.0, 0.4}},
            .radius = 0.03};
  tube.tones = {{0.0, NAN, 2.0}, {0.0, 2.0}};
  Rods rods{.label = "rods", .from = {{0.2, 0.8, 0.0}}, .to = {{0.2, 0.8, 0.5}}, .radius = 0.06};
  rods.style.colour = ThemeColour::kSeries1;
  Rods arrow{.label = "arrow",
             .from = {{0.5, 0.9, 0.05}},
             .to = {{0.9, 0.5, 0.05}},
             .radius = 0.02,
             .arrow = true};
  Spheres spheres{.label = "sphere",
                  .at = {{0.75, 0.25, 0.15}},
                  .radius = 0.1,
                  .style = {.colour = ThemeColour::kSeries2}};
  Field field{.label = "field",
              .points = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {1.0, 1.0, 0.1}}};
  field.tones = {{0.0, 1.0, 1.0, 2.0}, {0.0, 2.0}};
  field.levels = {0.5, 1.5};
  scene.parts = {field, tube, rods, arrow, spheres, sheet};
  Shot view;
  const std::vector<Point3> corners = {
      {-0.2, -0.2, 0.0}, {1.2, -0.2, 0.0}, {1.2, 1.0, 0.0}, {0.0, 1.0, 0.6}};
  view.camera = fitted_camera(corners, {0.4, -1.0, 0.8}, false);
  view.labels = {{{{0.75, 0.25, 0.25}, {0.2, 0.8, 0.5}}, {"σ² = ½", "λ"}, ThemeColour::kText}};
  view.rules = {{.to = {1.0, 0.0, 0.0}, .range = {0.0, 1.0}, .label = "x [m]"}};
  scene.views = {view};
  return scene;
}

std::vector<Scene> sample_scenes() {
  std::vector<Scene> scenes = {small_scene(), map_scene(world_spec("world-usual", 0.12)),
                               hard_world(), open_ground(), bent_sheet()};
  scenes.push_back(
      measurement_scene(sample_measurement(Sensor::kVisibility, 50), "scan-visibility"));
  scenes.push_back(measurement_scene(sample_measurement(Sensor::kBearing, 50), "scan-bearing"));
  scenes.push_back(quadric_scene({.id = "quadric-usual",
                                  .title = "Metric upgrade",
                                  .name = "A sample",
                                  .clouds = sample_clouds(0.5),
                                  .record_ids = {"sample"}}));
  SpaceSceneSpec space{.id = "space-usual",
                       .title = "Landmarks in space from ranges alone",
                       .run = sample_space_run(),
                       .record_ids = {"space"}};
  scenes.push_back(space_scene(space));
  space.id = "space-failed";
  space.run.records[0].estimate.landmarks_m.setConstant(NAN);
  space.run.records[0].estimate.positions_m.resize(0, 3);
  space.run.records[0].landmarks_error_m = space.run.records[0].positions_error_m = std::nullopt;
  scenes.push_back(space_scene(space));
  FormingSceneSpec forming = forming_spec();
  scenes.push_back(forming_scene(forming));
  forming.id = "forming-hard";
  forming.maps[0].estimate.row(3) << 1e7, -3.0;
  forming.maps[0].estimate.row(4).setConstant(NAN);
  forming.maps[0].score.reset();
  forming.most = 4;
  scenes.push_back(forming_scene(forming));
  MapSceneSpec walked = world_spec("world-walked", 0.12);
  walked.path_m = walk(2000);
  scenes.push_back(map_scene(walked));
  const SlamRun drive = sample_drive("plaza-1", 800, 3);
  scenes.push_back(drive_scene({.id = "drive-usual",
                                .title = "Plaza 1: the path is 0.19 m off, dead reckoning 16 m",
                                .run = drive,
                                .record_ids = {drive.id}}));
  return scenes;
}

}  // namespace mapproof::test
