#pragma once

#include <vector>

#include "core/model/points.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

/// From above and from two sides, so that neighbouring faces differ.
std::vector<Light> usual_lights();

/// Two triangles a rectangle of corners a, b, c, d in turn.
void add_rectangle(Surface& surface, const Point3& a, const Point3& b, const Point3& c,
                   const Point3& d);

/// The floor [0, side] x [0, side] at height 0.
Surface floor_of(double side_m);

/// Low boards around the floor.
Surface walls_of(double side_m);

/// How high landmarks are drawn; only their plan is known.
double landmark_height(double side_m);

/// Upright rods on the floor, for those rows of `points_m` that have finite places.
Rods pillars(const Points& points_m, const std::vector<Eigen::Index>& rows, double radius,
             double height);

Point3 on_floor(const Eigen::RowVector2d& at, double height = 0.0);

/// Sees the whole room up to a height, with axes along its front edges, from the south in
/// perspective.
Shot room_view(double side_m, double height_m, double aspect = 1.6);

/// The same from straight above, x to the right, y upward.
Shot room_plan(double side_m);

}  // namespace mapproof
