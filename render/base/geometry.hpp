#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace mapproof {

/// In points (1/72 in), x to the right, y downward, unless a name says otherwise.
struct Point {
  double x = 0.0;
  double y = 0.0;

  bool operator==(const Point&) const = default;
};

inline bool is_finite(Point p) { return std::isfinite(p.x) && std::isfinite(p.y); }

/// An upright rectangle; empty unless x0 < x1 and y0 < y1.
struct Box {
  double x0 = 0.0;
  double y0 = 0.0;
  double x1 = 0.0;
  double y1 = 0.0;

  double width() const { return x1 - x0; }
  double height() const { return y1 - y0; }
  Point centre() const { return {(x0 + x1) / 2.0, (y0 + y1) / 2.0}; }
  Box grown(double by) const { return {x0 - by, y0 - by, x1 + by, y1 + by}; }
  Box moved(double dx, double dy) const { return {x0 + dx, y0 + dy, x1 + dx, y1 + dy}; }
  bool overlaps(const Box& b) const { return x0 < b.x1 && b.x0 < x1 && y0 < b.y1 && b.y0 < y1; }
  bool holds(const Box& b) const { return x0 <= b.x0 && b.x1 <= x1 && y0 <= b.y0 && b.y1 <= y1; }
  Box united(const Box& b) const {
    return {std::min(x0, b.x0), std::min(y0, b.y0), std::max(x1, b.x1), std::max(y1, b.y1)};
  }
};

/// Whether the straight line from a to b has a point in the box.
bool crosses(const Box& box, Point a, Point b);

/// The part of the line from a to b that lies in the box, as parameters in [0, 1]; false if none.
bool clip_line(const Box& box, Point a, Point b, double& enter, double& leave);

enum class PathCommand : std::uint8_t { kMove, kLine, kQuad, kCubic, kClose };

/// Outlines: kMove and kLine take one point, kQuad two, kCubic three, kClose none.
struct Outline {
  std::vector<PathCommand> commands;
  std::vector<Point> points;

  void move_to(Point p) { add(PathCommand::kMove, p); }
  void line_to(Point p) { add(PathCommand::kLine, p); }
  void cubic_to(Point a, Point b, Point p) {
    commands.push_back(PathCommand::kCubic);
    points.insert(points.end(), {a, b, p});
  }
  void quad_to(Point control, Point p) {
    add(PathCommand::kQuad, control);
    points.push_back(p);
  }
  void close() { commands.push_back(PathCommand::kClose); }
  void add_box(const Box& box);
  /// Four cubics.
  void add_circle(Point centre, double radius);

 private:
  void add(PathCommand command, Point p) {
    commands.push_back(command);
    points.push_back(p);
  }
};

/// The path as far as it lies in the box, which may be of any size; none of its coordinates is
/// NaN, they may be infinite. An open path of straight lines is cut at the sides; of any other the
/// points outside are moved to the nearest side.
Outline cut_to(const Box& box, Outline path);

/// The least box that holds all points of the path, control points too.
Box bounds(const Outline& path);

}  // namespace mapproof
