#include "render/scene/observation_scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/diagrams/measurement_geometry.hpp"
#include "render/scene/cloud_box.hpp"
#include "render/scene/projection.hpp"
#include "render/scene/room.hpp"

namespace mapproof {
namespace {

const Point3 kToManifoldCamera{0.55, -1.0, 0.62};

void require_usable(const ManifoldSceneSpec& spec) {
  const Eigen::Index rows = spec.manifold.coordinates.rows();
  if (spec.ground_truth_m.rows() != rows)
    throw InvalidInput("manifold_scene: not as many true positions as coordinates");
  if (!(spec.side_m > 0.0 && std::isfinite(spec.side_m)))
    throw InvalidInput("manifold_scene: the room's side is not a length");
  for (const auto& [a, b] : spec.manifold.edges)
    if (std::min(a, b) < 0 || std::max(a, b) >= rows)
      throw InvalidInput("manifold_scene: an edge has no landmark");
}

/// The landmarks that have coordinates, coloured by one of the two true ones.
Spheres landmarks(const ManifoldSceneSpec& spec, Eigen::Index axis, double radius) {
  Spheres spheres{
      .label = fmt::format("true {}, 0 to {} m", axis == 0 ? "x" : "y", significant(spec.side_m)),
      .radius = radius};
  spheres.tones.limits = {0.0, spec.side_m};
  for (Eigen::Index i = 0; i < spec.manifold.coordinates.rows(); ++i) {
    if (!spec.manifold.coordinates.row(i).allFinite()) continue;
    spheres.at.emplace_back(spec.manifold.coordinates.row(i).transpose());
    const double value = spec.ground_truth_m(i, axis);
    spheres.tones.values.push_back(std::isfinite(value) ? value : kNaN);
  }
  return spheres;
}

Rods graph(const ManifoldSceneSpec& spec, double radius) {
  Rods rods{.label = fmt::format("{} nearest neighbours", spec.manifold.neighbours),
            .radius = radius,
            .style = {.colour = ThemeColour::kMuted}};
  for (const auto& [a, b] : spec.manifold.edges) {
    if (!spec.manifold.coordinates.row(a).allFinite() ||
        !spec.manifold.coordinates.row(b).allFinite())
      continue;
    rods.from.emplace_back(spec.manifold.coordinates.row(a).transpose());
    rods.to.emplace_back(spec.manifold.coordinates.row(b).transpose());
  }
  if (rods.from.empty()) rods.label.clear();
  return rods;
}

constexpr Eigen::Index kTrail = 40;   // Steps of the path that are drawn.
constexpr double kNearViews = 4.0;    // Across what is drawn of a large room, in views.
constexpr double kSeenReaches = 4.0;  // Across a view of visibility.
constexpr double kAround = 1.15;      // Half the side of what is seen, in reaches.

Point3 lifted(Point p, double height) { return {p.x, p.y, height}; }

/// A flat convex outline as triangles about its first point.
void add_fan(Surface& surface, const std::vector<Point>& outline, double height) {
  const auto first = static_cast<std::uint32_t>(surface.points.size());
  for (const Point p : outline) surface.points.push_back(lifted(p, height));
  for (std::uint32_t i = 1; i + 1 < outline.size(); ++i)
    surface.triangles.push_back({first, first + i, first + i + 1});
}

class MeasurementScene {
 public:
  MeasurementScene(const Measurement& m, const std::string& id)
      : m_(m),
        robot_{m.robot_m.x(), m.robot_m.y()},
        side_(m.world.side_m),
        seen_m_(m.sensor == Sensor::kVisibility ? std::min(side_, kSeenReaches * m.reach_m)
                                                : side_) {
    scene_.id = id;
    scene_.lights = usual_lights();
    scene_.parts = {floor(), walls()};
    if (is_whole()) scene_.parts.emplace_back(grid_of(room_ground(side_)));
    scene_.views = {room_view(side_, landmark_height(seen_m_))};
    scene_.record_ids = {};
  }

  Scene make() {
    m_.sensor == Sensor::kVisibility ? show_visibility() : show_bearings();
    scene_.parts.emplace_back(trail());
    add_robot();
    return std::move(scene_);
  }

 private:
  void show_visibility() {
    std::vector<Point3> seen;
    for (const double x : {-kAround, kAround})
      for (const double y : {-kAround, kAround})
        for (const double z : {0.0, landmark_height(seen_m_)})
          seen.emplace_back(robot_.x + x * m_.reach_m, robot_.y + y * m_.reach_m, z);
    scene_.views[0].camera = fitted_camera(seen, {0.3, -1.0, 1.25}, false);
    scene_.views[0].rules.clear();  // The room's edges are mostly outside.
    scene_.parts.emplace_back(disc());
    scene_.parts.emplace_back(shadows());
    scene_.parts.emplace_back(landmarks(View::kVisible));
    scene_.parts.emplace_back(landmarks(View::kHidden));
    scene_.parts.emplace_back(landmarks(View::kOutOfReach));
    const std::size_t visible = count(View::kVisible), hidden = count(View::kHidden);
    scene_.title = fmt::format("Visibility-only measurement: {} seen, {} hidden",
                               counted(static_cast<long long>(visible), "landmark"), hidden);
    scene_.caption = fmt::format(
        "Visibility at step {} of layout {}, pose {}: within {} mm the robot sees {}, {} hidden in "
        "the shadows of others.",
        m_.step, m_.run.layout, m_.run.pose, std::lround(1000.0 * m_.reach_m),
        counted(static_cast<long long>(visible), "landmark"),
        hidden == 1 ? "1 is" : fmt::format("{} are", hidden));
    scene_.alt = fmt::format(
        "The floor around the robot at ({}, {}) m; within {} m {} visible, {} "
        "hidden.",
        significant(robot_.x), significant(robot_.y), significant(m_.reach_m),
        counted(static_cast<long long>(visible), "landmark"), hidden);
  }

  void show_bearings() {
    const std::vector<Eigen::Index> named = named_bearings(m_);
    scene_.parts.emplace_back(landmarks(std::nullopt));
    scene_.parts.emplace_back(rays(named));
    SceneLabels labels;
    for (std::size_t i = 0; i < named.size(); ++i) {
      add_angle(named[i], i);
      labels.at.push_back(position(named[i], landmark_height(seen_m_)));
      labels.text.push_back(
          fmt::format("L{}: {}", named[i] + 1, degrees(m_.bearings_rad(named[i]))));
    }
    const auto known = m_.bearings_rad.array().isFinite().count();
    scene_.title = "Bearing-only measurement: " + bearings_text(m_);
    scene_.caption = fmt::format(
        "Bearings at step {} of layout {}, pose {}: the angle from the heading (arrow) to each of "
        "{}.",
        m_.step, m_.run.layout, m_.run.pose, counted(known, "landmark"));
    scene_.alt =
        fmt::format("The room with the robot at ({}, {}) m and a ray to each of {}.",
                    significant(robot_.x), significant(robot_.y), counted(known, "landmark"));
    if (!labels.text.empty())
      scene_.alt += " Angles to the heading: " + listed(labels.text, 3) + ".";
    scene_.views[0].labels.push_back(std::move(labels));
  }

  /// Of a much larger room only what is near, since an image cannot show such depths.
  Surface floor() const {
    if (is_whole()) return floor_of(side_);
    Surface around{.style = floor_of(side_).style};
    const double x0 = near(robot_.x, -1.0), x1 = near(robot_.x, 1.0);
    const double y0 = near(robot_.y, -1.0), y1 = near(robot_.y, 1.0);
    add_rectangle(around, {x0, y0, 0.0}, {x1, y0, 0.0}, {x1, y1, 0.0}, {x0, y1, 0.0});
    return around;
  }
  Surface walls() const {
    return is_whole() ? walls_of(side_) : Surface{.style = walls_of(side_).style};
  }

  bool is_whole() const { return side_ <= kNearViews * seen_m_; }
  /// The edge of what is near, on one side of a coordinate.
  double near(double at, double side) const {
    return std::clamp(at + side * kNearViews * seen_m_ / 2.0, 0.0, side_);
  }
  bool is_near(const Eigen::RowVector2d& at) const {
    return is_whole() || (at - m_.robot_m).cwiseAbs().maxCoeff() < kNearViews * seen_m_ / 2.0;
  }

  Surface disc() const {
    Surface surface{.label = fmt::format("reach, {} mm", std::lround(1000.0 * m_.reach_m)),
                    .style = {.colour = ThemeColour::kSeries7, .share = kTintShare, .lit = false}};
    add_fan(surface, arc_points(robot_, m_.reach_m, 0.0, 2.0 * std::numbers::pi), lift(1));
    return surface;
  }

  Surface shadows() const {
    Surface surface{.style = {.colour = ThemeColour::kText, .share = kTintShare, .lit = false}};
    for (const std::vector<Point>& outline : shadow_outlines(m_))
      add_fan(surface, outline, lift(2));
    if (!surface.triangles.empty()) surface.label = "shadow";
    return surface;
  }

  Rods landmarks(std::optional<View> view) const {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = 0; i < m_.world.landmarks_m.rows(); ++i)
      if ((!view || m_.views[static_cast<std::size_t>(i)] == *view) &&
          is_near(m_.world.landmarks_m.row(i)))
        rows.push_back(i);
    Rods rods = pillars(m_.world.landmarks_m, rows, m_.world.landmark_diameter_m / 2.0,
                        landmark_height(seen_m_));
    rods.label = "landmark";
    rods.style.colour = ThemeColour::kSeries1;
    if (view == View::kVisible) rods.label = "visible";
    if (view == View::kHidden) rods.label = "hidden", rods.style.colour = ThemeColour::kSeries2;
    if (view == View::kOutOfReach)
      rods.label = "out of reach", rods.style.colour = ThemeColour::kMuted;
    if (rows.empty()) rods.label.clear();
    return rods;
  }

  Rods rays(const std::vector<Eigen::Index>& named) const {
    Rods rods{.label = "ray", .radius = 0.0012 * seen_m_, .style = {.colour = ThemeColour::kMuted}};
    for (Eigen::Index i = 0; i < m_.world.landmarks_m.rows(); ++i) {
      if (!std::isfinite(m_.bearings_rad(i)) || std::ranges::find(named, i) != named.end())
        continue;
      rods.from.push_back(lifted(robot_, eye()));
      rods.to.push_back(position(i, eye()));
    }
    if (rods.from.empty()) rods.label.clear();
    return rods;
  }

  /// The ray to a landmark and the arc from the heading to it, the n-th farther out.
  void add_angle(Eigen::Index row, std::size_t n) {
    const Style style{.colour = series_colour(n + 1)};
    const double radius = (0.05 + 0.03 * static_cast<double>(n)) * seen_m_;
    Tube arc{.radius = 0.003 * seen_m_, .style = style};
    for (const Point p :
         arc_points(robot_, radius, m_.heading_rad, m_.heading_rad + m_.bearings_rad(row)))
      arc.points.push_back(lifted(p, eye()));
    scene_.parts.emplace_back(std::move(arc));
    scene_.parts.emplace_back(Rods{.label = fmt::format("bearing of L{}", row + 1),
                                   .from = {lifted(robot_, eye())},
                                   .to = {position(row, eye())},
                                   .radius = 0.003 * seen_m_,
                                   .style = style});
  }

  Tube trail() const {
    Tube tube{
        .label = "path so far", .radius = 0.002 * seen_m_, .style = {.colour = ThemeColour::kText}};
    const Eigen::Index first = std::max<Eigen::Index>(0, m_.path_m.rows() - kTrail);
    for (Eigen::Index i = first; i < m_.path_m.rows(); ++i)
      tube.points.push_back(on_floor(m_.path_m.row(i), tube.radius));
    if (tube.points.size() < 2) tube.label.clear();
    return tube;
  }

  void add_robot() {
    scene_.parts.emplace_back(Spheres{.label = "robot",
                                      .at = {lifted(robot_, eye())},
                                      .radius = 0.014 * seen_m_,
                                      .style = {.colour = ThemeColour::kText}});
    scene_.parts.emplace_back(
        Rods{.label = "heading",
             .from = {lifted(robot_, eye())},
             .to = {lifted(beside(robot_, 0.1 * seen_m_, m_.heading_rad), eye())},
             .radius = 0.005 * seen_m_,
             .arrow = true,
             .style = {.colour = ThemeColour::kText}});
  }

  /// Layers on the floor, one above the other and above its grid.
  double lift(int layer) const { return kFlatLayer * (1 + layer) * seen_m_; }
  /// Where the robot observes from.
  double eye() const { return 0.5 * landmark_height(seen_m_); }
  Point3 position(Eigen::Index row, double height) const {
    return on_floor(m_.world.landmarks_m.row(row), height);
  }
  std::size_t count(View view) const {
    return static_cast<std::size_t>(std::ranges::count(m_.views, view));
  }

  const Measurement& m_;
  Point robot_;
  double side_;
  double seen_m_;  ///< What robot, rays and heights are sized by: about the width of the view.
  Scene scene_;
};

}  // namespace

bool has_manifold_scene(const ObservationManifold& manifold) {
  Eigen::Index known = 0;
  for (const auto& row : manifold.coordinates.rowwise()) known += row.allFinite();
  return known >= 2;
}

Scene manifold_scene(const ManifoldSceneSpec& spec) {
  require_usable(spec);
  Spheres by_x = landmarks(spec, 0, 1.0);
  if (by_x.at.size() < 2)
    throw InvalidInput("manifold_scene: fewer than two landmarks have coordinates");
  const CloudBox box(by_x.at);
  by_x.radius = 0.014 * box.size();
  Scene scene{.id = spec.id,
              .title = spec.title,
              .caption = spec.caption,
              .alt = fmt::format(
                  "{} in three principal coordinates of their observations, which "
                  "span {}, {} and {}; {} of the neighbour graph.",
                  counted(static_cast<long long>(by_x.at.size()), "landmark"),
                  significant(box.high.x() - box.low.x()), significant(box.high.y() - box.low.y()),
                  significant(box.high.z() - box.low.z()),
                  counted(static_cast<long long>(spec.manifold.edges.size()), "edge")),
              .record_ids = spec.record_ids,
              .lights = usual_lights()};
  scene.parts = {box.edges(), graph(spec, 0.0022 * box.size()), by_x,
                 landmarks(spec, 1, by_x.radius)};
  const std::array<double, 3>& shares = spec.manifold.shares;
  scene.notes = {
      {fmt::format("The three coordinates hold {:.0f}, {:.0f} and {:.0f} % of all spread.",
                   100.0 * shares[0], 100.0 * shares[1], 100.0 * shares[2])}};
  const Shot view{.camera = box.camera(kToManifoldCamera),
                  .rules = box.rules({"1st", "2nd", "3rd"})};
  scene.views = {view, view};
  scene.views[0].title = "By true x";
  scene.views[0].parts = {0, 1, 2};
  scene.views[1].title = "By true y";
  scene.views[1].parts = {0, 1, 3};
  require_valid(scene);
  return scene;
}

Scene measurement_scene(const Measurement& measurement, const std::string& id) {
  require_consistent(measurement);
  Scene scene = MeasurementScene(measurement, id).make();
  require_valid(scene);
  return scene;
}

}  // namespace mapproof
