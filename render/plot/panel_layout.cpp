#include "render/plot/panel_layout.hpp"

#include <algorithm>

#include "render/plot/axes_layout.hpp"
#include "render/plot/layers.hpp"
#include "render/plot/legend.hpp"
#include "render/plot/mark_labels.hpp"

namespace mapproof {
namespace {

std::string axis_title(const Axis& axis, const Ticks& ticks) {
  return ticks.factor.empty() ? axis.label : axis.label + " " + ticks.factor;
}

/// Where everything of a panel goes.
struct Arrangement {
  Axes axes;
  std::optional<Point> legend_at;
  std::size_t legend_columns = 1;
};

/// Tries the legend inside, where it covers no data, then beside and below the frame, whichever
/// leaves more room.
class Arranger {
 public:
  Arranger(const AxesLayout& layout, const Legend& legend, const Panel& panel, const Theme& theme)
      : layout_(layout), legend_(legend), panel_(panel), theme_(theme) {}

  Arrangement arrange(const Box& room) const {
    Arrangement found = choose(room);
    if (panel_.equal_aspect) centre(found, room);
    return found;
  }

 private:
  Arrangement choose(const Box& room) const {
    Arrangement inside{layout_.within(room), std::nullopt, 1};
    if (legend_.empty()) return inside;
    const Arrangement right = beside(room);
    if (area(right) >= 0.97 * area(inside)) return right;
    const Obstacles data = data_obstacles(panel_, layout_.map(inside.axes.frame), theme_);
    if (const auto place = legend_.free_place(inside.axes.frame, data)) {
      inside.legend_at = Point{place->x0, place->y0};
      return inside;
    }
    const Arrangement under = below(room);
    return area(right) >= area(under) ? right : under;
  }

  /// Shares out the width that equal scales leave free on both sides.
  void centre(Arrangement& found, const Box& room) const {
    Box& frame = found.axes.frame;
    double end = frame.x1;
    if (found.legend_at)
      end = std::max(end, found.legend_at->x + legend_.size(found.legend_columns).x);
    const double shift = std::max(0.0, (room.x1 - end) / 2.0);
    frame.x0 += shift;
    frame.x1 += shift;
    if (found.legend_at) found.legend_at->x += shift;
  }

  static double area(const Arrangement& arrangement) {
    const Box& frame = arrangement.axes.frame;
    return std::max(frame.width(), 0.0) * std::max(frame.height(), 0.0);
  }

  Arrangement beside(const Box& room) const {
    const double gap = 2.0 * theme_.space_pt;
    const Point size = legend_.size(1);
    Box rest = room;
    rest.x1 -= size.x + gap;
    Arrangement found{layout_.within(rest), std::nullopt, 1};
    const Box& frame = found.axes.frame;
    found.legend_at = Point{frame.x1 + gap, frame.y0};
    if (size.y > frame.height()) found.axes.frame = {};  // Too long: no choice.
    return found;
  }

  Arrangement below(const Box& room) const {
    const std::size_t columns = legend_.columns_within(0.9 * room.width());
    const Point size = legend_.size(columns);
    Box rest = room;
    rest.y1 -= size.y + theme_.space_pt;
    Arrangement found{layout_.within(rest), std::nullopt, columns};
    const Box& frame = found.axes.frame;
    const double left = std::min(frame.x0, room.x1 - size.x);
    found.legend_at =
        Point{std::max(left, room.x0), frame.y1 + layout_.below_frame() + theme_.space_pt};
    return found;
  }

  const AxesLayout& layout_;
  const Legend& legend_;
  const Panel& panel_;
  const Theme& theme_;
};

/// Draws grid, frame, ticks and their labels.
class AxesPainter {
 public:
  AxesPainter(const Panel& panel, std::size_t index, const Axes& axes, const AxesLayout& layout,
              const Theme& theme, Drawing& drawing)
      : panel_(panel),
        index_(index),
        axes_(axes),
        layout_(layout),
        theme_(theme),
        drawing_(drawing),
        map_(layout.map(axes.frame)) {}

  void draw_grid() {
    const Box& f = axes_.frame;
    Path grid;
    for (const double value : axes_.x.ticks.at)
      add_line(grid, {map_.x(value), f.y0}, {map_.x(value), f.y1});
    for (const double value : axes_.y.ticks.at)
      add_line(grid, {f.x0, map_.y(value)}, {f.x1, map_.y(value)});
    stroke(Role::kGrid, std::move(grid), theme_.grid);
  }

  void draw_frame() {
    const Box& f = axes_.frame;
    Path frame;
    frame.add_box(f);
    stroke(Role::kFrame, std::move(frame), theme_.text);
    Path ticks;
    const double length = layout_.tick_length();
    for (const double value : axes_.x.ticks.at)
      add_line(ticks, {map_.x(value), f.y1}, {map_.x(value), f.y1 + length});
    for (const double value : axes_.x.ticks.minor)
      add_line(ticks, {map_.x(value), f.y1}, {map_.x(value), f.y1 + 0.5 * length});
    for (const double value : axes_.y.ticks.at)
      add_line(ticks, {f.x0 - length, map_.y(value)}, {f.x0, map_.y(value)});
    for (const double value : axes_.y.ticks.minor)
      add_line(ticks, {f.x0 - 0.5 * length, map_.y(value)}, {f.x0, map_.y(value)});
    stroke(Role::kTick, std::move(ticks), theme_.text);
  }

  void draw_labels() {
    draw_tick_labels();
    draw_axis_labels();
  }

 private:
  void draw_tick_labels() {
    const Box& f = axes_.frame;
    const double em = theme_.tick_font_pt;
    const double away = layout_.tick_length() + layout_.tick_gap();
    for (std::size_t i = 0; i < axes_.x.texts.size(); ++i) {
      const ShapedText& text = axes_.x.texts[i];
      const Point at{map_.x(axes_.x.ticks.at[i]) - text.advance * em / 2.0,
                     f.y1 + away + FontFacts::kCapHeight * em};
      add_text(drawing_, Role::kTickLabel, index_, text, text.text, at, em, theme_.text);
    }
    for (std::size_t i = 0; i < axes_.y.texts.size(); ++i) {
      const ShapedText& text = axes_.y.texts[i];
      const Point at{f.x0 - away - text.advance * em,
                     map_.y(axes_.y.ticks.at[i]) + FontFacts::kCapHeight * em / 2.0};
      add_text(drawing_, Role::kTickLabel, index_, text, text.text, at, em, theme_.text);
    }
  }

  void draw_axis_labels() {
    const Box& f = axes_.frame;
    const double em = theme_.font_pt;
    const double away = layout_.tick_length() + layout_.tick_gap();
    if (!panel_.x.label.empty()) {
      const std::string whole = axis_title(panel_.x, axes_.x.ticks);
      const ShapedText text = shape_text_within(whole, f.width() / em);
      add_text(drawing_, Role::kAxisLabel, index_, text, whole,
               {f.centre().x - text.advance * em / 2.0,
                f.y1 + layout_.below_frame() - FontFacts::kDescent * em},
               em, theme_.text);
    }
    if (!panel_.y.label.empty()) {
      const std::string whole = axis_title(panel_.y, axes_.y.ticks);
      const ShapedText text = shape_text_within(whole, f.height() / em);
      add_text(drawing_, Role::kAxisLabel, index_, text, whole,
               {f.x0 - away - axes_.y.widest * theme_.tick_font_pt - 0.6 * em,
                f.centre().y + text.advance * em / 2.0},
               em, theme_.text, true);
    }
  }

  static void add_line(Path& path, Point a, Point b) {
    path.move_to(a);
    path.line_to(b);
  }

  void stroke(Role role, Path path, Colour colour) {
    if (path.points.empty()) return;
    Shape shape;
    shape.path = std::move(path);
    shape.stroke = Stroke{colour, theme_.hairline_pt, {}};
    drawing_.add(role, index_, std::move(shape));
  }

  const Panel& panel_;
  std::size_t index_;
  const Axes& axes_;
  const AxesLayout& layout_;
  const Theme& theme_;
  Drawing& drawing_;
  PanelMap map_;
};

/// The room left below the panel's title.
Box draw_panel_title(const Panel& panel, std::size_t index, const Box& cell, const Theme& theme,
                     Drawing& drawing) {
  if (panel.title.empty()) return cell;
  const double em = theme.font_pt;
  const ShapedText text = shape_text_within(panel.title, cell.width() / em);
  add_text(drawing, Role::kPanelTitle, index, text, panel.title,
           {cell.x0, cell.y0 + FontFacts::kAscent * em}, em, theme.text);
  return {cell.x0, cell.y0 + FontFacts::kLine * em, cell.x1, cell.y1};
}

}  // namespace

void add_text(Drawing& drawing, Role role, std::size_t panel_index, const ShapedText& shaped,
              const std::string& whole, Point at, double size, Colour colour, bool upward) {
  TextLine line{shaped, shaped.text == whole ? "" : whole, at, size, upward, colour};
  drawing.add(role, panel_index, std::move(line));
}

void lay_out_panel(const Panel& panel, std::size_t panel_index, const Box& cell, const Theme& theme,
                   Drawing& drawing) {
  const Box room = draw_panel_title(panel, panel_index, cell, theme, drawing);
  const AxesLayout layout(panel, theme);
  const Legend legend(panel, theme, 0.62 * cell.width());
  const Arrangement arrangement = Arranger(layout, legend, panel, theme).arrange(room);
  const Box& frame = arrangement.axes.frame;
  drawing.frames.push_back(frame);

  AxesPainter painter(panel, panel_index, arrangement.axes, layout, theme, drawing);
  painter.draw_grid();
  const PanelMap map = layout.map(frame);
  draw_layers(panel, panel_index, map, theme, drawing);
  painter.draw_frame();
  painter.draw_labels();

  Obstacles taken = data_obstacles(panel, map, theme);
  if (arrangement.legend_at) {
    const Point at = *arrangement.legend_at;
    const Point extent = legend.size(arrangement.legend_columns);
    const Box place{at.x, at.y, at.x + extent.x, at.y + extent.y};
    if (frame.overlaps(place)) legend.draw_box(place, panel_index, drawing);
    legend.draw(at, arrangement.legend_columns, panel_index, drawing);
    taken.boxes.push_back(place);
  }
  draw_mark_labels(panel, panel_index, map, frame, std::move(taken), theme, drawing);
}

}  // namespace mapproof
