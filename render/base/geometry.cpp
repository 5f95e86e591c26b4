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

Box bounds(const Outline& path) {
  if (path.points.empty()) return {};
  const Point first = path.points.front();
  Box box{first.x, first.y, first.x, first.y};
  for (const Point p : path.points) box = box.united({p.x, p.y, p.x, p.y});
  return box;
}

}  // namespace mapproof
