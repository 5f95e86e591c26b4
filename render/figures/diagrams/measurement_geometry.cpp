#include "render/figures/diagrams/measurement_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/base/span.hpp"

namespace mapproof {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kArcStep_rad = 3.0 * kDegree;
constexpr double kNear = 0.16;  // Of the room's side: too close to the robot for a name.

}  // namespace

void require_consistent(const Measurement& m) {
  const auto refuse = [](const std::string& what) { throw InvalidInput("measurement: " + what); };
  const auto count = static_cast<std::size_t>(m.world.landmarks_m.rows());
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (m.sensor == Sensor::kRange) refuse("ranges have no figure");
  if (!positive(m.world.side_m) || !positive(m.world.landmark_diameter_m))
    refuse("the room's side or the landmarks' diameter is not positive");
  if (!m.world.landmarks_m.allFinite() || !m.path_m.allFinite() || !m.robot_m.allFinite() ||
      !std::isfinite(m.heading_rad))
    refuse("a position or the heading is not finite");
  if (m.sensor == Sensor::kVisibility) {
    if (m.views.size() != count)
      refuse(fmt::format("{} views of {} landmarks", m.views.size(), count));
    if (!positive(m.reach_m)) refuse("the reach is not positive");
  } else {
    if (static_cast<std::size_t>(m.bearings_rad.size()) != count)
      refuse(fmt::format("{} bearings of {} landmarks", m.bearings_rad.size(), count));
    if (m.bearings_rad.array().isInf().any()) refuse("an infinite bearing");
  }
}

Point beside(Point at, double distance, double angle_rad) {
  return {at.x + distance * std::cos(angle_rad), at.y + distance * std::sin(angle_rad)};
}

std::vector<Point> arc_points(Point centre, double radius, double begin_rad, double end_rad) {
  const double turn = end_rad - begin_rad;
  const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / kArcStep_rad)));
  std::vector<Point> points;
  for (int i = 0; i <= pieces; ++i)
    points.push_back(beside(centre, radius, begin_rad + turn * i / pieces));
  return points;
}

std::string degrees(double angle_rad) { return number_text(angle_rad / kDegree, 0) + "°"; }

std::string bearings_text(const Measurement& m) {
  Span span;
  for (const double bearing_rad : m.bearings_rad) span.see(bearing_rad);
  if (!span.known()) return "no landmark";
  const auto known = static_cast<long long>(m.bearings_rad.array().isFinite().count());
  const std::string low = degrees(span.low), high = degrees(span.high);
  return fmt::format("{} at {}", counted(known, "landmark"),
                     low == high ? low : low + " to " + high);
}

std::vector<std::vector<Point>> shadow_outlines(const Measurement& m) {
  const Point robot{m.robot_m.x(), m.robot_m.y()};
  const double radius = m.world.landmark_diameter_m / 2.0;
  std::vector<std::vector<Point>> shadows;
  for (Eigen::Index i = 0; i < m.world.landmarks_m.rows(); ++i) {
    const Eigen::RowVector2d offset = m.world.landmarks_m.row(i) - m.robot_m;
    const double distance = offset.norm();
    if (m.views[i] == View::kOutOfReach || distance <= radius) continue;
    const double tangent = std::sqrt(distance * distance - radius * radius);
    if (tangent >= m.reach_m) continue;
    const double middle = std::atan2(offset.y(), offset.x());
    const double half = std::asin(radius / distance);
    shadows.push_back(
        {beside(robot, tangent, middle + half), beside(robot, tangent, middle - half)});
    for (const Point p : arc_points(robot, m.reach_m, middle - half, middle + half))
      shadows.back().push_back(p);
  }
  return shadows;
}

std::vector<Eigen::Index> named_bearings(const Measurement& m) {
  std::vector<Eigen::Index> chosen;
  for (const double target : {45.0 * kDegree, -75.0 * kDegree, 150.0 * kDegree}) {
    double least = 30.0 * kDegree;
    std::optional<Eigen::Index> best;
    for (Eigen::Index i = 0; i < m.world.landmarks_m.rows(); ++i) {
      const double distance = (m.world.landmarks_m.row(i) - m.robot_m).norm();
      const double off = std::abs(m.bearings_rad(i) - target);
      if (!(off < least) || distance < kNear * m.world.side_m) continue;
      least = off;
      best = i;
    }
    if (best) chosen.push_back(*best);
  }
  return chosen;
}

}  // namespace mapproof
