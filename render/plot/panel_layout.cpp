#include "render/plot/panel_layout.hpp"

#include <algorithm>

#include "render/plot/axes_painter.hpp"
#include "render/plot/colour_bar.hpp"
#include "render/plot/layers.hpp"
#include "render/plot/legend.hpp"
#include "render/plot/mark_labels.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostTitleLines = 2;

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
    if (const auto place = legend_.free_place(inside.axes.frame, data);
        place && !has_picture(panel_)) {
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
    found.legend_at = Point{std::max(left, room.x0),
                            frame.y1 + layout_.margins(found.axes).bottom + theme_.space_pt};
    return found;
  }

  const AxesLayout& layout_;
  const Legend& legend_;
  const Panel& panel_;
  const Theme& theme_;
};

}  // namespace

void add_text(Drawing& drawing, Role role, std::size_t panel_index, const ShapedText& shaped,
              const std::string& whole, Point at, double size, Colour colour, bool upward) {
  TextLine line{shaped, shaped.text == whole ? "" : whole, at, size, upward, colour};
  drawing.add(role, panel_index, std::move(line));
}

std::vector<TitleLine> title_lines(const std::string& title, double most) {
  std::vector<TitleLine> lines;
  for (std::size_t begin = 0; begin < title.size();) {
    const std::size_t end = std::min(title.find('\n', begin), title.size());
    const std::string whole = title.substr(begin, end - begin);
    for (ShapedText& line : wrap_text(whole, most, kMostTitleLines))
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
  for (const TitleLine& line : title_lines(panel.title, cell.width() / em)) {
    add_text(drawing, Role::kPanelTitle, index, line.shaped, line.whole,
             {cell.x0, y + FontFacts::kAscent * em}, em, theme.text);
    y += FontFacts::kLine * em;
  }
  return {cell.x0, y, cell.x1, cell.y1};
}

void draw_panel(const Panel& panel, std::size_t panel_index, const Axes& axes,
                const AxesLayout& layout, const Theme& theme, Drawing& drawing) {
  drawing.frames.push_back(axes.frame);
  if (!panel.bare) draw_grid(axes, panel_index, layout, theme, drawing);
  draw_layers(panel, panel_index, layout.map(axes.frame), theme, drawing);
  if (!panel.bare) draw_axes(panel, axes, panel_index, layout, theme, drawing);
  draw_colour_bar(panel, panel_index, axes.frame, theme, drawing);
}

void lay_out_panel(const Panel& panel, std::size_t panel_index, const Box& cell, const Theme& theme,
                   Drawing& drawing) {
  const Box room = draw_panel_title(panel, panel_index, cell, theme, drawing);
  const AxesLayout layout(panel, theme);
  const Legend legend(panel, theme, 0.62 * cell.width());
  const Arrangement arrangement = Arranger(layout, legend, panel, theme).arrange(room);
  const Box& frame = arrangement.axes.frame;
  draw_panel(panel, panel_index, arrangement.axes, layout, theme, drawing);

  const PanelMap map = layout.map(frame);
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
