#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "core/model/points.hpp"
#include "core/model/world.hpp"
#include "render/base/geometry.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

/// The share of a colour in a legend's tint: what is not drawn in the full colour has this one.
inline constexpr double kTintShare = 0.2;

/// The height of the edge of open ground, of its side.
inline constexpr double kKerbShare = 0.012;

/// The sides of a room that is drawn. A graphics library multiplies two lengths of a scene, some
/// 1e-4 of its side each, in single precision, which ends at 1e-38.
inline constexpr double kShortestSide_m = 1e-14;
inline constexpr double kLongestSide_m = 1e6;

/// Whether a room of that side can be drawn: from kShortestSide_m to kLongestSide_m.
bool is_room_side(double side_m);

/// Whether a room can be drawn with its landmarks at true size, which no side may fall below.
bool has_room(const World& world);

/// From above and from two sides, so that neighbouring faces differ.
std::vector<Light> usual_lights();

/// A rectangle of ground, its sides along x and y.
struct Ground {
  Point low, high;

  double side() const { return std::max(high.x - low.x, high.y - low.y); }
};

/// The floor of a room: [0, side] x [0, side].
Ground room_ground(double side_m);

/// Two triangles per rectangle of corners a, b, c, d in turn.
void add_rectangle(Surface& surface, const Point3& a, const Point3& b, const Point3& c,
                   const Point3& d);

/// A floor at height 0.
Surface floor_of(const Ground& ground);

/// The floor [0, side] x [0, side] at height 0.
Surface floor_of(double side_m);

/// From one flat thing on the ground to the next above it, of the ground's side: all of them are
/// below the shadows.
inline constexpr double kFlatLayer = 1e-4;

/// Lines on the ground along x and y at round values.
Surface grid_of(const Ground& ground);

/// Boards of that height around the ground.
Surface walls_of(const Ground& ground, double height_m);

/// Low boards around the floor.
Surface walls_of(double side_m);

/// How high landmarks are drawn; only their plan is known.
double landmark_height(double side_m);

/// Upright rods on the floor, for those rows of `points_m` that have finite positions.
Rods pillars(const Points& points_m, const std::vector<Eigen::Index>& rows, double radius,
             double height);

/// Flat rings on the floor around those rows of `points_m` that have finite positions: what sets
/// their pillars apart from dark ones.
Surface rings(const Points& points_m, const std::vector<Eigen::Index>& rows, double radius);

/// The most steps of a path that fading_path() shows.
inline constexpr Eigen::Index kShownSteps = 150;

/// The first row of a path that fading_path() shows: at most kShownSteps before `last`, and not
/// much more of the path than the room is long, since a walk to and fro becomes a tangle.
Eigen::Index first_shown(const Points& path_m, Eigen::Index last, double side_m);

/// The path's last steps up to row `last`, the earlier ones paler: all of a long walk would hide
/// the floor. Nothing of fewer than two finite positions.
std::vector<Tube> fading_path(const Points& path_m, Eigen::Index last, double side_m);

/// A disc as large as can be seen, where the robot is.
Rods robot_at(const Eigen::RowVector2d& at, double side_m);

Point3 on_floor(const Eigen::RowVector2d& at, double height = 0.0);

/// Radius of the landmarks' pillars: the true one, or what can still be seen in a room so large.
double pillar_radius_m(const World& world);

/// "Landmarks are drawn 12 times as wide as they are.", or nothing.
std::string words_of_pillars(const World& world);

/// Sees a ground up to a height, and what else is said, with axes along its front edges, from the
/// south in perspective.
Shot ground_view(const Ground& ground, double height_m, std::span<const Point3> also = {},
                 double aspect = 1.6);

/// The same of a room: sees the whole room up to a height, and what else is said.
Shot room_view(double side_m, double height_m, std::span<const Point3> also = {},
               double aspect = 1.6);

}  // namespace mapproof
