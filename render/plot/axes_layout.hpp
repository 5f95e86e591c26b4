#pragma once

#include <vector>

#include "render/plot/axis_map.hpp"
#include "render/theme/font.hpp"
#include "render/theme/theme.hpp"
#include "render/theme/ticks.hpp"

namespace mapproof {

/// Ticks and their labels, shaped.
struct TickLabels {
  Ticks ticks;
  std::vector<ShapedText> texts;
  double widest = 0.0;  ///< In em.
};

/// A frame with its ticks.
struct Axes {
  Box frame;
  TickLabels x, y;
};

/// Finds a frame's place in the room it is given, and its ticks.
class AxesLayout {
 public:
  AxesLayout(const Panel& panel, const Theme& theme);

  /// The largest frame in `room` that leaves space for labels; empty or turned round if there is
  /// none.
  Axes within(const Box& room) const;
  PanelMap map(const Box& frame) const;

  double tick_length() const { return 0.6 * theme_.space_pt; }
  double tick_gap() const { return 0.6 * theme_.space_pt; }
  /// From the frame down to the foot of the axis label, in points.
  double below_frame() const;

 private:
  void choose_ticks(Axes& axes) const;
  void choose_equal_ticks(Axes& axes, int most_x, int most_y) const;
  bool labels_touch(const Axes& axes) const;
  Box frame_within(const Box& room, const Axes& axes) const;
  void shrink_to_aspect(Box& frame) const;

  const Panel& panel_;
  const Theme& theme_;
  PanelLimits limits_;
};

}  // namespace mapproof
