#include "render/plot/panel_grid.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "core/base/not_finite.hpp"
#include "render/plot/layers.hpp"
#include "render/plot/legend.hpp"
#include "render/plot/line_ends.hpp"
#include "render/plot/mark_labels.hpp"
#include "render/plot/markers.hpp"
#include "render/plot/panel_layout.hpp"

namespace mapproof {
namespace {

constexpr double kLeastWidthOfNames = 40.0;  // Of a page with columns, in em;
constexpr double kLeastWidth = 14.0;         // of a cell;
constexpr double kLeastWidthOfAxes = 15.0;   // with curves, whose panels else become too narrow;
constexpr double kLeastWidthShared = 8.5;    // where labels stand outside the grid.
constexpr double kArrowWidth = 5.0;          // Of an arrow and its word between cells, em.

/// How many panels stand in a row of that width: at most as many as the figure asks for.
std::size_t columns_within(const Figure& figure, double width, const Theme& theme) {
  const std::size_t count = figure.panels.size();
  const std::size_t most = figure.columns == 0 ? count : std::min(figure.columns, count);
  // Beside two columns of names a column of a journal has no room for data.
  const bool has_names =
      std::ranges::any_of(figure.panels, [](const Panel& panel) { return !panel.y.names.empty(); });
  if (has_names && width < kLeastWidthOfNames * theme.font_pt) return 1;
  const bool narrow = !std::ranges::any_of(figure.panels, has_image) &&
                      (figure.shared_y || std::ranges::all_of(figure.panels, &Panel::bare));
  const bool has_curves = std::ranges::none_of(
      figure.panels, [](const Panel& panel) { return panel.equal_aspect || panel.bare; });
  const double least = (narrow       ? kLeastWidthShared
                        : has_curves ? kLeastWidthOfAxes
                                     : kLeastWidth) *
                           theme.font_pt +
                       (figure.arrows.empty() ? 0.0 : kArrowWidth * theme.font_pt);
  const auto fit = static_cast<std::size_t>(std::max(1.0, std::floor(width / least)));
  if (fit >= most) return most;
  // As few columns as the same number of rows allows.
  const std::size_t rows = (count + fit - 1) / fit;
  return (count + rows - 1) / rows;
}

constexpr double kHeightOfWidth = 0.85;  // Of frames whose units need not be equally long.
constexpr double kLeastHeight = 8.5;     // Of those, in em.
constexpr double kMostOfPage = 0.62;     // Of the theme's height, for the frames of one row.

Range united(const Range& a, const Range& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

/// Copies of the panels with the limits that they share.
std::vector<Panel> with_shared_limits(const Figure& figure) {
  std::vector<Panel> panels = figure.panels;
  PanelLimits all = panel_limits(panels.front());
  for (const Panel& panel : panels) {
    const PanelLimits limits = panel_limits(panel);
    all = {united(all.x, limits.x), united(all.y, limits.y)};
  }
  for (Panel& panel : panels) {
    if (figure.shared_x) panel.x.limits = all.x;
    if (figure.shared_y) panel.y.limits = all.y;
  }
  return panels;
}

bool have_one_x_axis(const std::vector<Panel>& panels) {
  const Range limits = panel_limits(panels.front()).x;
  return std::ranges::all_of(panels, [&](const Panel& panel) {
    const Range own = panel_limits(panel).x;
    return panel.x.label == panels.front().x.label && own.low == limits.low &&
           own.high == limits.high;
  });
}

class SharedGrid {
 public:
  SharedGrid(const Figure& figure, const Box& room, const Theme& theme, double stretch,
             Drawing& drawing)
      : figure_(figure),
        room_(room),
        theme_(theme),
        stretch_(stretch),
        drawing_(drawing),
        panels_(with_shared_limits(figure)),
        columns_(columns_within(figure, room.width(), theme)),
        has_one_x_label_(figure.shared_x || (columns_ > 1 && have_one_x_axis(panels_))) {
    for (std::size_t p = 0; p < panels_.size(); ++p) {
      const bool lowest = p + columns_ >= panels_.size();
      const bool leftmost = p % columns_ == 0;
      AxisLabels shown;
      shown.x_ticks = !figure.shared_x || lowest;
      shown.y_ticks = !figure.shared_y || leftmost;
      shown.x_label = !has_one_x_label_;
      shown.y_label = !figure.shared_y;
      layouts_.emplace_back(panels_[p], theme, shown);
      for (const Layer& layer : panels_[p].layers) all_.layers.push_back(layer);
    }
  }

  void lay_out() {
    find_frame_size();
    const double em = theme_.font_pt;
    double top = room_.y0;
    for (std::size_t p = 0; p < panels_.size(); p += columns_) {
      const std::size_t end = std::min(p + columns_, panels_.size());
      top += title_height(p, end);
      double bottom = 0.0;
      for (std::size_t i = p; i < end; ++i) bottom = std::max(bottom, draw(i, top));
      top += height_ + bottom + 1.5 * theme_.space_pt;
    }
    top -= 1.5 * theme_.space_pt;
    const double left = room_.x0 + outer_left_, right = left + grid_width();
    if (has_one_x_label_ && !panels_.front().x.label.empty()) {
      const std::string label = axis_title(panels_.front().x, first_axes().x.ticks);
      const ShapedText text =
          shape_text_within(label, room_.width() / em, Elide::kEnd, theme_.font.get());
      const double start = std::max(room_.x0, (left + right - text.advance * em) / 2.0);
      top += 0.5 * em;
      drawing_.add_text(ItemClass::kAxisLabel, 0,
                        {.shaped = text,
                         .whole = label,
                         .at = {start, top + FontFacts::kAscent * em},
                         .size = em,
                         .colour = theme_.text});
      top += (FontFacts::kAscent + FontFacts::kDescent) * em;
    }
    if (figure_.shared_y && !panels_.front().y.label.empty()) draw_y_label();
    drawing_.height = draw_legend(left, top) + theme_.space_pt;
  }

 private:
  /// Margins depend on ticks, and ticks on frames: three passes settle both, and the fourth takes
  /// from the frames what is still missing.
  void find_frame_size() {
    width_ = 0.8 * room_.width() / static_cast<double>(columns_);
    for (int pass = 0; pass < 4; ++pass) {
      height_ = frame_height();
      if (panels_.front().equal_aspect) width_ = height_ * aspect();
      measure_margins();
      const double gaps = static_cast<double>(columns_ - 1) * inner_left_;
      const double widest =
          (room_.width() - outer_left_ - right_ - gaps) / static_cast<double>(columns_);
      if (pass < 3 || width_ > widest) width_ = widest;
    }
    height_ = panels_.front().equal_aspect ? width_ / aspect() : frame_height();
    spread();
  }

  /// Frames that are narrower than their columns stand as far apart as their titles need.
  void spread() {
    const auto columns = static_cast<double>(columns_);
    const double free = room_.width() - outer_left_ - right_ - grid_width();
    constexpr double kRounding = 0.5;  // In points.
    if (free > 0.0 && columns_ > 1)
      inner_left_ +=
          std::min(free / columns, std::max(0.0, widest_title() + kRounding - title_width()));
  }

  /// What the longest line of a title needs.
  double widest_title() const {
    double widest = 0.0;
    for (const Panel& panel : panels_)
      for (const TitleLine& line : title_lines(panel.title, kInfinity, theme_.font.get()))
        widest = std::max(widest, line.shaped.advance * theme_.font_pt);
    return widest;
  }

  /// What it may take: as far as the next column.
  double title_width() const {
    return columns_ == 1 ? room_.width() - outer_left_
                         : std::max(width_, width_ + inner_left_ - 2.0 * theme_.space_pt);
  }

  /// What labels need left of the frames, and right of the last one.
  void measure_margins() {
    double first = 0.0, inner = 0.0;
    right_ = 0.0;
    for (std::size_t p = 0; p < panels_.size(); ++p) {
      const Margins m = layouts_[p].margins(layouts_[p].in({0.0, 0.0, width_, height_}));
      double& left = p % columns_ == 0 ? first : inner;
      left = std::max(left, m.left);
      right_ = std::max(right_, m.right);
    }
    outer_left_ = y_label_width() + first;
    inner_left_ = inner + right_ + theme_.space_pt;
  }

  /// Of the first frame; shared axes have the same ticks in all frames.
  Axes first_axes() const { return layouts_.front().in({0.0, 0.0, width_, height_}); }

  std::string y_title() const { return axis_title(panels_.front().y, first_axes().y.ticks); }

  double y_label_width() const {
    if (!figure_.shared_y || panels_.front().y.label.empty()) return 0.0;
    const std::size_t whole_rows = (panels_.size() + columns_ - 1) / columns_;
    const auto rows = static_cast<double>(whole_rows);
    const double em = theme_.font_pt;
    return 1.5 * em + further_lines(upward_lines(y_title(), rows * height_, theme_), em);
  }

  double aspect() const {
    const PanelLimits limits = panel_limits(panels_.front());
    return (limits.x.high - limits.x.low) / (limits.y.high - limits.y.low);
  }

  double frame_height() const {
    const double most = kMostOfPage * theme_.height_pt;
    if (panels_.front().equal_aspect) return stretch_ * std::min(width_ / aspect(), 1.2 * most);
    const double usual =
        stretch_ * std::min(std::max(kHeightOfWidth * width_, kLeastHeight * theme_.font_pt), most);
    double names = 0.0;
    for (const AxesLayout& layout : layouts_)
      names = std::max(names, layout.height_of_names(width_));
    return std::max(usual, names);
  }

  double grid_width() const {
    const auto columns = static_cast<double>(columns_);
    return columns * width_ + (columns - 1.0) * inner_left_;
  }

  double title_height(std::size_t begin, std::size_t end) const {
    double lines = 0.0;
    for (std::size_t p = begin; p < end; ++p)
      if (!panels_[p].title.empty())
        lines = std::max(
            lines, static_cast<double>(title_lines(panels_[p].title, title_width() / theme_.font_pt,
                                                   theme_.font.get())
                                           .size()));
    return lines * FontFacts::kLine * theme_.font_pt + 0.4 * theme_.tick_font_pt;
  }

  /// @param top  Of the frame. @return What its labels need below the frame.
  double draw(std::size_t p, double top) {
    const double left =
        room_.x0 + outer_left_ + static_cast<double>(p % columns_) * (width_ + inner_left_);
    const Box frame{left, top, left + width_, top + height_};
    const Axes axes = layouts_[p].in(frame);
    const std::size_t first = p - p % columns_;
    const double title_top = top - title_height(first, std::min(first + columns_, panels_.size()));
    draw_panel_title(panels_[p], p,
                     {left, title_top, std::min(left + title_width(), room_.x1), top}, theme_,
                     drawing_);
    draw_panel(layouts_[p], p, axes, drawing_);
    const PanelMap map = layouts_[p].map(frame);
    draw_mark_labels(layouts_[p], p, frame, data_obstacles(panels_[p], map, theme_), drawing_);
    return layouts_[p].margins(axes).bottom;
  }

  void draw_y_label() {
    const double em = theme_.font_pt;
    const double top = drawing_.frames.front().y0, bottom = drawing_.frames.back().y1;
    const std::string label = y_title();
    double x = room_.x0 + FontFacts::kAscent * em;
    for (const ShapedText& line : upward_lines(label, bottom - top, theme_)) {
      drawing_.add_text(ItemClass::kAxisLabel, 0,
                        {.shaped = line,
                         .whole = label,
                         .at = {x, (top + bottom + line.advance * em) / 2.0},
                         .size = em,
                         .upward = true,
                         .colour = theme_.text});
      x += FontFacts::kLine * em;
    }
  }

  /// In the grid's last row if that has room for it, else below. @return Where it ends.
  double draw_legend(double left, double top) {
    Legend legend(all_, theme_, room_.width(), std::ranges::any_of(panels_, bands_hide_each_other));
    for (const Panel& panel : panels_)
      legend.order_by_ends(ends_of_lines(panel, panel_limits(panel)));
    if (legend.empty()) return top;
    const double space = 2.0 * theme_.space_pt;
    const Box& last = drawing_.frames.back();
    const LegendArrangement single = legend.in_one_column();
    const double free_x = last.x1 + space;
    if (free_x + single.size.x <= room_.x1 && single.size.y <= last.height()) {
      legend.draw({free_x, last.y0}, single, 0, drawing_);
      return top;
    }
    const LegendArrangement arrangement = legend.within(room_.width());
    const double x = std::clamp(left, room_.x0, std::max(room_.x0, room_.x1 - arrangement.size.x));
    legend.draw({x, top + 0.5 * space}, arrangement, 0, drawing_);
    return top + 0.5 * space + arrangement.size.y;
  }

  const Figure& figure_;
  const Box& room_;
  const Theme& theme_;
  double stretch_;
  Drawing& drawing_;
  std::vector<Panel> panels_;
  std::size_t columns_;
  bool has_one_x_label_;
  std::vector<AxesLayout> layouts_;
  Panel all_;                          ///< All layers, for the legend.
  double width_ = 0.0, height_ = 0.0;  ///< Of each frame.
  double outer_left_ = 0.0;            ///< From the room's edge to the first frame.
  double inner_left_ = 0.0;            ///< From a frame to the next one.
  double right_ = 0.0;                 ///< What labels need right of the last frame.
};

constexpr double kInGrid = 1.1;       // Height of panels at most, of the theme's;
constexpr double kLowInColumn = 0.7;  // below each other;
constexpr double kLowBelowMap = 0.5;  // below a map, so that a printed page holds both.
constexpr int kMostHeights = 3;
constexpr double kTooLow = 6.0, kLowestFrame = 7.0;  // Height of a frame beside others, em: below
                                                     // the first it gets the second.
constexpr double kArrowGap = 2.4;                    // Between panels below each other, em.

/// Cells with axes of their own, and the arrows between them.
class CellGrid {
 public:
  CellGrid(const Figure& figure, const Box& room, const Theme& theme, double stretch,
           Drawing& drawing)
      : figure_(figure), room_(room), theme_(theme), stretch_(stretch), drawing_(drawing) {}

  void lay_out() {
    const std::size_t count = figure_.panels.size();
    columns_ = columns_within(figure_, room_.width(), theme_);
    if (!figure_.arrows.empty() && columns_ < count) columns_ = 1;
    const auto columns = static_cast<double>(columns_);
    const double gap = columns_ == 1 ? 0.0 : gap_across();
    const double width = (room_.width() - (columns - 1.0) * gap) / columns;
    double top = room_.y0, of_row = 0.0;
    std::set<std::string> known;
    for (std::size_t p = 0; p < count; ++p) {
      const double left = room_.x0 + static_cast<double>(p % columns_) * (width + gap);
      if (p % columns_ == 0) of_row = row_height(p, width);
      const Panel& panel = figure_.panels[p];
      const double height = has_fixed_shape(panel) ? cell_height(panel, width, stretch_) : of_row;
      lay_out_panel(panel, p, {left, top, left + width, top + height}, theme_, drawing_, known);
      known.merge(labels_of(panel));
      if ((p + 1) % columns_ == 0 || p + 1 == count)
        top = lowest_drawn(drawing_, p - p % columns_) + gap_down();
    }
    for (const PanelArrow& arrow : figure_.arrows) draw(arrow);
    drawing_.height = top - gap_down() + theme_.space_pt;
  }

 private:
  double gap_across() const {
    double widest = 0.0;
    for (const PanelArrow& arrow : figure_.arrows)
      widest = std::max(widest,
                        shape_text(arrow.label, theme_.font.get()).advance * theme_.tick_font_pt);
    return std::max(2.0 * theme_.space_pt, widest + 2.0 * theme_.space_pt);
  }

  double gap_down() const {
    return figure_.arrows.empty() ? 2.0 * theme_.space_pt : kArrowGap * theme_.font_pt;
  }

  /// @param stretch  Of what the panel takes of the page at most.
  double cell_height(const Panel& panel, double width, double stretch = 1.0) const {
    return std::min(width * 0.86 + 4.0 * theme_.font_pt,
                    stretch * most_of_page(panel) * theme_.height_pt);
  }

  /// The height of a panel at most, of the theme's.
  double most_of_page(const Panel& panel) const {
    // A map above other panels is what the figure is about.
    if (figure_.columns == 1 && figure_.panels.front().equal_aspect)
      return panel.equal_aspect ? kInGrid : kLowBelowMap;
    return columns_ == 1 ? kLowInColumn : kInGrid;
  }

  static bool has_fixed_shape(const Panel& panel) { return panel.equal_aspect || panel.bare; }

  /// The height of the cells of a row at which no frame is too low for its labels, but for panels
  /// of a fixed shape.
  double row_height(std::size_t first, double width) const {
    double height = 0.0;
    const std::size_t end = std::min(first + columns_, figure_.panels.size());
    for (std::size_t p = first; p < end; ++p) {
      const Panel& panel = figure_.panels[p];
      if (has_fixed_shape(panel)) continue;
      height = std::max(height, stretch_ * cell_height(panel, width));
      for (int i = 0; i < kMostHeights; ++i) {
        const Box cell{room_.x0, room_.y0, room_.x0 + width, room_.y0 + height};
        Drawing attempt;
        lay_out_panel(panel, 0, cell, theme_, attempt);  // The only panel of the attempt.
        const Box& frame = attempt.frames.back();
        const double names = AxesLayout(panel, theme_).height_of_names(frame.width());
        if (frame.height() >= std::max(kTooLow * theme_.font_pt, names)) break;
        height += std::max(kLowestFrame * theme_.font_pt, names) - frame.height();
      }
    }
    return height;
  }

  void draw(const PanelArrow& arrow) {
    const Box& from = drawing_.frames[arrow.from];
    const Box& to = drawing_.frames[arrow.from + 1];
    const double em = theme_.tick_font_pt, space = theme_.space_pt;
    const ShapedText text = shape_text(arrow.label, theme_.font.get());
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
    drawing_.add(ItemClass::kPanelArrow, arrow.from, std::move(line));
    drawing_.add(ItemClass::kPanelArrow, arrow.from, arrow_head(a, b, theme_.text, theme_));
    drawing_.add_text(
        ItemClass::kPanelArrowLabel, arrow.from,
        {.shaped = text, .whole = arrow.label, .at = at, .size = em, .colour = theme_.text});
  }

  double title_top(std::size_t panel) const {
    double top = drawing_.frames[panel].y0;
    for (const Item& item : drawing_.items)
      if (item.panel == panel && item.item_class == ItemClass::kPanelTitle)
        top =
            std::min(top, std::get<TextLine>(item.what).at.y - FontFacts::kAscent * theme_.font_pt);
    return top;
  }

  const Figure& figure_;
  const Box& room_;
  const Theme& theme_;
  double stretch_;
  Drawing& drawing_;
  std::size_t columns_ = 1;
};

}  // namespace

void lay_out_grid(const Figure& figure, const Box& room, const Theme& theme, double stretch,
                  Drawing& drawing) {
  if (figure.shared_x || figure.shared_y)
    SharedGrid(figure, room, theme, stretch, drawing).lay_out();
  else
    CellGrid(figure, room, theme, stretch, drawing).lay_out();
}

double lowest_drawn(const Drawing& drawing, std::size_t first) {
  double bottom = 0.0;
  for (const Item& item : drawing.items) {
    if (item.panel < first || item.item_class == ItemClass::kTitle ||
        item.item_class == ItemClass::kNote)
      continue;
    if (const auto* line = std::get_if<TextLine>(&item.what))
      bottom = std::max(bottom, text_box(*line).y1);
    if (const auto* shape = std::get_if<Shape>(&item.what); shape != nullptr && !item.clipped)
      bottom = std::max(bottom, bounds(shape->path).y1);
  }
  for (std::size_t p = first; p < drawing.frames.size(); ++p)
    bottom = std::max(bottom, drawing.frames[p].y1);
  return bottom;
}

}  // namespace mapproof
