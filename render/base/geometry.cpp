#include "render/base/geometry.hpp"

#include <array>

namespace mapproof {

bool clip_line(const Box& box, Point a, Point b, double& enter, double& leave) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const std::array<std::array<double, 2>, 4> sides = {
      {{-dx, a.x - box.x0}, {dx, box.x1 - a.x}, {-dy, a.y - box.y0}, {dy, box.y1 - a.y}}};
  enter = 0.0;
  leave = 1.0;
  for (const auto& [slope, room] : sides) {
    if (slope == 0.0) {
      if (room < 0.0) return false;
    } else if (slope < 0.0) {
      enter = std::max(enter, room / slope);
    } else {
      leave = std::min(leave, room / slope);
    }
  }
  return enter <= leave;
}

bool crosses(const Box& box, Point a, Point b) {
  double enter = 0.0;
  double leave = 0.0;
  return clip_line(box, a, b, enter, leave);
}

void Outline::add_box(const Box& box) {
  move_to({box.x0, box.y0});
  line_to({box.x1, box.y0});
  line_to({box.x1, box.y1});
  line_to({box.x0, box.y1});
  close();
}

void Outline::add_circle(Point centre, double radius) {
  const double k = 0.5522847498307936 * radius;  // Control points of a quarter circle.
  const auto [x, y] = centre;
  const double r = radius;
  move_to({x + r, y});
  const std::array<std::array<Point, 3>, 4> quarters = {{
      {{{x + r, y + k}, {x + k, y + r}, {x, y + r}}},
      {{{x - k, y + r}, {x - r, y + k}, {x - r, y}}},
      {{{x - r, y - k}, {x - k, y - r}, {x, y - r}}},
      {{{x + k, y - r}, {x + r, y - k}, {x + r, y}}},
  }};
  for (const auto& quarter : quarters) {
    commands.push_back(PathCommand::kCubic);
    points.insert(points.end(), quarter.begin(), quarter.end());
  }
  close();
}

namespace {

Point moved_into(const Box& box, Point p) {
  return {std::clamp(p.x, box.x0, box.x1), std::clamp(p.y, box.y0, box.y1)};
}

/// Adds the part of the line that lies in the box. @param joins  The path ends at `a`.
void add_part(const Box& box, Point a, Point b, bool joins, Outline& path) {
  double enter = 0.0, leave = 1.0;
  if (!clip_line(box, a, b, enter, leave)) return;
  const auto at = [&](double share) {
    return moved_into(box, {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)});
  };
  if (!joins || enter > 0.0) path.move_to(enter > 0.0 ? at(enter) : a);
  path.line_to(leave < 1.0 ? at(leave) : b);
}

/// Of moves and lines alone.
Outline cut_lines(const Box& box, const Outline& path) {
  constexpr double kFarthest = 1e100;  // Differences of such numbers are finite.
  const Box farthest{-kFarthest, -kFarthest, kFarthest, kFarthest};
  Outline cut;
  Point last;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const Point p = moved_into(farthest, path.points[i]);
    const bool joins = !cut.points.empty() && cut.points.back() == last;
    if (path.commands[i] == PathCommand::kLine) add_part(box, last, p, joins, cut);
    // A line of no length is a dot.
    else if (box.holds({p.x, p.y, p.x, p.y}))
      cut.move_to(p);
    last = p;
  }
  return cut;
}

}  // namespace

Outline cut_to(const Box& box, Outline path) {
  const auto is_inside = [&](Point p) { return box.holds({p.x, p.y, p.x, p.y}); };
  if (std::ranges::all_of(path.points, is_inside)) return path;
  const auto is_straight = [](PathCommand command) {
    return command == PathCommand::kMove || command == PathCommand::kLine;
  };
  if (std::ranges::all_of(path.commands, is_straight)) return cut_lines(box, path);
  for (Point& p : path.points) p = moved_into(box, p);
  return path;
}

Box bounds(const Outline& path) {
  if (path.points.empty()) return {};
  const Point first = path.points.front();
  Box box{first.x, first.y, first.x, first.y};
  for (const Point p : path.points) box = box.united({p.x, p.y, p.x, p.y});
  return box;
}

}  // namespace mapproof
