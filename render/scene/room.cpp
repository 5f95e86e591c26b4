#include "render/scene/room.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/figures/number_text.hpp"
#include "render/scene/projection.hpp"

namespace mapproof {
namespace {

constexpr double kWallShare = 0.045;   // Of the room's side: low, since the front ones stand too.
constexpr double kHeightShare = 0.09;  // Landmarks', of the room's side.
constexpr double kLeastRadiusShare = 0.005;  // Of a pillar, of the room's side.
constexpr double kWallTint = 0.25;           // Pale: shadows show on them.
constexpr double kLabelRoom = 0.11;          // Around the floor, for the labels of the axes.

std::vector<Rule> floor_rules(double side_m) {
  const Range range{0.0, side_m};
  return {{.from = {0.0, 0.0, 0.0},
           .to = {side_m, 0.0, 0.0},
           .range = range,
           .label = "x [m]",
           .away = -Point3::UnitY()},
          {.from = {side_m, 0.0, 0.0},
           .to = {side_m, side_m, 0.0},
           .range = range,
           .label = "y [m]",
           .away = Point3::UnitX()}};
}

/// Corners of the room and of the strip that the axes' labels need.
std::vector<Point3> corners(double side_m, double height_m, std::span<const Point3> also) {
  const double low = -kLabelRoom * side_m, high = (1.0 + kLabelRoom) * side_m;
  std::vector<Point3> points(also.begin(), also.end());
  for (const double x : {0.0, high})
    for (const double y : {low, side_m}) points.emplace_back(x, y, 0.0);
  for (const double x : {0.0, side_m})
    for (const double y : {0.0, side_m}) points.emplace_back(x, y, height_m);
  return points;
}

/// A camera whose image has the proportions of what it shows, so that no side of it is empty.
Camera tight_camera(std::span<const Point3> points, const Point3& from, bool parallel,
                    double aspect) {
  constexpr double kNarrowest = 0.9, kWidest = 2.6;
  const Projection project(fitted_camera(points, from, parallel, aspect));
  Point low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  for (const Point3& point : points) {
    const Point at = project(point);
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  }
  const double tight = (high.x - low.x) / std::max(high.y - low.y, 1e-9);
  return fitted_camera(points, from, parallel, std::clamp(tight, kNarrowest, kWidest));
}

}  // namespace

bool is_room_side(double side_m) { return side_m > 0.0 && side_m <= kLongestSide_m; }

bool has_room(const World& world) {
  return is_room_side(world.side_m) && world.landmark_diameter_m > 0.0 &&
         world.landmark_diameter_m <= world.side_m;
}

std::vector<Light> usual_lights() {
  // From the upper left and a little from the front: from behind, pillars would be dark.
  return {{{-0.74, -0.22, 0.8}, 0.85}, {{0.9, -0.25, 0.5}, 0.35}};
}

void add_rectangle(Surface& surface, const Point3& a, const Point3& b, const Point3& c,
                   const Point3& d) {
  const auto first = static_cast<std::uint32_t>(surface.points.size());
  surface.points.insert(surface.points.end(), {a, b, c, d});
  surface.triangles.push_back({first, first + 1, first + 2});
  surface.triangles.push_back({first, first + 2, first + 3});
}

Surface floor_of(double side_m) {
  Surface floor{.style = {.colour = ThemeColour::kMuted, .share = 0.12, .lit = false}};
  add_rectangle(floor, {0.0, 0.0, 0.0}, {side_m, 0.0, 0.0}, {side_m, side_m, 0.0},
                {0.0, side_m, 0.0});
  return floor;
}

Surface walls_of(double side_m) {
  Surface walls{.style = {.colour = ThemeColour::kMuted, .share = kWallTint}};
  const double top = kWallShare * side_m, s = side_m;
  const std::array<Point3, 5> foot = {
      {{0.0, 0.0, 0.0}, {s, 0.0, 0.0}, {s, s, 0.0}, {0.0, s, 0.0}, {0.0, 0.0, 0.0}}};
  const Point3 up = top * Point3::UnitZ();
  for (std::size_t i = 0; i + 1 < foot.size(); ++i)
    add_rectangle(walls, foot[i], foot[i + 1], foot[i + 1] + up, foot[i] + up);
  return walls;
}

double landmark_height(double side_m) { return kHeightShare * side_m; }

Rods pillars(const Points& points_m, const std::vector<Eigen::Index>& rows, double radius,
             double height) {
  Rods rods{.radius = radius};
  for (const Eigen::Index row : rows) {
    if (!points_m.row(row).allFinite()) continue;
    rods.from.push_back(on_floor(points_m.row(row)));
    rods.to.push_back(on_floor(points_m.row(row), height));
  }
  return rods;
}

Point3 on_floor(const Eigen::RowVector2d& at, double height) { return {at.x(), at.y(), height}; }

double pillar_radius_m(const World& world) {
  return std::max(world.landmark_diameter_m / 2.0, kLeastRadiusShare * world.side_m);
}

std::string words_of_pillars(const World& world) {
  const double times = 2.0 * pillar_radius_m(world) / world.landmark_diameter_m;
  if (times <= 1.0) return "";
  return fmt::format("Landmarks are drawn {} times as wide as they are.", significant(times, 2));
}

Shot room_view(double side_m, double height_m, std::span<const Point3> also, double aspect) {
  Shot view;
  view.camera = tight_camera(corners(side_m, height_m, also), {0.42, -1.0, 0.95}, false, aspect);
  view.rules = floor_rules(side_m);
  return view;
}

Shot room_plan(double side_m, std::span<const Point3> also) {
  Shot view;
  view.camera =
      tight_camera(corners(side_m, landmark_height(side_m), also), Point3::UnitZ(), true, 1.6);
  view.rules = floor_rules(side_m);
  return view;
}

}  // namespace mapproof
