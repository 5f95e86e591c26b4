#include "render/plot/markers.hpp"

#include <cmath>
#include <initializer_list>

namespace mapproof {
namespace {

Outline polygon(std::initializer_list<Point> corners, double size) {
  Outline path;
  for (const Point p : corners) {
    const Point at{p.x * size, p.y * size};
    path.points.empty() ? path.move_to(at) : path.line_to(at);
  }
  path.close();
  return path;
}

Outline strokes(std::initializer_list<std::pair<Point, Point>> lines, double size) {
  Outline path;
  for (const auto& [a, b] : lines) {
    path.move_to({a.x * size, a.y * size});
    path.line_to({b.x * size, b.y * size});
  }
  return path;
}

Outline outline(Marker marker, double size) {
  Outline path;
  switch (marker) {
    case Marker::kNone:
      break;
    case Marker::kCircle:
      path.add_circle({0.0, 0.0}, size / 2.0);
      break;
    case Marker::kSquare:
      path.add_box(Box{}.grown(0.43 * size));
      break;
    case Marker::kTriangle:
      return polygon({{0.0, -0.62}, {0.56, 0.38}, {-0.56, 0.38}}, size);
    case Marker::kTriangleDown:
      return polygon({{0.0, 0.62}, {0.56, -0.38}, {-0.56, -0.38}}, size);
    case Marker::kDiamond:
      return polygon({{0.0, -0.62}, {0.62, 0.0}, {0.0, 0.62}, {-0.62, 0.0}}, size);
    case Marker::kCross:
      return strokes({{{-0.42, -0.42}, {0.42, 0.42}}, {{-0.42, 0.42}, {0.42, -0.42}}}, size);
    case Marker::kPlus:
      return strokes({{{-0.55, 0.0}, {0.55, 0.0}}, {{0.0, -0.55}, {0.0, 0.55}}}, size);
  }
  return path;
}

bool equal(const Shape& a, const Shape& b) {
  const auto stroke = [](const Shape& shape) {
    return shape.stroke ? std::pair(shape.stroke->colour, shape.stroke->width)
                        : std::pair(Colour{}, 0.0);
  };
  return a.fill == b.fill && stroke(a) == stroke(b) && a.path.commands == b.path.commands &&
         a.path.points == b.path.points;
}

}  // namespace

Shape marker_symbol(Marker marker, bool filled, double size_pt, Colour colour, const Theme& theme) {
  Shape symbol;
  const bool of_lines = marker == Marker::kCross || marker == Marker::kPlus;
  symbol.path = outline(marker, size_pt);
  if (marker == Marker::kCircle) symbol.circle_radius = size_pt / 2.0;
  if (!of_lines) symbol.fill = filled ? colour : theme.background;
  if (!filled || of_lines) symbol.stroke = Stroke{colour, 0.8 * theme.line_pt, {}};
  return symbol;
}

Shape arrow_head(Point from, Point to, Colour colour, const Theme& theme) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  const double size = length > 0.0 ? 1.2 * theme.marker_pt / length : 0.0;
  const Point along{(to.x - from.x) * size, (to.y - from.y) * size};
  Shape head;
  head.fill = colour;
  head.path.move_to(to);
  head.path.line_to({to.x - along.x - 0.4 * along.y, to.y - along.y + 0.4 * along.x});
  head.path.line_to({to.x - along.x + 0.4 * along.y, to.y - along.y - 0.4 * along.x});
  head.path.close();
  return head;
}

std::size_t symbol_index(Drawing& drawing, const Shape& symbol) {
  for (std::size_t i = 0; i < drawing.symbols.size(); ++i)
    if (equal(drawing.symbols[i], symbol)) return i;
  drawing.symbols.push_back(symbol);
  return drawing.symbols.size() - 1;
}

}  // namespace mapproof
