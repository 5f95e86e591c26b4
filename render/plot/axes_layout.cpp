#include "render/plot/axes_layout.hpp"

#include <algorithm>

namespace mapproof {
namespace {

constexpr double kLabelLine = 1.55;  // From the foot of tick labels to the axis label's, em.

Ticks ticks_for(const Axis& axis, Range range, int most) {
  if (axis.scale == Scale::kLog) return log_ticks(range.low, range.high, most);
  return linear_ticks(range.low, range.high, tick_step(range.low, range.high, most));
}

TickLabels shaped(Ticks ticks) {
  TickLabels labels{std::move(ticks), {}, 0.0};
  for (const std::string& text : labels.ticks.labels) {
    labels.texts.push_back(shape_text(text));
    labels.widest = std::max(labels.widest, labels.texts.back().advance);
  }
  return labels;
}

}  // namespace

AxesLayout::AxesLayout(const Panel& panel, const Theme& theme)
    : panel_(panel), theme_(theme), limits_(panel_limits(panel)) {}

Axes AxesLayout::within(const Box& room) const {
  // The margins depend on the ticks' labels, those on the frame: twice is enough.
  Axes axes;
  axes.frame = room;
  for (int pass = 0; pass < 2; ++pass) {
    choose_ticks(axes);
    axes.frame = frame_within(room, axes);
  }
  return axes;
}

PanelMap AxesLayout::map(const Box& frame) const {
  return {AxisMap(panel_.x.scale, limits_.x, frame.x0, frame.x1),
          AxisMap(panel_.y.scale, limits_.y, frame.y1, frame.y0)};
}

double AxesLayout::below_frame() const {
  const double label = panel_.x.label.empty() ? 0.0 : kLabelLine * theme_.font_pt;
  return tick_length() + tick_gap() + FontFacts::kAscent * theme_.tick_font_pt + label;
}

void AxesLayout::choose_ticks(Axes& axes) const {
  const double em = theme_.tick_font_pt;
  const int most_y = std::clamp(static_cast<int>(axes.frame.height() / (3.2 * em)), 2, 8);
  int most_x = std::clamp(static_cast<int>(axes.frame.width() / (4.0 * em)), 2, 9);
  if (panel_.equal_aspect) {
    choose_equal_ticks(axes, most_x, most_y);
  } else {
    axes.x = shaped(ticks_for(panel_.x, limits_.x, most_x));
    axes.y = shaped(ticks_for(panel_.y, limits_.y, most_y));
  }
  while (most_x > 2 && labels_touch(axes)) {
    axes.x = shaped(ticks_for(panel_.x, limits_.x, --most_x));
  }
}

/// One step for both axes, so that the grid is of squares.
void AxesLayout::choose_equal_ticks(Axes& axes, int most_x, int most_y) const {
  const double step = std::max(tick_step(limits_.x.low, limits_.x.high, most_x),
                               tick_step(limits_.y.low, limits_.y.high, most_y));
  axes.x = shaped(linear_ticks(limits_.x.low, limits_.x.high, step));
  axes.y = shaped(linear_ticks(limits_.y.low, limits_.y.high, step));
}

bool AxesLayout::labels_touch(const Axes& axes) const {
  const AxisMap x(panel_.x.scale, limits_.x, axes.frame.x0, axes.frame.x1);
  const double em = theme_.tick_font_pt;
  for (std::size_t i = 0; i + 1 < axes.x.texts.size(); ++i) {
    const double room = x(axes.x.ticks.at[i + 1]) - x(axes.x.ticks.at[i]);
    if ((axes.x.texts[i].advance + axes.x.texts[i + 1].advance) / 2.0 * em + 0.7 * em > room)
      return true;
  }
  return false;
}

Box AxesLayout::frame_within(const Box& room, const Axes& axes) const {
  const double em = theme_.tick_font_pt;
  const double y_label = panel_.y.label.empty() ? 0.0 : 1.5 * theme_.font_pt;
  const double last = axes.x.texts.empty() ? 0.0 : axes.x.texts.back().advance * em / 2.0;
  Box frame{room.x0 + y_label + axes.y.widest * em + tick_gap() + tick_length(), room.y0 + 0.4 * em,
            room.x1 - std::max(last, theme_.hairline_pt), room.y1 - below_frame()};
  if (panel_.equal_aspect) shrink_to_aspect(frame);
  return frame;
}

void AxesLayout::shrink_to_aspect(Box& frame) const {
  const double aspect = (limits_.x.high - limits_.x.low) / (limits_.y.high - limits_.y.low);
  const double width = std::min(frame.width(), frame.height() * aspect);
  const double height = width / aspect;
  frame.x1 = frame.x0 + width;
  frame.y1 = frame.y0 + height;
}

}  // namespace mapproof
