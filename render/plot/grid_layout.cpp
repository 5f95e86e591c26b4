#include "render/plot/grid_layout.hpp"

#include <algorithm>
#include <cmath>

#include "render/plot/layers.hpp"
#include "render/plot/legend.hpp"
#include "render/plot/mark_labels.hpp"
#include "render/plot/markers.hpp"
#include "render/plot/panel_layout.hpp"
#include "render/plot/shared_axes.hpp"

namespace mapproof {
namespace {

constexpr double kLeastWidth = 14.0;       // Of a cell, in em.
constexpr double kLowInColumn = 0.7;       // Height of panels below each other, of the theme's.
constexpr double kLeastWidthShared = 8.5;  // Where labels stand outside the grid.
constexpr double kArrowWidth = 5.0;        // Of an arrow and its word between cells, em.
constexpr double kArrowGap = 2.4;          // Between panels below each other, em.

/// Cells with axes of their own, and the arrows between them.
class CellGrid {
 public:
  CellGrid(const Figure& figure, const Box& room, const Theme& theme, Drawing& drawing)
      : figure_(figure), room_(room), theme_(theme), drawing_(drawing) {}

  void lay_out() {
    const std::size_t count = figure_.panels.size();
    columns_ = columns_within(figure_, room_.width(), theme_);
    if (!figure_.arrows.empty() && columns_ < count) columns_ = 1;
    const auto columns = static_cast<double>(columns_);
    const double gap = columns_ == 1 ? 0.0 : gap_across();
    const double width = (room_.width() - (columns - 1.0) * gap) / columns;
    double top = room_.y0;
    for (std::size_t p = 0; p < count; ++p) {
      const double left = room_.x0 + static_cast<double>(p % columns_) * (width + gap);
      const double height = cell_height(figure_.panels[p], width);
      lay_out_panel(figure_.panels[p], p, {left, top, left + width, top + height}, theme_,
                    drawing_);
      if ((p + 1) % columns_ == 0 || p + 1 == count)
        top = bottom_of_row(p - p % columns_) + gap_down();
    }
    for (const PanelArrow& arrow : figure_.arrows) draw(arrow);
    drawing_.height = top - gap_down() + theme_.space_pt;
  }

 private:
  double gap_across() const {
    double widest = 0.0;
    for (const PanelArrow& arrow : figure_.arrows)
      widest = std::max(widest, shape_text(arrow.label).advance * theme_.tick_font_pt);
    return std::max(2.0 * theme_.space_pt, widest + 2.0 * theme_.space_pt);
  }

  double gap_down() const {
    return figure_.arrows.empty() ? 2.0 * theme_.space_pt : kArrowGap * theme_.font_pt;
  }

  double cell_height(const Panel& panel, double width) const {
    // A map above other panels is what the figure is about.
    const bool low = columns_ == 1 && !(figure_.columns == 1 && panel.equal_aspect);
    const double most = low ? kLowInColumn : 1.1;
    return std::min(width * 0.86 + 4.0 * theme_.font_pt, most * theme_.height_pt);
  }

  /// The lowest ink of the panels from `first` on.
  double bottom_of_row(std::size_t first) const {
    double bottom = room_.y0;
    for (const Item& item : drawing_.items) {
      if (item.panel < first || item.role == Role::kTitle || item.role == Role::kNote) continue;
      if (const auto* line = std::get_if<TextLine>(&item.what))
        bottom = std::max(bottom, ink_box(*line).y1);
      if (const auto* shape = std::get_if<Shape>(&item.what); shape != nullptr && !item.clipped)
        bottom = std::max(bottom, bounds(shape->path).y1);
    }
    for (std::size_t p = first; p < drawing_.frames.size(); ++p)
      bottom = std::max(bottom, drawing_.frames[p].y1);
    return bottom;
  }

  void draw(const PanelArrow& arrow) {
    const Box& from = drawing_.frames[arrow.from];
    const Box& to = drawing_.frames[arrow.from + 1];
    const double em = theme_.tick_font_pt, space = theme_.space_pt;
    const ShapedText text = shape_text(arrow.label);
    const bool across = columns_ > 1;
    Point a, b, at;
    if (across) {
      const double y = (from.centre().y + to.centre().y) / 2.0;
      a = {from.x1 + 0.5 * space, y};
      b = {to.x0 - 0.5 * space, y};
      at = {(a.x + b.x) / 2.0 - text.advance * em / 2.0, y - 1.2 * space};
    } else {
      const double end = title_top(arrow.from + 1);
      a = {from.centre().x, end - gap_down() + 0.5 * space};
      b = {from.centre().x, end - 0.5 * space};
      at = {a.x + 1.5 * space, (a.y + b.y) / 2.0 + FontFacts::kXHeight / 2.0 * em};
    }
    Shape line;
    line.path.move_to(a);
    line.path.line_to(b);
    line.stroke = Stroke{theme_.text, theme_.line_pt, {}};
    drawing_.add(Role::kPanelArrow, arrow.from, std::move(line));
    drawing_.add(Role::kPanelArrow, arrow.from, arrow_head(a, b, theme_.text, theme_));
    add_text(drawing_, Role::kPanelArrowLabel, arrow.from, text, arrow.label, at, em, theme_.text);
  }

  double title_top(std::size_t panel) const {
    double top = drawing_.frames[panel].y0;
    for (const Item& item : drawing_.items)
      if (item.panel == panel && item.role == Role::kPanelTitle)
        top =
            std::min(top, std::get<TextLine>(item.what).at.y - FontFacts::kAscent * theme_.font_pt);
    return top;
  }

  const Figure& figure_;
  const Box& room_;
  const Theme& theme_;
  Drawing& drawing_;
  std::size_t columns_ = 1;
};

}  // namespace

std::size_t columns_within(const Figure& figure, double width, const Theme& theme) {
  const std::size_t count = figure.panels.size();
  const std::size_t most = figure.columns == 0 ? count : std::min(figure.columns, count);
  const bool narrow = !std::ranges::any_of(figure.panels, has_picture) &&
                      (figure.shared_y || std::ranges::all_of(figure.panels, &Panel::bare));
  const double least = (narrow ? kLeastWidthShared : kLeastWidth) * theme.font_pt +
                       (figure.arrows.empty() ? 0.0 : kArrowWidth * theme.font_pt);
  const auto fit = static_cast<std::size_t>(std::max(1.0, std::floor(width / least)));
  if (fit >= most) return most;
  // As few columns as the same number of rows allows.
  const std::size_t rows = (count + fit - 1) / fit;
  return (count + rows - 1) / rows;
}

void lay_out_grid(const Figure& figure, const Box& room, const Theme& theme, Drawing& drawing) {
  if (figure.shared_x || figure.shared_y)
    lay_out_shared(figure, room, theme, drawing);
  else
    CellGrid(figure, room, theme, drawing).lay_out();
}

}  // namespace mapproof
