#include "render/plot/colour_bar.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "render/plot/axis_map.hpp"
#include "render/plot/outlines.hpp"
#include "render/plot/panel_layout.hpp"
#include "render/theme/font.hpp"
#include "render/theme/ticks.hpp"

namespace mapproof {
namespace {

constexpr double kBarWidth = 1.2;   // em of the axis labels.
constexpr double kLabelRoom = 1.6;  // Of one line of the label, em.
constexpr int kBarSteps = 64;

struct Bar {
  Ticks ticks;
  std::vector<ShapedText> texts;
  double widest_pt = 0.0;
  double gap_pt = 0.0;   ///< From the frame to the bar.
  double tick_pt = 0.0;  ///< Length of a tick, and the gap to its label.
};

Bar bar_of(const Cells& cells, double height, const Theme& theme) {
  const double em = theme.tick_font_pt;
  const int most = std::clamp(static_cast<int>(height / (2.6 * em)), 2, 8);
  const auto [low, high] = cells.limits;
  Bar bar;
  bar.ticks = cells.scale == Scale::kLog ? log_ticks(low, high, std::max(most, 3))
                                         : linear_ticks(low, high, tick_step(low, high, most));
  for (const std::string& text : bar.ticks.labels) {
    bar.texts.push_back(shape_text(text));
    bar.widest_pt = std::max(bar.widest_pt, bar.texts.back().advance * em);
  }
  bar.gap_pt = 2.0 * theme.space_pt;
  bar.tick_pt = 0.6 * theme.space_pt;
  return bar;
}

std::string whole_label(const Cells& cells, const Ticks& ticks) {
  return ticks.factor.empty() ? cells.bar_label : cells.bar_label + " " + ticks.factor;
}

}  // namespace

const Cells* cells_with_bar(const Panel& panel) {
  for (const Layer& layer : panel.layers)
    if (const auto* cells = std::get_if<Cells>(&layer);
        cells != nullptr && !cells->bar_label.empty())
      return cells;
  return nullptr;
}

double colour_bar_room(const Panel& panel, double height, const Theme& theme) {
  const Cells* cells = cells_with_bar(panel);
  if (cells == nullptr) return 0.0;
  const Bar bar = bar_of(*cells, height, theme);
  return bar.gap_pt + kBarWidth * theme.font_pt + 2.0 * bar.tick_pt + bar.widest_pt +
         kLabelRoom * theme.font_pt + colour_bar_label_room(panel, height, theme);
}

double colour_bar_label_room(const Panel& panel, double height, const Theme& theme) {
  const Cells* cells = cells_with_bar(panel);
  if (cells == nullptr) return 0.0;
  const std::string label = whole_label(*cells, bar_of(*cells, height, theme).ticks);
  return further_lines(upward_lines(label, height, theme.font_pt), theme.font_pt);
}

void draw_colour_bar(const Panel& panel, std::size_t panel_index, const Box& frame,
                     const Theme& theme, Drawing& drawing) {
  const Cells* cells = cells_with_bar(panel);
  if (cells == nullptr) return;
  const Bar bar = bar_of(*cells, frame.height(), theme);
  const Box box{frame.x1 + bar.gap_pt, frame.y0, frame.x1 + bar.gap_pt + kBarWidth * theme.font_pt,
                frame.y1};
  const auto add = [&](Shape shape) {
    drawing.add(Role::kLegendSample, panel_index, std::move(shape));
  };
  for (int i = 0; i < kBarSteps; ++i) {
    // Each piece reaches to the top, so that no background shows between two.
    Shape piece;
    piece.path.add_box(
        {box.x0, box.y0, box.x1, std::lerp(box.y1, box.y0, static_cast<double>(i) / kBarSteps)});
    piece.fill = ramp_colour(*cells, static_cast<double>(i) / (kBarSteps - 1), theme);
    add(std::move(piece));
  }
  Shape rim;
  rim.path.add_box(box);
  const AxisMap y(cells->scale, cells->limits, box.y1, box.y0);
  for (const double value : bar.ticks.at) {
    rim.path.move_to({box.x1, y(value)});
    rim.path.line_to({box.x1 + bar.tick_pt, y(value)});
  }
  rim.stroke = Stroke{theme.text, theme.hairline_pt, {}};
  add(std::move(rim));
  for (std::size_t i = 0; i < bar.texts.size(); ++i)
    add_text(drawing, Role::kLegendText, panel_index, bar.texts[i], bar.texts[i].text,
             {box.x1 + 2.0 * bar.tick_pt,
              y(bar.ticks.at[i]) + FontFacts::kCapHeight * theme.tick_font_pt / 2.0},
             theme.tick_font_pt, theme.text);
  const double em = theme.font_pt;
  const std::string whole = whole_label(*cells, bar.ticks);
  double x = box.x1 + 2.0 * bar.tick_pt + bar.widest_pt + 1.3 * em;
  for (const ShapedText& line : upward_lines(whole, frame.height(), em)) {
    add_text(drawing, Role::kLegendText, panel_index, line, whole,
             {x, frame.centre().y + line.advance * em / 2.0}, em, theme.text, true);
    x += FontFacts::kLine * em;
  }
}

}  // namespace mapproof
