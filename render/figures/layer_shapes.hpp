#pragma once

#include <Eigen/Core>

#include "render/base/geometry.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

inline void add_point(Scatter& points, Point p) {
  points.x.push_back(p.x);
  points.y.push_back(p.y);
}

inline void add_line(Segments& lines, Point from, Point to) {
  lines.x0.push_back(from.x);
  lines.y0.push_back(from.y);
  lines.x1.push_back(to.x);
  lines.y1.push_back(to.y);
}

inline void add_point(Polyline& line, Point p) {
  line.x.push_back(p.x);
  line.y.push_back(p.y);
}

inline void add_corner(Area& area, Point p) {
  area.x.push_back(p.x);
  area.y.push_back(p.y);
}

/// Ends an outline, so that another may begin.
void end_outline(Area& area);

/// Adds an upright rectangle.
void add_box(Area& area, const Range& x, const Range& y);

void add_disc(Ellipses& discs, Point centre, double radius);

void add_label(PointLabels& labels, Point at, const std::string& text);

void add_text(Texts& texts, Point at, const std::string& text);

inline Point point_of(const Eigen::RowVector2d& row) { return {row.x(), row.y()}; }

}  // namespace mapproof
