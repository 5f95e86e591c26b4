#include "render/plot/line_ends.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/plot/layers.hpp"
#include "render/plot/markers.hpp"
#include "render/plot/short_names.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kFewestEnds = 2;  // One line needs no telling apart.
constexpr std::size_t kMostEnds = 12;
constexpr double kFarthestEnd = 0.25;  // From the right side, of the frame's width.
constexpr double kLeastOfRoom = 0.5;   // Of its width, for the frame.
constexpr double kWidestEnd = 14.0;    // Longer ones need a legend; em, as the following.
constexpr double kEndRow = 1.3;
constexpr double kEndGap = 0.5;   // From the frame to the line, and from it to the label.
constexpr double kEndLine = 2.2;  // From the height of the end to that of the label.

double share_of(const Axis& axis, Range limits, double value) {
  return AxisMap(axis.scale, limits, 0.0, 1.0)(value);
}

std::optional<LineEnd> end_of(const Polyline& line) {
  for (std::size_t i = line.x.size(); i-- > 0;)
    if (std::isfinite(line.x[i]) && std::isfinite(line.y[i]))
      return LineEnd{line.label, &line, line.x[i], line.y[i]};
  return std::nullopt;
}

/// Heights in ascending order moved apart to at least `row`, as little as that takes, within
/// [low, high].
std::vector<double> apart(const std::vector<double>& wanted, double row, double low, double high) {
  struct Group {
    double sum = 0.0;  ///< Of the heights that its members would give the first one.
    std::size_t size = 0;

    double first() const { return sum / static_cast<double>(size); }
  };
  std::vector<Group> groups;
  for (const double height : wanted) {
    groups.push_back({height, 1});
    while (groups.size() > 1) {
      const Group& last = groups.back();
      Group& before = groups[groups.size() - 2];
      const double shift = row * static_cast<double>(before.size);
      if (before.first() + shift <= last.first()) break;
      before.sum += last.sum - shift * static_cast<double>(last.size);
      before.size += last.size;
      groups.pop_back();
    }
  }
  std::vector<double> heights;
  for (const Group& group : groups)
    for (std::size_t i = 0; i < group.size; ++i)
      heights.push_back(group.first() + row * static_cast<double>(i));
  double most = high;
  for (std::size_t i = heights.size(); i-- > 0; most -= row)
    heights[i] = std::min(heights[i], most);
  double least = low;
  for (double& height : heights) {
    height = std::max(height, least);
    least = height + row;
  }
  return heights;
}

}  // namespace

std::vector<LineEnd> ends_of_lines(const Panel& panel, const PanelLimits& limits, bool anywhere) {
  std::vector<LineEnd> ends;
  if (panel.equal_aspect || panel.bare) return ends;
  for (const Layer& layer : panel.layers) {
    const auto* line = std::get_if<Polyline>(&layer);
    if (line == nullptr || line->label.empty()) continue;
    const auto end = end_of(*line);
    if (!end) return {};
    if (!anywhere && share_of(panel.x, limits.x, end->x) < 1.0 - kFarthestEnd) return {};
    const auto same = std::ranges::find(ends, line->label, &LineEnd::label);
    same == ends.end() ? ends.push_back(*end) : void(*same = *end);
  }
  std::ranges::stable_sort(ends, std::greater(), &LineEnd::y);
  return ends;
}

LineEndLabels::LineEndLabels(const AxesLayout& layout) : layout_(layout) {
  const Theme& theme = layout.theme();
  if (has_colour_bar(layout.panel())) return;
  ends_ = ends_of_lines(layout.panel(), panel_limits(layout.panel()));
  double widest = shape(label_in);
  if (widest > kWidestEnd)
    widest = shape([](const Theme&, const std::string& label) { return short_name(label); });
  if (ends_.size() < kFewestEnds || ends_.size() > kMostEnds || widest > kWidestEnd) ends_.clear();
  width_ = (2.0 * kEndGap + kEndLine + widest) * theme.font_pt;
}

double LineEndLabels::shape(std::string (*shown)(const Theme&, const std::string&)) {
  const Theme& theme = layout_.theme();
  texts_.clear();
  double widest = 0.0;
  for (const LineEnd& end : ends_) {
    texts_.push_back(shape_text(shown(theme, end.label), theme.font.get()));
    widest = std::max(widest, texts_.back().advance);
  }
  return widest;
}

bool LineEndLabels::fit(const Box& frame, const Box& room) const {
  const double height = kEndRow * layout_.theme().font_pt * static_cast<double>(ends_.size());
  return !empty() && height <= frame.height() && frame.width() >= kLeastOfRoom * room.width();
}

void LineEndLabels::draw(const Box& frame, std::size_t panel_index, Drawing& drawing) const {
  const Theme& theme = layout_.theme();
  const double em = theme.font_pt, row = kEndRow * em;
  const PanelMap map = layout_.map(frame);
  std::vector<double> heights;
  for (const LineEnd& end : ends_) heights.push_back(std::clamp(map.y(end.y), frame.y0, frame.y1));
  const std::vector<double> rows = apart(heights, row, frame.y0 + row / 2.0, frame.y1 - row / 2.0);
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    const Polyline& line = *ends_[i].line;
    const Point from{frame.x1 + kEndGap * em, heights[i]};
    const Point to{from.x + kEndLine * em, rows[i]};
    Shape shape;
    shape.path.move_to(from);
    shape.path.line_to(to);
    shape.stroke = stroke_of(line.colour, line.dash, line.width, theme);
    drawing.add(ItemClass::kLegendSample, panel_index, std::move(shape));
    if (line.marker != Marker::kNone) {
      const Shape symbol =
          marker_symbol(line.marker, true, theme.marker_pt, theme.of(line.colour), theme);
      drawing.add(ItemClass::kLegendSample, panel_index, Stamp{symbol_index(drawing, symbol), to});
    }
    drawing.add_text(
        ItemClass::kLegendText, panel_index,
        {.shaped = texts_[i],
         .whole = ends_[i].label,
         .at = {to.x + kEndGap * em, to.y + FontFacts::kXHeight / 2.0 * em + 0.06 * em},
         .size = em,
         .colour = theme.text});
  }
}

Panel LineEndLabels::without_labels() const {
  Panel panel = layout_.panel();
  for (Layer& layer : panel.layers)
    if (std::ranges::find(ends_, label_of(layer), &LineEnd::label) != ends_.end())
      set_label(layer, "");
  return panel;
}

}  // namespace mapproof
