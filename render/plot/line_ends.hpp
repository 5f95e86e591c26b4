#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "render/plot/axes_layout.hpp"
#include "render/plot/drawing.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// Where a line with a label ends.
struct LineEnd {
  std::string label;
  const Polyline* line = nullptr;
  double x = 0.0;  ///< Of the last known point.
  double y = 0.0;
};

/// The ends of the lines with a label, one per label (the last one of it), in the order in which a
/// reader sees them at the right side: from above to below. Empty if some line ends far from the
/// right side of `limits`, or the axes are of a map.
/// @param anywhere  Lines may end far from there, too.
std::vector<LineEnd> ends_of_lines(const Panel& panel, const PanelLimits& limits,
                                   bool anywhere = false);

/// Labels beside the ends of a panel's lines, right of its frame, instead of a legend.
class LineEndLabels {
 public:
  explicit LineEndLabels(const AxesLayout& layout);

  /// Whether the panel has lines that can be labelled so.
  bool empty() const { return ends_.empty(); }
  /// What they take right of a frame, in points.
  double width() const { return width_; }
  /// Whether they fit beside the frame, which then keeps enough of the room.
  bool fit(const Box& frame, const Box& room) const;
  void draw(const Box& frame, std::size_t panel_index, Drawing& drawing) const;
  /// The panel without the labels of these lines, for a legend of what is left.
  Panel without_labels() const;

 private:  /// Shapes the labels as they are `shown`; the width of the widest, in em.
  double shape(std::string (*shown)(const Theme&, const std::string&));

  const AxesLayout& layout_;
  std::vector<LineEnd> ends_;
  std::vector<ShapedText> texts_;
  double width_ = 0.0;
};

}  // namespace mapproof
