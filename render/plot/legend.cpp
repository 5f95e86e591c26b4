#include "render/plot/legend.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "render/plot/layers.hpp"
#include "render/plot/line_ends.hpp"
#include "render/plot/markers.hpp"
#include "render/plot/outlines.hpp"
#include "render/plot/short_names.hpp"

namespace mapproof {
namespace {

constexpr double kLeastSample = 2.4;  // All in em.
constexpr double kSampleGap = 0.6;
constexpr double kColumnGap = 1.4;
constexpr double kRowHeight = 1.45;
constexpr double kLineHeight = 1.2;  // Of a further line of an entry.

/// In points, what a sample needs to show two periods of each dash of the panel, with a dash at
/// either end: a marker in the middle then hides none of the two gaps.
double longest_dashes(const Panel& panel, const Theme& theme) {
  constexpr double kPeriods = 2.0;
  double longest = 0.0;
  for (const Layer& layer : panel.layers) {
    const auto* line = std::get_if<Polyline>(&layer);
    if (line == nullptr || line->label.empty()) continue;
    const std::vector<double> dashes = dash_lengths(line->dash, line->width * theme.line_pt);
    if (dashes.empty()) continue;
    const double period = std::accumulate(dashes.begin(), dashes.end(), 0.0);
    longest = std::max(longest, kPeriods * period + dashes.front());
  }
  return longest;
}

/// Draws what stands for a layer into the sample's box.
class SamplePainter {
 public:
  /// @param as_bars  Whether bands are drawn as bars.
  SamplePainter(const Theme& theme, const Box& position, bool as_bars, std::size_t panel,
                Drawing& drawing)
      : theme_(theme), place_(position), as_bars_(as_bars), panel_(panel), drawing_(drawing) {}

  void operator()(const Polyline& line) {
    if (!line.values.empty()) {
      const double half = line.width * theme_.line_pt / 2.0, y = place_.centre().y;
      draw_ramp({place_.x0, y - half, place_.x1, y + half}, line.colour_scale.ramp, line.colour);
      return;
    }
    draw_line(line.colour, line.dash, line.width);
    if (line.marker != Marker::kNone) draw_marker(line.marker, true, 1.0, line.colour);
  }
  void operator()(const Band& band) {
    if (as_bars_) return draw_bar(band);
    Shape shape = filled_shape(Fill::kTint, band.colour, theme_);
    shape.path.add_box(inset());
    add(std::move(shape));
  }
  void operator()(const Scatter& points) {
    draw_marker(points.marker, points.filled, points.size, points.colour);
  }
  void operator()(const Segments& lines) {
    draw_line(lines.colour, lines.dash, lines.width);
    if (!lines.arrow) return;
    const double y = place_.centre().y;
    add(arrow_head({place_.x0, y}, {place_.x1, y}, theme_.of(lines.colour), theme_));
  }
  void operator()(const PointLabels&) {}
  void operator()(const Texts&) {}
  void operator()(const ImageLayer&) {}
  void operator()(const Area& area) {
    Shape shape = filled_shape(area.fill, area.colour, theme_);
    if (area.outlined) shape.stroke = stroke_of(area.colour, area.dash, area.width, theme_);
    shape.path.add_box(inset());
    add(std::move(shape));
  }
  void operator()(const Ellipses& ellipses) {
    Shape shape = filled_shape(ellipses.fill, ellipses.colour, theme_);
    shape.stroke = stroke_of(ellipses.colour, ellipses.dash, ellipses.width, theme_);
    shape.path.add_circle(place_.centre(), 0.4 * place_.height());
    add(std::move(shape));
  }
  void operator()(const Cells& cells) {
    draw_ramp(inset(), cells.colour_scale.ramp, cells.colour);
    Shape rim;
    rim.path.add_box(inset());
    rim.stroke = Stroke{theme_.muted, theme_.hairline_pt, {}};
    add(std::move(rim));
  }

 private:
  Box inset() const {
    const double by = 0.15 * place_.height();
    return {place_.x0, place_.y0 + by, place_.x1, place_.y1 - by};
  }

  /// From its least to its greatest value.
  void draw_ramp(const Box& box, Ramp ramp, ThemeColour colour) {
    constexpr int kSteps = 12;
    for (int i = 0; i < kSteps; ++i) {
      const double from = std::lerp(box.x0, box.x1, static_cast<double>(i) / kSteps);
      Shape shape;
      shape.path.add_box({from, box.y0, box.x1, box.y1});
      shape.fill = ramp_colour(ramp, colour, static_cast<double>(i) / (kSteps - 1), theme_);
      add(std::move(shape));
    }
  }

  void draw_line(ThemeColour colour, Dash dash, double width) {
    Shape shape;
    const double y = place_.centre().y;
    shape.path.move_to({place_.x0, y});
    shape.path.line_to({place_.x1, y});
    shape.stroke = stroke_of(colour, dash, width, theme_);
    add(std::move(shape));
  }

  /// Across the line, as high as the sample.
  void draw_bar(const Band& band) {
    Shape shape;
    shape.path.move_to({place_.centre().x, place_.y0});
    shape.path.line_to({place_.centre().x, place_.y1});
    shape.stroke = stroke_of(band.colour, Dash::kSolid, 1.0, theme_);
    add(std::move(shape));
  }

  void draw_marker(Marker marker, bool filled, double size, ThemeColour colour) {
    const Shape symbol =
        marker_symbol(marker, filled, size * theme_.marker_pt, theme_.of(colour), theme_);
    add(Stamp{symbol_index(drawing_, symbol), place_.centre()});
  }

  template <typename What>
  void add(What&& what) {
    drawing_.add(ItemClass::kLegendSample, panel_, std::forward<What>(what));
  }

  const Theme& theme_;
  const Box& place_;
  bool as_bars_;
  std::size_t panel_;
  Drawing& drawing_;
};

}  // namespace

Legend::Legend(const Panel& panel, const Theme& theme, double most_width_pt, bool as_bars)
    : theme_(theme), as_bars_(as_bars) {
  const double em = theme.font_pt;
  sample_width_ = std::max(kLeastSample * em, longest_dashes(panel, theme));
  const double lead = sample_width_ / em + kSampleGap;
  const double most_text = std::max(most_width_pt / em - lead, 2.0);
  for (const Layer& layer : panel.layers) {
    const std::string& label = label_of(layer);
    if (label.empty()) continue;
    const auto same = std::ranges::find(entries_, label, &LegendEntry::whole);
    if (same != entries_.end()) {
      const auto index = [](const Layer* one) { return one->index(); };
      const auto kind = std::ranges::find(same->layers, layer.index(), index);
      if (kind == same->layers.end())
        same->layers.push_back(&layer);
      else if (const auto* points = std::get_if<Scatter>(&layer))
        same->in_colours |= std::get<Scatter>(**kind).colour != points->colour;
      continue;
    }
    entries_.push_back({name_lines(theme, label, most_text), label, {&layer}});
    entry_width_ = std::max(entry_width_, width_of(entries_.back()));
  }
  // What stands for points comes before what stands for lines between them.
  std::ranges::stable_partition(entries_, [](const LegendEntry& entry) {
    return !std::holds_alternative<Segments>(*entry.layers.front());
  });
  row_height_ = kRowHeight * em;
}

void Legend::order_by_ends(const std::vector<LineEnd>& ends) {
  std::vector<std::size_t> indices;
  std::vector<LegendEntry> lines;
  const auto rank = [&](const LegendEntry& entry) {
    return std::ranges::find(ends, entry.whole, &LineEnd::label) - ends.begin();
  };
  for (std::size_t i = 0; i < entries_.size(); ++i)
    if (rank(entries_[i]) < std::ssize(ends)) {
      indices.push_back(i);
      lines.push_back(entries_[i]);
    }
  std::ranges::stable_sort(lines, {}, rank);
  for (std::size_t i = 0; i < lines.size(); ++i) entries_[indices[i]] = std::move(lines[i]);
}

double Legend::width_of(const LegendEntry& entry) const {
  double widest = 0.0;
  for (const ShapedText& line : entry.lines) widest = std::max(widest, line.advance);
  return sample_width_ + (kSampleGap + widest) * theme_.font_pt;
}

double Legend::height_of(const LegendEntry& entry) const {
  return row_height_ + static_cast<double>(entry.lines.size() - 1) * kLineHeight * theme_.font_pt;
}

LegendArrangement Legend::in_columns(std::size_t columns) const {
  const std::size_t rows = (entries_.size() + columns - 1) / columns;
  const double gap = kColumnGap * theme_.font_pt;
  std::vector<double> heights(rows, row_height_);
  for (std::size_t i = 0; i < entries_.size(); ++i)
    heights[i % rows] = std::max(heights[i % rows], height_of(entries_[i]));
  LegendArrangement found;
  const auto count = static_cast<double>(columns);
  found.size.x = count * entry_width_ + (count - 1.0) * gap;
  std::vector<double> tops;
  for (const double height : heights) {
    tops.push_back(found.size.y);
    found.size.y += height;
  }
  for (std::size_t i = 0; i < entries_.size(); ++i)
    found.at.push_back({static_cast<double>(i / rows) * (entry_width_ + gap), tops[i % rows]});
  return found;
}

LegendArrangement Legend::in_rows(double width) const {
  LegendArrangement found;
  double x = 0.0, height = 0.0;
  for (const LegendEntry& entry : entries_) {
    if (x > 0.0 && x + width_of(entry) > width) {
      found.size.y += height;
      x = height = 0.0;
    }
    found.at.push_back({x, found.size.y});
    found.size.x = std::max(found.size.x, x + width_of(entry));
    height = std::max(height, height_of(entry));
    x += width_of(entry) + kColumnGap * theme_.font_pt;
  }
  found.size.y += height;
  return found;
}

LegendArrangement Legend::within(double width) const {
  std::size_t columns = std::max<std::size_t>(entries_.size(), 1);
  while (columns > 1 && in_columns(columns).size.x > width) --columns;
  // As few columns as the same number of rows allows.
  const std::size_t rows = (entries_.size() + columns - 1) / columns;
  while (columns > 1 && (entries_.size() + columns - 2) / (columns - 1) == rows) --columns;
  LegendArrangement found = in_columns(columns);
  if (theme_.draws_title) return found;
  LegendArrangement rowwise = in_rows(width);
  return rowwise.size.y < found.size.y ? std::move(rowwise) : std::move(found);
}

std::optional<Box> Legend::free_place(const Box& frame, const Obstacles& data) const {
  const Point extent = in_one_column().size;
  const double gap = theme_.space_pt;
  const Box room = frame.grown(-gap);
  if (extent.x > 0.8 * room.width() || extent.y > 0.8 * room.height()) return std::nullopt;
  const double left = room.x0, right = room.x1 - extent.x, middle = (left + right) / 2.0;
  const double top = room.y0, bottom = room.y1 - extent.y, centre = (top + bottom) / 2.0;
  for (const Point at :
       {Point{right, top}, Point{left, top}, Point{right, bottom}, Point{left, bottom},
        Point{right, centre}, Point{left, centre}, Point{middle, top}, Point{middle, bottom}}) {
    const Box position{at.x, at.y, at.x + extent.x, at.y + extent.y};
    if (!data.hit(position.grown(0.7 * gap))) return position;
  }
  return std::nullopt;
}

void Legend::draw_box(const Box& position, std::size_t panel_index, Drawing& drawing) const {
  Shape box;
  box.path.add_box(position.grown(0.5 * theme_.space_pt));
  box.fill = theme_.background;
  box.stroke = Stroke{mix(theme_.text, theme_.background, 0.3), theme_.hairline_pt, {}};
  drawing.add(ItemClass::kLegendBox, panel_index, std::move(box));
}

void Legend::draw(Point at, const LegendArrangement& arrangement, std::size_t panel_index,
                  Drawing& drawing) const {
  const double em = theme_.font_pt;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const LegendEntry& entry = entries_[i];
    const double x = at.x + arrangement.at[i].x, y = at.y + arrangement.at[i].y;
    const double half = (row_height_ - 0.25 * em) / 2.0;
    const double middle = y + row_height_ / 2.0;
    draw_sample(entry, {x, middle - half, x + sample_width_, middle + half}, panel_index, drawing);
    Point baseline{x + sample_width_ + kSampleGap * em,
                   middle + FontFacts::kXHeight / 2.0 * em + 0.06 * em};
    for (const ShapedText& line : entry.lines) {
      const bool is_all = entry.lines.size() > 1 || line.text == entry.whole;
      drawing.add(ItemClass::kLegendText, panel_index,
                  TextLine{.shaped = line,
                           .whole = is_all ? "" : entry.whole,
                           .at = baseline,
                           .size = em,
                           .colour = theme_.text});
      baseline.y += kLineHeight * em;
    }
  }
}

void Legend::draw_sample(const LegendEntry& entry, const Box& position, std::size_t panel_index,
                         Drawing& drawing) const {
  const auto is_line = [](const Layer* layer) { return std::holds_alternative<Polyline>(*layer); };
  const bool has_line = std::ranges::any_of(entry.layers, is_line);
  for (const Layer* layer : entry.layers) {
    // A bar across the line would be taken for a part of its marker.
    if (as_bars_ && has_line && std::holds_alternative<Band>(*layer)) continue;
    SamplePainter painter(theme_, position, as_bars_, panel_index, drawing);
    const auto* points = std::get_if<Scatter>(layer);
    if (points != nullptr && entry.in_colours) {
      Scatter of_none = *points;
      of_none.colour = ThemeColour::kMuted;
      painter(of_none);
    } else {
      std::visit(painter, *layer);
    }
  }
}

}  // namespace mapproof
