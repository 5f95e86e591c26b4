#include "render/scene/room.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/scene/projection.hpp"
#include "render/theme/ticks.hpp"

namespace mapproof {
namespace {

constexpr double kWallShare = 0.045;   // Of the room's side: low, since the front ones stand too.
constexpr double kHeightShare = 0.09;  // Landmarks', of the room's side.
constexpr double kLeastRadiusShare = 0.005;  // Of a pillar, of the room's side.
constexpr double kWallTint = 0.25;           // Pale: shadows show on them.
constexpr double kLabelRoom = 0.11;          // Around the floor, for the labels of the axes.

constexpr double kPathRadius = 0.0035;  // Of the room's side.
constexpr int kPathPieces = 10;
constexpr double kShownLength = 1.5;  // Of the room's side.

constexpr double kGridWidth = 0.0015;  // Of the ground's side.
constexpr int kMostLines = 6;          // Of the grid, along a side.

std::vector<Rule> floor_rules(const Ground& ground) {
  const auto& [low, high] = ground;
  return {{.from = {low.x, low.y, 0.0},
           .to = {high.x, low.y, 0.0},
           .range = {low.x, high.x},
           .label = "x [m]",
           .away = -Point3::UnitY()},
          {.from = {high.x, low.y, 0.0},
           .to = {high.x, high.y, 0.0},
           .range = {low.y, high.y},
           .label = "y [m]",
           .away = Point3::UnitX()}};
}

/// Corners of the ground, and of the strips that the axes' labels need: no label stands far in
/// front of the nearest corner, where a strip would leave the image empty. Labels that reach
/// further than the strips have their room outside the image.
std::vector<Point3> corners(const Ground& ground, double height_m, std::span<const Point3> also) {
  const double strip = kLabelRoom * ground.side();
  const auto& [low, high] = ground;
  std::vector<Point3> points(also.begin(), also.end());
  for (const double x : {low.x, (low.x + high.x) / 2.0}) points.emplace_back(x, low.y - strip, 0.0);
  for (const double y : {(low.y + high.y) / 2.0, high.y})
    points.emplace_back(high.x + strip, y, 0.0);
  for (const double x : {low.x, high.x})
    for (const double y : {low.y, high.y})
      for (const double z : {0.0, height_m}) points.emplace_back(x, y, z);
  return points;
}

}  // namespace

Ground room_ground(double side_m) { return {{0.0, 0.0}, {side_m, side_m}}; }

bool is_room_side(double side_m) { return side_m >= kShortestSide_m && side_m <= kLongestSide_m; }

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

Surface floor_of(const Ground& ground) {
  Surface floor{.style = {.colour = ThemeColour::kMuted, .share = 0.12, .lit = false}};
  const auto& [low, high] = ground;
  add_rectangle(floor, {low.x, low.y, 0.0}, {high.x, low.y, 0.0}, {high.x, high.y, 0.0},
                {low.x, high.y, 0.0});
  return floor;
}

Surface floor_of(double side_m) { return floor_of(room_ground(side_m)); }

Surface grid_of(const Ground& ground) {
  Surface lines{.style = {.colour = ThemeColour::kMuted, .share = 0.25, .lit = false}};
  const double side = ground.side(), half = kGridWidth * side / 2.0, z = kFlatLayer * side;
  const auto& [low, high] = ground;
  const double step = tick_step(0.0, side, kMostLines);
  // A line on the edge of the ground would stand half beside it.
  for (double x = step * (std::floor(low.x / step) + 1.0); x < high.x - half; x += step)
    add_rectangle(lines, {x - half, low.y, z}, {x + half, low.y, z}, {x + half, high.y, z},
                  {x - half, high.y, z});
  for (double y = step * (std::floor(low.y / step) + 1.0); y < high.y - half; y += step)
    add_rectangle(lines, {low.x, y - half, z}, {high.x, y - half, z}, {high.x, y + half, z},
                  {low.x, y + half, z});
  return lines;
}

Surface walls_of(const Ground& ground, double height_m) {
  Surface walls{.style = {.colour = ThemeColour::kMuted, .share = kWallTint}};
  const auto& [low, high] = ground;
  const std::array<Point3, 5> foot = {{{low.x, low.y, 0.0},
                                       {high.x, low.y, 0.0},
                                       {high.x, high.y, 0.0},
                                       {low.x, high.y, 0.0},
                                       {low.x, low.y, 0.0}}};
  const Point3 up = height_m * Point3::UnitZ();
  for (std::size_t i = 0; i + 1 < foot.size(); ++i)
    add_rectangle(walls, foot[i], foot[i + 1], foot[i + 1] + up, foot[i] + up);
  return walls;
}

Surface walls_of(double side_m) { return walls_of(room_ground(side_m), kWallShare * side_m); }

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

Surface rings(const Points& points_m, const std::vector<Eigen::Index>& rows, double radius) {
  constexpr double kInner = 2.3, kOuter = 2.8, kLift = 0.05;  // Of the radius; below shadows.
  constexpr std::uint32_t kSides = 48;
  Surface all{.style = {.colour = ThemeColour::kText, .lit = false}};
  for (const Eigen::Index row : rows) {
    if (!points_m.row(row).allFinite()) continue;
    const auto first = static_cast<std::uint32_t>(all.points.size());
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kSides;
      const Point3 out = radius * Point3(std::cos(angle), std::sin(angle), 0.0);
      const Point3 middle = on_floor(points_m.row(row), kLift * radius);
      all.points.push_back(middle + kInner * out);
      all.points.push_back(middle + kOuter * out);
      const std::uint32_t a = first + 2 * i, b = first + 2 * ((i + 1) % kSides);
      all.triangles.push_back({a, a + 1, b + 1});
      all.triangles.push_back({a, b + 1, b});
    }
  }
  return all;
}

Eigen::Index first_shown(const Points& path_m, Eigen::Index last, double side_m) {
  Eigen::Index first = last;
  for (double length_m = 0.0; first > 0 && last - first < kShownSteps; --first) {
    const double step_m = (path_m.row(first) - path_m.row(first - 1)).norm();
    if (std::isfinite(step_m)) length_m += step_m;
    // One step is shown however long it is.
    if (length_m > kShownLength * side_m && first < last) break;
  }
  return first;
}

std::vector<Tube> fading_path(const Points& path_m, Eigen::Index last, double side_m) {
  std::vector<Tube> pieces;
  if (last < 1) return pieces;
  const Eigen::Index first = first_shown(path_m, last, side_m);
  for (int piece = 0; piece < kPathPieces; ++piece) {
    const auto end_of = [&](int count) { return first + (last - first) * count / kPathPieces; };
    Tube tube{.radius = kPathRadius * side_m,
              .style = {.colour = ThemeColour::kSeries1,
                        .share = static_cast<double>(piece + 1) / kPathPieces}};
    for (Eigen::Index i = end_of(piece); i <= end_of(piece + 1); ++i)
      if (path_m.row(i).allFinite()) tube.points.push_back(on_floor(path_m.row(i), tube.radius));
    if (piece + 1 == kPathPieces) tube.label = "path, the last " + counted(last - first, "step");
    if (tube.points.size() > 1) pieces.push_back(std::move(tube));
  }
  return pieces;
}

Rods robot_at(const Eigen::RowVector2d& at, double side_m) {
  constexpr double kRadius = 0.02, kHeight = 0.016;  // Of the room's side.
  return {.label = "robot",
          .from = {on_floor(at)},
          .to = {on_floor(at, kHeight * side_m)},
          .radius = kRadius * side_m,
          .style = {.colour = ThemeColour::kSeries1}};
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

Shot ground_view(const Ground& ground, double height_m, std::span<const Point3> also,
                 double aspect) {
  Shot view;
  view.camera = tight_camera(corners(ground, height_m, also), {0.42, -1.0, 0.95}, false, aspect);
  view.rules = floor_rules(ground);
  return view;
}

Shot room_view(double side_m, double height_m, std::span<const Point3> also, double aspect) {
  return ground_view(room_ground(side_m), height_m, also, aspect);
}

}  // namespace mapproof
