#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "render/plot/axis_map.hpp"
#include "render/plot/drawing.hpp"
#include "render/plot/figure.hpp"
#include "render/theme/font.hpp"
#include "render/theme/theme.hpp"
#include "render/theme/ticks.hpp"

namespace mapproof {

/// Whether a layer of the panel asks for a colour bar.
bool has_colour_bar(const Panel& panel);

/// What the colour bar of a panel's first layer that asks for one needs right of its frame, in
/// points; 0 without one.
/// @param height  Of the frame, which is the bar's.
double colour_bar_room(const Panel& panel, double height, const Theme& theme);

/// What of it lines of the bar's label after the first need, in points.
double colour_bar_label_room(const Panel& panel, double height, const Theme& theme);

/// Draws the bar beside the frame, its least value at the foot, with ticks and its label.
void draw_colour_bar(const Panel& panel, std::size_t panel_index, const Box& frame,
                     const Theme& theme, Drawing& drawing);

/// Ticks and their labels, shaped.
struct TickLabels {
  Ticks ticks;
  std::vector<std::vector<ShapedText>> texts;  ///< Of each, in lines.
  double widest = 0.0;                         ///< In em.

  /// Of the widest line of one, in em.
  double width(std::size_t i) const;
  /// The most of one; 0 without labels.
  std::size_t lines() const;
};

/// The label of an axis with the factor of its ticks.
std::string axis_title(const Axis& axis, const Ticks& ticks);

/// A label that is read from below to above, in one line, or more where one is longer than `height`
/// points; what does not fit in the last one is elided. The first line is the leftmost.
std::vector<ShapedText> upward_lines(const std::string& label, double height, const Theme& theme);

/// What the lines after the first take across, in points.
double further_lines(const std::vector<ShapedText>& lines, double em);

/// A frame with its ticks.
struct Axes {
  Box frame;
  TickLabels x, y;
};

/// What labels need around a frame, in points.
struct Margins {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
};

/// Which axes are labelled: ticks' labels and, apart from them, the axis' own.
struct AxisLabels {
  bool x_ticks = true, y_ticks = true;
  bool x_label = true, y_label = true;
};

/// Finds a frame's place in the room it is given, and its ticks.
class AxesLayout {
 public:
  AxesLayout(const Panel& panel, const Theme& theme, AxisLabels shown = {});

  /// The largest frame in `room` that leaves space for labels; empty or turned round if there is
  /// none.
  Axes within(const Box& room) const;
  /// The ticks of a frame that stands already.
  Axes in(const Box& frame) const;
  /// Around those axes; texts at points that reach over the frame's sides count as labels.
  Margins margins(const Axes& axes) const;
  PanelMap map(const Box& frame) const;
  /// How far texts at points reach over the right side of a frame: a colour bar stands right of
  /// them.
  double right_of(const Box& frame) const { return overhang(frame).right; }
  /// What the labels of those axes count.
  FrameNumbers numbers(const Axes& axes) const;

  /// How high a frame of that width is at least, so that each of its rows' names has room; 0 of
  /// more than a hundred, and of numbers, of which a reader misses none.
  double height_of_names(double width) const;

  double tick_length() const { return 0.6 * theme_.space_pt; }
  const Panel& panel() const { return panel_; }
  const Theme& theme() const { return theme_; }
  double tick_gap() const { return 0.6 * theme_.space_pt; }
  /// From the frame of those axes down to the foot of the axis label, in points.
  double below_frame(const Axes& axes) const;
  bool has_x_label() const { return shown_.x_label && !panel_.bare && !panel_.x.label.empty(); }
  bool has_y_label() const { return shown_.y_label && !panel_.bare && !panel_.y.label.empty(); }

 private:
  void choose_ticks(Axes& axes) const;
  void choose_equal_ticks(Axes& axes, int most_x, int most_y) const;
  TickLabels named_rows(const Box& frame) const;
  bool labels_touch(const Axes& axes, double gap_em = 0.7) const;
  Ticks ticks_for(const Axis& axis, Range range, int most) const;
  Ticks enough_ticks(const Axis& axis, Range range, int most, double length, double least) const;
  Margins overhang(const Box& frame) const;
  double label_lines(const Axes& axes) const;
  void shrink_to_aspect(Box& frame) const;

  const Panel& panel_;
  const Theme& theme_;
  AxisLabels shown_;
  PanelLimits limits_;
};

}  // namespace mapproof
