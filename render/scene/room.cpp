#include "render/scene/room.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "render/figures/number_text.hpp"
#include "render/scene/projection.hpp"

namespace mapproof {
namespace {

constexpr double kWallShare = 0.045;   // Of the room's side: low, since the front ones stand too.
constexpr double kHeightShare = 0.09;  // Landmarks', of the room's side.
constexpr double kLeastRadiusShare = 0.005;  // Of a pillar, of the room's side.
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

}  // namespace

bool is_room_side(double side_m) { return side_m > 0.0 && side_m <= kLongestSide_m; }

bool has_room(const World& world) {
  return is_room_side(world.side_m) && world.landmark_diameter_m > 0.0 &&
         world.landmark_diameter_m <= world.side_m;
}

std::vector<Light> usual_lights() {
  return {{{-0.35, -0.6, 1.0}, 0.85}, {{0.9, -0.25, 0.5}, 0.35}};
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
  Surface walls{.style = {.colour = ThemeColour::kMuted, .share = kTintShare}};
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
  view.camera = fitted_camera(corners(side_m, height_m, also), {0.42, -1.0, 0.95}, false, aspect);
  view.rules = floor_rules(side_m);
  return view;
}

Shot room_plan(double side_m, std::span<const Point3> also) {
  Shot view;
  view.camera =
      fitted_camera(corners(side_m, landmark_height(side_m), also), Point3::UnitZ(), true);
  view.rules = floor_rules(side_m);
  return view;
}

}  // namespace mapproof
