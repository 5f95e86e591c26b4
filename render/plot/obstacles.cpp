#include "render/plot/obstacles.hpp"

#include <cmath>

#include "render/plot/markers.hpp"
#include "render/plot/outlines.hpp"

namespace mapproof {
namespace {

constexpr int kBandSlices = 6;

class Collector {
 public:
  Collector(const PanelMap& map, const Theme& theme, Obstacles& found)
      : map_(map), theme_(theme), found_(found) {}

  void operator()(const Polyline& line) {
    const double half = line.width * theme_.line_pt / 2.0;
    for (std::size_t i = 0; i + 1 < line.x.size(); ++i)
      add_line(map_(line.x[i], line.y[i]), map_(line.x[i + 1], line.y[i + 1]), half);
    if (line.marker == Marker::kNone && line.x.size() != 1) return;
    for (std::size_t i = 0; i < line.x.size(); ++i)
      add_marker(map_(line.x[i], line.y[i]), theme_.marker_pt);
  }

  /// Each piece of a band as a few boxes that together cover it.
  void operator()(const Band& band) {
    for (std::size_t i = 0; i + 1 < band.x.size(); ++i) {
      const Point low0 = map_(band.x[i], band.low[i]), low1 = map_(band.x[i + 1], band.low[i + 1]);
      const Point high0 = map_(band.x[i], band.high[i]);
      const Point high1 = map_(band.x[i + 1], band.high[i + 1]);
      if (std::isnan(low0.x + low0.y + low1.x + low1.y + high0.y + high1.y)) continue;
      for (int slice = 0; slice < kBandSlices; ++slice) {
        const double s = static_cast<double>(slice) / kBandSlices;
        const double t = static_cast<double>(slice + 1) / kBandSlices;
        const auto [top, bottom] =
            std::minmax({std::lerp(high0.y, high1.y, s), std::lerp(high0.y, high1.y, t),
                         std::lerp(low0.y, low1.y, s), std::lerp(low0.y, low1.y, t)});
        found_.boxes.push_back(
            {std::lerp(low0.x, low1.x, s), top, std::lerp(low0.x, low1.x, t), bottom});
      }
    }
  }

  void operator()(const Scatter& points) {
    for (std::size_t i = 0; i < points.x.size(); ++i)
      add_marker(map_(points.x[i], points.y[i]), points.size * theme_.marker_pt);
  }

  void operator()(const Segments& lines) {
    const double half = lines.width * theme_.line_pt / 2.0;
    for (std::size_t i = 0; i < lines.x0.size(); ++i) {
      const Point tip = map_(lines.x1[i], lines.y1[i]);
      add_line(map_(lines.x0[i], lines.y0[i]), tip, half);
      if (lines.arrow) add_marker(tip, 1.5 * theme_.marker_pt);
    }
  }

  void operator()(const PointLabels&) {}

  void operator()(const Area& area) {
    add_outline(area_path(area, map_), area.fill != Fill::kNone, area.width);
  }

  void operator()(const Ellipses& ellipses) {
    for (std::size_t i = 0; i < ellipses.x.size(); ++i)
      add_outline(ellipse_path(ellipses, i, map_), ellipses.fill != Fill::kNone, ellipses.width);
  }

  void operator()(const Cells& cells) {
    found_.boxes.push_back(
        {map_.x(cells.x.low), map_.y(cells.y.high), map_.x(cells.x.high), map_.y(cells.y.low)});
  }

  void operator()(const ImageLayer& image) {
    for (std::size_t i = 0; i < image.clear_x.size(); ++i) {
      const double by = image.clear_by[i];
      const Point low = map_(image.clear_x[i] - by, image.clear_y[i] - by);
      const Point high = map_(image.clear_x[i] + by, image.clear_y[i] + by);
      if (!std::isnan(low.x + low.y + high.x + high.y))
        found_.boxes.push_back({low.x, high.y, high.x, low.y});
    }
  }

  void operator()(const Texts& texts) {
    for (std::size_t i = 0; i < texts.x.size(); ++i)
      for (const TextLine& line : placed_text(texts, i, map_, theme_))
        found_.boxes.push_back(text_box(line));
  }

 private:
  void add_outline(const Outline& path, bool filled, double width) {
    const double half = width * theme_.line_pt / 2.0;
    for (const std::vector<Point>& ring : flattened(path)) {
      for (std::size_t i = 0; i < ring.size(); ++i)
        add_line(ring[i], ring[(i + 1) % ring.size()], half);
      if (!filled) continue;
      for (const Box& slice : covering_slices(ring)) found_.boxes.push_back(slice);
    }
  }

  void add_line(Point a, Point b, double half) {
    if (!std::isnan(a.x + a.y + b.x + b.y)) found_.lines.push_back({a, b, half});
  }

  void add_marker(Point at, double size) {
    if (std::isnan(at.x + at.y)) return;
    found_.boxes.push_back(
        Box{at.x, at.y, at.x, at.y}.grown(kMarkerReach * size + theme_.line_pt / 2));
  }

  const PanelMap& map_;
  const Theme& theme_;
  Obstacles& found_;
};

}  // namespace

bool Obstacles::hit(const Box& box) const {
  for (const Box& other : boxes)
    if (box.overlaps(other)) return true;
  for (const Line& line : lines)
    if (crosses(box.grown(line.half_width), line.a, line.b)) return true;
  return false;
}

Obstacles data_obstacles(const Panel& panel, const PanelMap& map, const Theme& theme) {
  Obstacles found;
  for (const Layer& layer : panel.layers) std::visit(Collector(map, theme, found), layer);
  return found;
}

}  // namespace mapproof
