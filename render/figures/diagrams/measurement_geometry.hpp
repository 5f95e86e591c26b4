#pragma once

#include <string>
#include <vector>

#include "core/model/study.hpp"
#include "render/base/geometry.hpp"

namespace mapproof {

/// The parts of figures of a measurement, in the plane and in space.

/// @throws InvalidInput if parts disagree in size, lengths are not positive, positions are not
/// finite,
///         or the sensor is neither visibility nor bearing.
void require_consistent(const Measurement& measurement);

/// The point at that distance and angle from `at`, counter-clockwise from the x axis.
Point beside(Point at, double distance, double angle_rad);

/// Points of an arc, every 3 degrees, both ends among them.
std::vector<Point> arc_points(Point centre, double radius, double begin_rad, double end_rad);

/// "−63°".
std::string degrees(double angle_rad);

/// "50 landmarks at −171° to 178°", the bearings from the heading that are known; "1 landmark at
/// 45°"; "no landmark" without one.
std::string bearings_text(const Measurement& measurement);

/// What each landmark within reach hides: between the tangents from the robot, from where they
/// touch it to the edge of the disc; the first two points touch, the rest are the edge's arc.
std::vector<std::vector<Point>> shadow_outlines(const Measurement& measurement);

/// Up to three landmarks whose bearings are worth a name: well apart, not close by, those nearest
/// to 45, -75 and 150 degrees.
std::vector<Eigen::Index> named_bearings(const Measurement& measurement);

}  // namespace mapproof
