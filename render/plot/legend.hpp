#pragma once

#include <vector>

#include "render/plot/drawing.hpp"
#include "render/plot/line_ends.hpp"
#include "render/plot/obstacles.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// An entry of a legend: all layers that share a label.
struct LegendEntry {
  std::vector<ShapedText> lines;
  std::string whole;
  std::vector<const Layer*> layers;
  bool in_colours = false;  ///< It stands for points of several colours: its sample is grey.
};

/// A panel's legend before it has a position.
class Legend {
 public:
  /// @param most_width_pt  Of one entry; longer labels are broken into lines on paper, and elided
  ///                       where they are too long even so. Pages break lines themselves.
  /// @param as_bars  Whether bands are drawn as bars.
  Legend(const Panel& panel, const Theme& theme, double most_width_pt, bool as_bars);

  /// Lists these lines in the order of their ends, other entries staying in place.
  void order_by_ends(const std::vector<LineEnd>& ends);

  bool empty() const { return entries_.empty(); }
  /// Width and height of the legend in so many columns.
  Point size(std::size_t columns) const;
  /// The most columns that are not wider than `width`; at least 1.
  std::size_t columns_within(double width) const;
  /// A corner or edge inside `frame` where no data is covered; the corners first. Empty if all are.
  std::optional<Box> free_place(const Box& frame, const Obstacles& data) const;
  /// Hides the grid behind a legend inside the frame, and separates it from the data by a border.
  void draw_box(const Box& position, std::size_t panel_index, Drawing& drawing) const;
  /// @param at  The upper left corner.
  void draw(Point at, std::size_t columns, std::size_t panel_index, Drawing& drawing) const;

 private:
  /// Of the highest entry of each row.
  std::vector<double> row_heights(std::size_t columns) const;
  void draw_sample(const LegendEntry& entry, const Box& position, std::size_t panel_index,
                   Drawing& drawing) const;

  const Theme& theme_;
  bool as_bars_;
  std::vector<LegendEntry> entries_;
  double sample_width_ = 0.0;
  double entry_width_ = 0.0;
  double row_height_ = 0.0;  ///< Of an entry with one line.
};

}  // namespace mapproof
