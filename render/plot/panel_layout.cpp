#include "render/plot/panel_layout.hpp"

#include <algorithm>

#include "render/plot/axes_layout.hpp"
#include "render/plot/layers.hpp"
#include "render/plot/legend.hpp"
#include "render/plot/line_ends.hpp"
#include "render/plot/mark_labels.hpp"
#include "render/plot/short_names.hpp"

namespace mapproof {
namespace {

/// Draws grid, frame, ticks and their labels.
class AxesPainter {
 public:
  AxesPainter(const Axes& axes, std::size_t index, const AxesLayout& layout, Drawing& drawing)
      : axes_(axes),
        index_(index),
        layout_(layout),
        theme_(layout.theme()),
        drawing_(drawing),
        map_(layout.map(axes.frame)) {}

  void draw_grid() {
    const Box& f = axes_.frame;
    Outline grid;
    for (const double value : axes_.x.ticks.at)
      add_line(grid, {map_.x(value), f.y0}, {map_.x(value), f.y1});
    for (const double value : axes_.y.ticks.at)
      add_line(grid, {f.x0, map_.y(value)}, {f.x1, map_.y(value)});
    stroke(ItemClass::kGrid, std::move(grid), theme_.grid);
  }

  /// Draws frame, ticks and their labels, and the axes' own labels.
  void draw_axes() {
    draw_frame();
    draw_tick_labels();
    draw_axis_labels(layout_.panel());
  }

 private:
  void draw_frame() {
    const Box& f = axes_.frame;
    Outline frame;
    frame.add_box(f);
    stroke(ItemClass::kFrame, std::move(frame), theme_.text);
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
    stroke(ItemClass::kTick, std::move(ticks), theme_.text);
  }

  void draw_tick_labels() {
    const Box& f = axes_.frame;
    const double em = theme_.tick_font_pt;
    const double away = layout_.tick_length() + layout_.tick_gap();
    for (std::size_t i = 0; i < axes_.x.texts.size(); ++i)
      draw_label(axes_.x, i, [&](double width, double down) {
        return Point{map_.x(axes_.x.ticks.at[i]) - width / 2.0,
                     f.y1 + away + FontFacts::kCapHeight * em + down};
      });
    for (std::size_t i = 0; i < axes_.y.texts.size(); ++i) {
      const double above =
          kNameLineStep * em * static_cast<double>(axes_.y.texts[i].size() - 1) / 2.0;
      draw_label(axes_.y, i, [&](double width, double down) {
        return Point{f.x0 - away - width,
                     map_.y(axes_.y.ticks.at[i]) + FontFacts::kCapHeight * em / 2.0 + down - above};
      });
    }
  }

  /// @param place  Of a line, by its width and how far it is below the first one.
  template <typename Place>
  void draw_label(const TickLabels& labels, std::size_t i, const Place& place) {
    const double em = theme_.tick_font_pt;
    const std::vector<ShapedText>& lines = labels.texts[i];
    double down = 0.0;
    for (const ShapedText& line : lines) {
      drawing_.add_text(ItemClass::kTickLabel, index_,
                        {.shaped = line,
                         .whole = lines.size() > 1 ? labels.ticks.labels[i] : line.text,
                         .at = place(line.advance * em, down),
                         .size = em,
                         .colour = theme_.text});
      down += kNameLineStep * em;
    }
  }

  void draw_axis_labels(const Panel& panel) {
    const Box& f = axes_.frame;
    const double em = theme_.font_pt;
    const double away = layout_.tick_length() + layout_.tick_gap();
    if (layout_.has_x_label()) {
      const std::string whole = axis_title(panel.x, axes_.x.ticks);
      const Margins margins = layout_.margins(axes_);
      const double left = f.x0 - margins.left, right = f.x1 + margins.right;
      const ShapedText text =
          shape_text_within(whole, (right - left) / em, Elide::kEnd, theme_.font.get());
      const double width = text.advance * em;
      drawing_.add_text(
          ItemClass::kAxisLabel, index_,
          {.shaped = text,
           .whole = whole,
           .at = {std::clamp(f.centre().x - width / 2.0, left, std::max(left, right - width)),
                  f.y1 + layout_.below_frame(axes_) - FontFacts::kDescent * em},
           .size = em,
           .colour = theme_.text});
    }
    if (layout_.has_y_label()) {
      const std::string whole = axis_title(panel.y, axes_.y.ticks);
      const std::vector<ShapedText> lines = upward_lines(whole, f.height(), theme_);
      double x =
          f.x0 - away - axes_.y.widest * theme_.tick_font_pt - 0.6 * em - further_lines(lines, em);
      for (const ShapedText& line : lines) {
        drawing_.add_text(ItemClass::kAxisLabel, index_,
                          {.shaped = line,
                           .whole = whole,
                           .at = {x, f.centre().y + line.advance * em / 2.0},
                           .size = em,
                           .upward = true,
                           .colour = theme_.text});
        x += FontFacts::kLine * em;
      }
    }
  }

  static void add_line(Outline& path, Point a, Point b) {
    path.move_to(a);
    path.line_to(b);
  }

  void stroke(ItemClass item_class, Outline path, Colour colour) {
    if (path.points.empty()) return;
    Shape shape;
    shape.path = std::move(path);
    shape.stroke = Stroke{colour, theme_.hairline_pt, {}};
    drawing_.add(item_class, index_, std::move(shape));
  }

  const Axes& axes_;
  std::size_t index_;
  const AxesLayout& layout_;
  const Theme& theme_;
  Drawing& drawing_;
  PanelMap map_;
};

constexpr std::size_t kMostTitleLines = 8;  // They hold a long name in the narrowest panel.
constexpr double kLeastBeside = 0.5;  // Of the room's width, for a frame beside a legend.

/// Where everything of a panel goes.
struct Arrangement {
  Axes axes;
  std::optional<Point> legend_at;
  LegendArrangement legend;
};

/// Tries the legend inside, where it covers no data, then beside and below the frame, whichever
/// leaves more room.
class Arranger {
 public:
  /// @param beside_frame  What stands right of the frame before a legend, in points.
  Arranger(const AxesLayout& layout, const Legend& legend, double beside_frame)
      : layout_(layout),
        legend_(legend),
        beside_frame_(beside_frame),
        panel_(layout.panel()),
        theme_(layout.theme()) {}

  Arrangement arrange(Box room) const {
    room.x1 -= beside_frame_;
    Arrangement found = choose(room);
    if (panel_.equal_aspect) centre(found, room);
    return found;
  }

 private:
  Arrangement choose(const Box& room) const {
    Arrangement inside{layout_.within(room), std::nullopt, {}};
    if (legend_.empty()) return inside;
    Arrangement right = beside(room);
    if (area(right) >= 0.97 * area(inside)) return right;
    const Obstacles data = data_obstacles(panel_, layout_.map(inside.axes.frame), theme_);
    if (const auto position = legend_.free_place(inside.axes.frame, data);
        position && !has_image(panel_)) {
      inside.legend_at = Point{position->x0, position->y0};
      inside.legend = legend_.in_one_column();
      return inside;
    }
    const Arrangement under = below(room);
    return area(right) >= area(under) ? right : under;
  }

  /// Shares out the width that equal scales leave free on both sides.
  void centre(Arrangement& found, const Box& room) const {
    Box& frame = found.axes.frame;
    double end = frame.x1 + bar_room(frame);
    if (found.legend_at) end = std::max(end, found.legend_at->x + found.legend.size.x);
    const double shift = std::max(0.0, (room.x1 - end) / 2.0);
    frame.x0 += shift;
    frame.x1 += shift;
    if (found.legend_at) found.legend_at->x += shift;
  }

  /// What a colour bar takes, right of the frame and of texts that reach over it.
  double bar_room(const Box& frame) const {
    const double room = colour_bar_room(panel_, frame.height(), theme_);
    return room > 0.0 ? room + layout_.right_of(frame) : 0.0;
  }

  static double area(const Arrangement& arrangement) {
    const Box& frame = arrangement.axes.frame;
    return std::max(frame.width(), 0.0) * std::max(frame.height(), 0.0);
  }

  Arrangement beside(const Box& room) const {
    const double gap = 2.0 * theme_.space_pt;
    LegendArrangement legend = legend_.in_one_column();
    const Point size = legend.size;
    Box rest = room;
    rest.x1 -= size.x + gap;
    Arrangement found{layout_.within(rest), std::nullopt, std::move(legend)};
    const Box& frame = found.axes.frame;
    found.legend_at = Point{frame.x1 + bar_room(frame) + beside_frame_ + gap, frame.y0};
    const bool is_narrow = !panel_.equal_aspect && frame.width() < kLeastBeside * room.width();
    if (size.y > frame.height() || is_narrow) found.axes.frame = {};  // No choice.
    return found;
  }

  Arrangement below(const Box& room) const {
    LegendArrangement legend = legend_.within(0.9 * room.width());
    const Point size = legend.size;
    Box rest = room;
    rest.y1 -= size.y + theme_.space_pt;
    Arrangement found{layout_.within(rest), std::nullopt, std::move(legend)};
    const Box& frame = found.axes.frame;
    const double left = std::min(frame.x0, room.x1 - size.x);
    found.legend_at = Point{std::max(left, room.x0),
                            frame.y1 + layout_.margins(found.axes).bottom + theme_.space_pt};
    return found;
  }

  const AxesLayout& layout_;
  const Legend& legend_;
  double beside_frame_;
  const Panel& panel_;
  const Theme& theme_;
};

}  // namespace

std::vector<TitleLine> title_lines(const std::string& title, double most, const Font* font) {
  std::vector<TitleLine> lines;
  for (std::size_t begin = 0; begin < title.size();) {
    const std::size_t end = std::min(title.find('\n', begin), title.size());
    const std::string whole = title.substr(begin, end - begin);
    for (ShapedText& line : wrap_text(whole, most, kMostTitleLines, font))
      lines.push_back({std::move(line), whole});
    begin = end + 1;
  }
  return lines;
}

Box draw_panel_title(const Panel& panel, std::size_t index, const Box& cell, const Theme& theme,
                     Drawing& drawing) {
  if (panel.title.empty()) return cell;
  const double em = theme.font_pt;
  double y = cell.y0;
  for (const TitleLine& line : title_lines(panel.title, cell.width() / em, theme.font.get())) {
    drawing.add_text(ItemClass::kPanelTitle, index,
                     {.shaped = line.shaped,
                      .whole = line.whole,
                      .at = {cell.x0, y + FontFacts::kAscent * em},
                      .size = em,
                      .colour = theme.text});
    y += FontFacts::kLine * em;
  }
  return {cell.x0, y, cell.x1, cell.y1};
}

void draw_panel(const AxesLayout& layout, std::size_t panel_index, const Axes& axes,
                Drawing& drawing) {
  const Panel& panel = layout.panel();
  const Theme& theme = layout.theme();
  AxesPainter painter(axes, panel_index, layout, drawing);
  drawing.frames.push_back(axes.frame);
  drawing.numbers.push_back(layout.numbers(axes));
  if (!panel.bare) painter.draw_grid();
  draw_layers(panel, panel_index, layout.map(axes.frame), theme, drawing);
  if (!panel.bare) painter.draw_axes();
  Box beside = axes.frame;
  beside.x1 += layout.right_of(axes.frame);
  draw_colour_bar(panel, panel_index, beside, theme, drawing);
}

std::set<std::string> labels_of(const Panel& panel) {
  std::set<std::string> labels;
  for (const Layer& layer : panel.layers) labels.insert(label_of(layer));
  labels.erase("");
  return labels;
}

void lay_out_panel(const Panel& panel, std::size_t panel_index, const Box& cell, const Theme& theme,
                   Drawing& drawing, const std::set<std::string>& known) {
  const Box room = draw_panel_title(panel, panel_index, cell, theme, drawing);
  const AxesLayout layout(panel, theme);
  const LineEndLabels ends(layout);
  const Panel rest = ends.without_labels();
  const bool as_bars = bands_hide_each_other(panel);
  const Legend of_rest(rest, theme, cell.width(), as_bars);
  Arrangement arrangement =
      Arranger(layout, of_rest, ends.empty() ? 0.0 : ends.width()).arrange(room);
  const bool at_ends = ends.fit(arrangement.axes.frame, room);
  Legend of_all(panel, theme, cell.width(), as_bars);
  of_all.order_by_ends(ends_of_lines(panel, panel_limits(panel), true));
  const Legend none({}, theme, cell.width(), as_bars);
  const Legend& legend = at_ends                                          ? of_rest
                         : std::ranges::includes(known, labels_of(panel)) ? none
                                                                          : of_all;
  if (!at_ends) arrangement = Arranger(layout, legend, 0.0).arrange(room);
  const Box& frame = arrangement.axes.frame;
  draw_panel(layout, panel_index, arrangement.axes, drawing);

  const PanelMap map = layout.map(frame);
  Obstacles taken = data_obstacles(panel, map, theme);
  if (arrangement.legend_at) {
    const Point at = *arrangement.legend_at;
    const Point extent = arrangement.legend.size;
    const Box position{at.x, at.y, at.x + extent.x, at.y + extent.y};
    if (frame.overlaps(position)) legend.draw_box(position, panel_index, drawing);
    legend.draw(at, arrangement.legend, panel_index, drawing);
    taken.boxes.push_back(position);
  }
  if (at_ends) ends.draw(frame, panel_index, drawing);
  draw_mark_labels(layout, panel_index, frame, std::move(taken), drawing);
}

}  // namespace mapproof
