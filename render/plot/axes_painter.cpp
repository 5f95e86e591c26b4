#include "render/plot/axes_painter.hpp"

#include "render/plot/panel_layout.hpp"

namespace mapproof {
namespace {

/// Draws grid, frame, ticks and their labels.
class AxesPainter {
 public:
  AxesPainter(const Axes& axes, std::size_t index, const AxesLayout& layout, const Theme& theme,
              Drawing& drawing)
      : axes_(axes),
        index_(index),
        layout_(layout),
        theme_(theme),
        drawing_(drawing),
        map_(layout.map(axes.frame)) {}

  void draw_grid() {
    const Box& f = axes_.frame;
    Outline grid;
    for (const double value : axes_.x.ticks.at)
      add_line(grid, {map_.x(value), f.y0}, {map_.x(value), f.y1});
    for (const double value : axes_.y.ticks.at)
      add_line(grid, {f.x0, map_.y(value)}, {f.x1, map_.y(value)});
    stroke(Role::kGrid, std::move(grid), theme_.grid);
  }

  void draw_frame() {
    const Box& f = axes_.frame;
    Outline frame;
    frame.add_box(f);
    stroke(Role::kFrame, std::move(frame), theme_.text);
    Outline ticks;
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

  void draw_axis_labels(const Panel& panel) {
    const Box& f = axes_.frame;
    const double em = theme_.font_pt;
    const double away = layout_.tick_length() + layout_.tick_gap();
    if (layout_.has_x_label()) {
      const std::string whole = axis_title(panel.x, axes_.x.ticks);
      const ShapedText text = shape_text_within(whole, f.width() / em);
      add_text(drawing_, Role::kAxisLabel, index_, text, whole,
               {f.centre().x - text.advance * em / 2.0,
                f.y1 + layout_.below_frame() - FontFacts::kDescent * em},
               em, theme_.text);
    }
    if (layout_.has_y_label()) {
      const std::string whole = axis_title(panel.y, axes_.y.ticks);
      const std::vector<ShapedText> lines = upward_lines(whole, f.height(), em);
      double x =
          f.x0 - away - axes_.y.widest * theme_.tick_font_pt - 0.6 * em - further_lines(lines, em);
      for (const ShapedText& line : lines) {
        add_text(drawing_, Role::kAxisLabel, index_, line, whole,
                 {x, f.centre().y + line.advance * em / 2.0}, em, theme_.text, true);
        x += FontFacts::kLine * em;
      }
    }
  }

 private:
  static void add_line(Outline& path, Point a, Point b) {
    path.move_to(a);
    path.line_to(b);
  }

  void stroke(Role role, Outline path, Colour colour) {
    if (path.points.empty()) return;
    Shape shape;
    shape.path = std::move(path);
    shape.stroke = Stroke{colour, theme_.hairline_pt, {}};
    drawing_.add(role, index_, std::move(shape));
  }

  const Axes& axes_;
  std::size_t index_;
  const AxesLayout& layout_;
  const Theme& theme_;
  Drawing& drawing_;
  PanelMap map_;
};

}  // namespace

void draw_grid(const Axes& axes, std::size_t panel_index, const AxesLayout& layout,
               const Theme& theme, Drawing& drawing) {
  AxesPainter(axes, panel_index, layout, theme, drawing).draw_grid();
}

void draw_axes(const Panel& panel, const Axes& axes, std::size_t panel_index,
               const AxesLayout& layout, const Theme& theme, Drawing& drawing) {
  AxesPainter painter(axes, panel_index, layout, theme, drawing);
  painter.draw_frame();
  painter.draw_tick_labels();
  painter.draw_axis_labels(panel);
}

}  // namespace mapproof
