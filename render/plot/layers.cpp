#include "render/plot/layers.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "render/plot/markers.hpp"
#include "render/plot/outlines.hpp"

namespace mapproof {
namespace {

constexpr double kMarkerSpacing = 4.0;    // Of a dense line, in units of their size.
constexpr double kIntervalWidth = 0.9;    // Of an interval's bar, in lines of the theme.
constexpr double kIntervalSpacing = 1.9;  // Between bars at one point, in lines of the theme.
constexpr double kWideBars = 10.0;        // More bars at a point have the room of so many.
/// How far from its frame a line is drawn, in points: it cannot be seen there, and dashes that are
/// drawn all the way take any time and memory.
constexpr double kFarthest = 10'000.0;

bool known(Point p) { return !std::isnan(p.x) && !std::isnan(p.y); }

class Painter {
 public:
  /// @param bar_bands  How many bands are drawn as bars: all of the panel, or none.
  Painter(std::size_t panel, std::ptrdiff_t bar_bands, const PanelMap& map, const Theme& theme,
          Drawing& drawing)
      : panel_(panel), bar_bands_(bar_bands), map_(map), theme_(theme), drawing_(drawing) {}

  void operator()(const Polyline& line) {
    if (!line.values.empty()) return draw_coloured(line);
    Shape shape;
    shape.stroke = stroke_of(line.colour, line.dash, line.width, theme_);
    bool pen_down = false;
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      const Point p = map_(line.x[i], line.y[i]);
      if (known(p)) pen_down ? shape.path.line_to(p) : shape.path.move_to(p);
      pen_down = known(p);
    }
    const auto mark = add_mark(line.mark);
    if (!shape.path.points.empty()) add(ItemClass::kLine, std::move(shape), mark);
    draw_markers(line, mark);
  }

  void operator()(const Band& band) {
    if (bar_bands_ > 0) return draw_bars(band);
    Shape shape;
    shape.fill = theme_.of(band.colour);
    shape.fill_opacity = kBandOpacity;
    for (std::size_t i = 0; i < band.x.size();) {
      std::size_t end = i;
      while (end < band.x.size() && known(map_(band.x[end], band.low[end] + band.high[end]))) ++end;
      if (end > i) add_band_piece(band, i, end, shape.path);
      i = std::max(end, i + 1);
    }
    if (!shape.path.points.empty()) add(ItemClass::kBand, std::move(shape), add_mark(band.mark));
  }

  void operator()(const Scatter& points) {
    if (points.marker == Marker::kNone) return;
    const std::size_t symbol = symbol_of(points.marker, points.filled, points.size, points.colour);
    for (std::size_t i = 0; i < points.x.size(); ++i) {
      const Point at = map_(points.x[i], points.y[i]);
      if (in_frame(at)) stamp(symbol, at, mark_at(points.marks, i));
    }
  }

  void operator()(const Segments& lines) {
    const Stroke stroke = stroke_of(lines.colour, lines.dash, lines.width, theme_);
    for (std::size_t i = 0; i < lines.x0.size(); ++i) {
      const Point from = map_(lines.x0[i], lines.y0[i]);
      const Point to = map_(lines.x1[i], lines.y1[i]);
      if (!known(from) || !known(to)) continue;
      Shape shape;
      shape.stroke = stroke;
      shape.path.move_to(from);
      shape.path.line_to(to);
      const auto mark = mark_at(lines.marks, i);
      add(ItemClass::kLine, std::move(shape), mark);
      if (lines.arrow)
        drawing_.add(ItemClass::kMarker, panel_, arrow_head(from, to, stroke.colour, theme_));
    }
  }

  void operator()(const PointLabels&) {}

  void operator()(const Area& area) {
    Shape shape = filled_shape(area.fill, area.colour, theme_);
    if (area.outlined) shape.stroke = stroke_of(area.colour, area.dash, area.width, theme_);
    shape.path = area_path(area, map_);
    if (!shape.path.points.empty())
      add(area.fill == Fill::kSolid ? ItemClass::kMarker : ItemClass::kBand, std::move(shape),
          add_mark(area.mark));
  }

  void operator()(const Ellipses& ellipses) {
    const Stroke stroke = stroke_of(ellipses.colour, ellipses.dash, ellipses.width, theme_);
    for (std::size_t i = 0; i < ellipses.x.size(); ++i) {
      Shape shape = filled_shape(ellipses.fill, ellipses.colour, theme_);
      shape.stroke = stroke;
      shape.path = ellipse_path(ellipses, i, map_);
      if (!shape.path.points.empty())
        add(ItemClass::kMarker, std::move(shape), mark_at(ellipses.marks, i));
    }
  }

  void operator()(const Cells& cells) {
    const auto mark = add_mark(cells.mark);
    for (Shape& shape : cell_shapes(cells, map_, theme_))
      add(ItemClass::kCells, std::move(shape), mark);
    for (TextLine& line : cell_texts(cells, map_, theme_))
      drawing_.add(ItemClass::kCellText, panel_, std::move(line));
  }

  void operator()(const ImageLayer& image) {
    drawing_.add(ItemClass::kImage, panel_,
                 Raster{{map_.x(image.x.low), map_.y(image.y.high), map_.x(image.x.high),
                         map_.y(image.y.low)},
                        image.source,
                        nullptr});
  }

  void operator()(const Texts& texts) {
    for (std::size_t i = 0; i < texts.x.size(); ++i)
      for (TextLine& line : placed_text(texts, i, map_, theme_))
        drawing_.add(ItemClass::kMarkLabel, panel_, std::move(line));
  }

 private:
  void draw_coloured(const Polyline& line) {
    const auto mark = add_mark(line.mark);
    for (Shape& shape : coloured_line_shapes(line, map_, theme_))
      add(ItemClass::kLine, std::move(shape), mark);
  }

  /// How far apart markers are at least: they only do not touch, unless the line has more points
  /// than its frame has room for, where they leave its dashes visible between them.
  double marker_spacing(const Polyline& line) const {
    const double touching = 2.0 * kMarkerReach * theme_.marker_pt;
    int in_sight = 0;
    for (std::size_t i = 0; i < line.x.size(); ++i)
      in_sight += in_frame(map_(line.x[i], line.y[i])) ? 1 : 0;
    return in_sight * touching > drawing_.frames[panel_].width() ? kMarkerSpacing * theme_.marker_pt
                                                                 : touching;
  }

  /// Each point has a marker that does not come too near to the one before it.
  void draw_markers(const Polyline& line, std::optional<std::size_t> mark) {
    if (line.marker == Marker::kNone) return;
    const std::size_t symbol = symbol_of(line.marker, true, 1.0, line.colour);
    const double least = marker_spacing(line);
    double last = -kInfinity;
    std::string values;
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      const Point at = map_(line.x[i], line.y[i]);
      if (!in_frame(at) || at.x - last < least) continue;
      stamp(symbol, at, mark);
      values += fmt::format("{}{:.6g}, {:.4g}", values.empty() ? "" : ";", line.x[i], line.y[i]);
      last = at.x;
    }
    // What a page shows where the pointer is, in the order of the markers.
    if (mark &&
        std::ranges::find(line.mark.data, "curve", &std::pair<std::string, std::string>::first) !=
            line.mark.data.end())
      drawing_.marks[*mark].data.emplace_back("points", std::move(values));
  }

  /// A bar per point, those of one point side by side, and thin ones of many bands; points that
  /// have no room for that are left out, the same ones for all bands.
  void draw_bars(const Band& band) {
    const auto count = static_cast<double>(bar_bands_);
    const double thin = std::min(1.0, kWideBars / count);
    const double spacing = thin * kIntervalSpacing * theme_.line_pt;
    const double offset = (static_cast<double>(next_bar_band_++) - (count - 1.0) / 2.0) * spacing;
    Shape shape;
    shape.stroke = stroke_of(band.colour, Dash::kSolid, thin * kIntervalWidth, theme_);
    double last = -kInfinity;
    for (std::size_t i = 0; i < band.x.size(); ++i) {
      const Point low = map_(band.x[i], band.low[i]), high = map_(band.x[i], band.high[i]);
      if (low.x - last < (count + 1.0) * spacing) continue;
      last = low.x;
      if (!known(low) || !known(high)) continue;
      shape.path.move_to({low.x + offset, low.y});
      shape.path.line_to({high.x + offset, high.y});
    }
    if (!shape.path.points.empty()) add(ItemClass::kBand, std::move(shape), add_mark(band.mark));
  }

  /// A point without neighbours gets a band as wide as a marker.
  void add_band_piece(const Band& band, std::size_t begin, std::size_t end, Outline& path) {
    if (end - begin == 1) {
      const Point low = map_(band.x[begin], band.low[begin]);
      const double high = map_.y(band.high[begin]), half = theme_.marker_pt / 2.0;
      path.add_box({low.x - half, std::min(low.y, high), low.x + half, std::max(low.y, high)});
      return;
    }
    path.move_to(map_(band.x[begin], band.high[begin]));
    for (std::size_t i = begin + 1; i < end; ++i) path.line_to(map_(band.x[i], band.high[i]));
    for (std::size_t i = end; i-- > begin;) path.line_to(map_(band.x[i], band.low[i]));
    path.close();
  }

  std::size_t symbol_of(Marker marker, bool filled, double size, ThemeColour colour) {
    return symbol_index(drawing_, marker_symbol(marker, filled, size * theme_.marker_pt,
                                                theme_.of(colour), theme_));
  }

  std::optional<std::size_t> mark_at(const std::vector<Mark>& marks, std::size_t i) {
    return marks.empty() ? std::nullopt : add_mark(marks[i]);
  }

  std::optional<std::size_t> add_mark(const Mark& mark) {
    if (mark.id.empty() && mark.data.empty()) return std::nullopt;
    drawing_.marks.push_back(mark);
    return drawing_.marks.size() - 1;
  }

  bool in_frame(Point p) const {
    return known(p) && drawing_.frames[panel_].grown(1e-6).holds({p.x, p.y, p.x, p.y});
  }

  /// Markers are drawn whole, also at the frame.
  void stamp(std::size_t symbol, Point at, std::optional<std::size_t> mark) {
    drawing_.add(ItemClass::kMarker, panel_, Stamp{symbol, at}).mark = mark;
  }

  template <typename What>
  void add(ItemClass item_class, What&& what, std::optional<std::size_t> mark) {
    if constexpr (std::is_same_v<std::remove_cvref_t<What>, Shape>)
      what.path = cut_to(drawing_.frames[panel_].grown(kFarthest), std::move(what.path));
    Item& item = drawing_.add(item_class, panel_, std::forward<What>(what));
    item.clipped = true;
    item.mark = mark;
  }

  std::size_t panel_;
  std::ptrdiff_t bar_bands_;
  std::ptrdiff_t next_bar_band_ = 0;
  const PanelMap& map_;
  const Theme& theme_;
  Drawing& drawing_;
};

constexpr std::size_t kMostOverlaps = 3;

std::vector<const Band*> bands_of(const Panel& panel) {
  std::vector<const Band*> bands;
  for (const Layer& layer : panel.layers)
    if (const auto* band = std::get_if<Band>(&layer)) bands.push_back(band);
  return bands;
}

/// The known intervals of all bands at that x.
std::vector<Range> intervals_at(const std::vector<const Band*>& bands, double x) {
  std::vector<Range> intervals;
  for (const Band* band : bands)
    for (std::size_t i = 0; i < band->x.size(); ++i)
      if (band->x[i] == x && !std::isnan(band->low[i] + band->high[i]))
        intervals.push_back({band->low[i], band->high[i]});
  return intervals;
}

/// The most of the intervals that have a value in common.
std::size_t depth(const std::vector<Range>& intervals) {
  std::ptrdiff_t most = 0;
  for (const Range& at : intervals)
    most = std::max(most, std::ranges::count_if(intervals, [&](const Range& one) {
                      return one.low <= at.low && at.low <= one.high;
                    }));
  return static_cast<std::size_t>(most);
}

}  // namespace

bool bands_hide_each_other(const Panel& panel) {
  const std::vector<const Band*> bands = bands_of(panel);
  if (bands.size() <= kMostOverlaps) return false;
  return std::ranges::any_of(bands, [&](const Band* band) {
    return std::ranges::any_of(
        band->x, [&](double x) { return depth(intervals_at(bands, x)) > kMostOverlaps; });
  });
}

Stroke stroke_of(ThemeColour colour, Dash dash, double width, const Theme& theme) {
  const double width_pt = width * theme.line_pt;
  return {dash == Dash::kSolid ? theme.of(colour) : theme.of_dashed(colour), width_pt,
          dash_lengths(dash, width_pt)};
}

Shape filled_shape(Fill fill, ThemeColour colour, const Theme& theme) {
  Shape shape;
  if (fill != Fill::kNone) shape.fill = fill == Fill::kPaper ? theme.background : theme.of(colour);
  if (fill == Fill::kTint) shape.fill_opacity = kBandOpacity;
  return shape;
}

bool has_image(const Panel& panel) {
  return std::ranges::any_of(
      panel.layers, [](const Layer& layer) { return std::holds_alternative<ImageLayer>(layer); });
}

std::vector<double> dash_lengths(Dash dash, double width_pt) {
  const double w = width_pt;
  switch (dash) {
    case Dash::kSolid:
      return {};
    case Dash::kDashed:
      return {4.0 * w, 2.0 * w};
    case Dash::kDotted:
      return {1.2 * w, 1.6 * w};
    case Dash::kDashDot:
      return {5.0 * w, 1.8 * w, 1.2 * w, 1.8 * w};
    case Dash::kLongDash:
      return {8.0 * w, 2.5 * w};
  }
  return {};
}

void draw_layers(const Panel& panel, std::size_t panel_index, const PanelMap& map,
                 const Theme& theme, Drawing& drawing) {
  const std::ptrdiff_t bar_bands = bands_hide_each_other(panel) ? std::ssize(bands_of(panel)) : 0;
  Painter painter(panel_index, bar_bands, map, theme, drawing);
  for (const Layer& layer : panel.layers) std::visit(painter, layer);
}

}  // namespace mapproof
