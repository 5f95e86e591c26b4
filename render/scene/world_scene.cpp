#include "render/scene/world_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/words.hpp"
#include "render/figures/words.hpp"
#include "render/scene/displacements.hpp"
#include "render/scene/room.hpp"

namespace mapproof {
namespace {

constexpr double kPathRadius = 0.0022;  // Of the room's side.
constexpr double kMostCovered = 0.2;    // Of the floor, by the path.
constexpr std::size_t kMostWorst = 3;

void require_usable(const WorldSceneSpec& spec) {
  const World& world = spec.world;
  if (!has_room(world))
    throw InvalidInput("world_scene: the room's side or the landmarks' diameter is not a length");
  if (spec.map.estimate.rows() != world.landmarks_m.rows() ||
      spec.map.names.size() != static_cast<std::size_t>(world.landmarks_m.rows()))
    throw InvalidInput("world_scene: the map is not of the world's landmarks");
  for (const Eigen::Index row : spec.map.anchors)
    if (row < 0 || row >= world.landmarks_m.rows())
      throw InvalidInput("world_scene: an anchor is not a landmark");
}

class WorldScene {
 public:
  WorldScene(const WorldSceneSpec& spec, WorldView view)
      : spec_(spec), world_(spec.world), side_(spec.world.side_m) {
    found_ = displacements(world_.landmarks_m, spec.map.estimate, side_);
    scene_.id = spec.id;
    scene_.title = spec.title;
    scene_.record_ids = {spec.map.id};
    scene_.lights = usual_lights();
    scene_.views = {view == WorldView::kPlan
                        ? room_plan(side_, found_.arrows.to)
                        : room_view(side_, landmark_height(side_), found_.arrows.to)};
  }

  Scene make() {
    add_parts();
    add_labels();
    describe();
    return std::move(scene_);
  }

 private:
  void add_parts() {
    scene_.parts = {floor_of(side_), walls_of(side_), landmarks(false), landmarks(true)};
    if (spec_.path_m.rows() > 1) scene_.parts.emplace_back(path());
    Rods arrows = found_.arrows;
    arrows.label = "true to estimated position";
    arrows.style.ink = Ink::kText;
    scene_.parts.emplace_back(std::move(arrows));
  }

  Rods landmarks(bool anchors) const {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = 0; i < world_.landmarks_m.rows(); ++i)
      if (is_anchor(i) == anchors) rows.push_back(i);
    Rods rods = pillars(world_.landmarks_m, rows, pillar_radius_m(world_), landmark_height(side_));
    rods.label = anchors ? "anchor" : "landmark";
    rods.style.ink = anchors ? Ink::kSeries2 : Ink::kSeries1;
    if (rods.from.empty()) rods.label.clear();
    return rods;
  }

  /// Long paths are thin: they cover at most a share of the floor.
  double path_radius() const {
    double length_m = 0.0;
    for (Eigen::Index i = 1; i < spec_.path_m.rows(); ++i) {
      const double step = (spec_.path_m.row(i) - spec_.path_m.row(i - 1)).norm();
      if (std::isfinite(step)) length_m += step;
    }
    const double covering = kMostCovered * side_ * side_ / (2.0 * std::max(length_m, 1e-9));
    return std::min(kPathRadius * side_, covering);
  }

  Tube path() const {
    Tube tube{.label = "path, start (dark) to end", .radius = path_radius()};
    tube.tones.limits = {0.0, static_cast<double>(spec_.path_m.rows() - 1)};
    for (Eigen::Index i = 0; i < spec_.path_m.rows(); ++i) {
      if (!spec_.path_m.row(i).allFinite()) continue;
      tube.points.push_back(on_floor(spec_.path_m.row(i), tube.radius));
      tube.tones.values.push_back(static_cast<double>(i));
    }
    return tube;
  }

  void add_labels() {
    SceneLabels anchors{.ink = Ink::kText};
    for (const Eigen::Index row : spec_.map.anchors) add_label(anchors, row);
    for (const std::size_t i : worst()) add_label(anchors, found_.drawn[i]);
    scene_.views[0].labels.push_back(std::move(anchors));
  }

  void add_label(SceneLabels& labels, Eigen::Index row) const {
    if (!world_.landmarks_m.row(row).allFinite()) return;
    labels.at.push_back(on_floor(world_.landmarks_m.row(row), landmark_height(side_)));
    labels.text.push_back(spec_.map.names[static_cast<std::size_t>(row)]);
  }

  /// Places in `found_` of the largest errors of landmarks that are not anchors.
  std::vector<std::size_t> worst() const {
    std::vector<std::size_t> order(found_.drawn.size());
    std::iota(order.begin(), order.end(), 0);
    std::erase_if(order, [this](std::size_t i) { return is_anchor(found_.drawn[i]); });
    std::ranges::stable_sort(order, std::greater<>(),
                             [this](std::size_t i) { return found_.errors_m[i]; });
    order.resize(std::min(order.size(), kMostWorst));
    return order;
  }

  void describe() {
    for (const std::string& words : {words_of_missing(found_), words_of_pillars(world_)})
      if (!words.empty()) scene_.notes.push_back({words, Ink::kWarning});
    const auto landmarks = static_cast<std::size_t>(world_.landmarks_m.rows());
    scene_.caption = fmt::format(
        "Layout {}, pose {}: {} of {} mm in diameter{}, the robot's path "
        "over {} steps, and where {} of {} steps puts each landmark.",
        spec_.run.layout, spec_.run.pose, counted(landmarks, "landmark"),
        significant(1000.0 * world_.landmark_diameter_m),
        scene_.views[0].camera.parallel ? "" : " (heights are the drawing's)", spec_.path_m.rows(),
        method_label(spec_.map), spec_.map.step);
    scene_.alt =
        fmt::format("A room of {} m by {} m with {}, {} of them anchors", significant(side_),
                    significant(side_), counted(landmarks, "landmark"), spec_.map.anchors.size());
    if (spec_.map.score)
      scene_.alt += fmt::format("; mean position error {} m", significant(spec_.map.score->mpe_m));
    if (const auto order = worst(); !order.empty()) {
      const auto row = static_cast<std::size_t>(found_.drawn[order[0]]);
      scene_.alt += fmt::format("; the longest arrow, at {}, is {} m", spec_.map.names[row],
                                significant(found_.errors_m[order[0]]));
    }
    scene_.alt += ".";
  }

  bool is_anchor(Eigen::Index row) const {
    return std::ranges::find(spec_.map.anchors, row) != spec_.map.anchors.end();
  }

  const WorldSceneSpec& spec_;
  const World& world_;
  double side_;
  Displacements found_;
  Scene scene_;
};

}  // namespace

Scene world_scene(const WorldSceneSpec& spec, WorldView view) {
  require_usable(spec);
  Scene scene = WorldScene(spec, view).make();
  require_valid(scene);
  return scene;
}

}  // namespace mapproof
