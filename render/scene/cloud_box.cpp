#include "render/scene/cloud_box.hpp"

#include "core/base/errors.hpp"
#include "render/scene/projection.hpp"
#include "render/scene/room.hpp"

namespace mapproof {
namespace {

constexpr double kPadding = 0.06;      // Of each side.
constexpr double kLeastSide = 0.05;    // Of the diagonal.
constexpr double kBoxLabelRoom = 0.06;  // Of the diagonal: less cuts labels of the samples.

}  // namespace

CloudBox::CloudBox(std::span<const Point3> points) {
  if (points.empty()) throw InvalidInput("a scene of no points");
  low = high = points[0];
  for (const Point3& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double least = std::max(kLeastSide * (high - low).norm(), 1e-9);
  const Point3 missing = (Point3::Constant(least) - (high - low)).cwiseMax(0.0) / 2.0;
  const Point3 padding = missing + kPadding * (high - low);
  low -= padding;
  high += padding;
}

std::array<Point3, 8> CloudBox::corners() const {
  std::array<Point3, 8> found;
  for (std::size_t i = 0; i < found.size(); ++i)
    found[i] = {i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(), i & 4 ? high.z() : low.z()};
  return found;
}

Surface CloudBox::floor() const {
  Surface floor = floor_of(Ground{{low.x(), low.y()}, {high.x(), high.y()}});
  for (Point3& point : floor.points) point.z() = low.z();
  return floor;
}

Rods CloudBox::edges() const {
  Rods rods{.radius = 0.0012 * size(),
            .style = {.colour = ThemeColour::kMuted, .share = 0.6, .lit = false}};
  const std::array<Point3, 8> at = corners();
  for (std::size_t i = 0; i < at.size(); ++i)
    for (const std::size_t bit : {1U, 2U, 4U})
      if ((i & bit) == 0) {
        rods.from.push_back(at[i]);
        rods.to.push_back(at[i | bit]);
      }
  return rods;
}

std::vector<Rule> CloudBox::rules(const std::array<std::string, 3>& labels) const {
  const Point3 right_front{high.x(), low.y(), low.z()};
  return {{.from = low,
           .to = right_front,
           .range = {low.x(), high.x()},
           .label = labels[0],
           .away = -Point3::UnitY()},
          {.from = right_front,
           .to = {high.x(), high.y(), low.z()},
           .range = {low.y(), high.y()},
           .label = labels[1],
           .away = Point3::UnitX()},
          {.from = low,
           .to = {low.x(), low.y(), high.z()},
           .range = {low.z(), high.z()},
           .label = labels[2],
           .away = -Point3::UnitX()}};
}

std::vector<Point3> CloudBox::shown() const {
  const double room = kBoxLabelRoom * size();
  const std::array<Point3, 8> all = corners();
  std::vector<Point3> shown(all.begin(), all.end());
  for (const Rule& rule : rules({"", "", ""}))
    for (const Point3& end : {rule.from, rule.to}) shown.emplace_back(end + room * rule.away);
  return shown;
}

Camera CloudBox::camera(const Point3& direction, double aspect) const {
  return fitted_camera(shown(), direction, false, aspect);
}

Camera CloudBox::camera(const Point3& direction) const {
  constexpr double kUsualAspect = 1.6;
  return tight_camera(shown(), direction, false, kUsualAspect);
}

}  // namespace mapproof
