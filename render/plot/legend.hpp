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

/// Where the entries of a legend stand, from its upper left corner.
struct LegendArrangement {
  std::vector<Point> at;  ///< The upper left corner of each entry.
  Point size;             ///< Width and height of all.
};

/// A panel's legend before it has a position.
class Legend {
 public:
  /// @param most_width_pt  Of one entry; longer labels are broken into lines.
  /// @param as_bars  Whether bands are drawn as bars.
  Legend(const Panel& panel, const Theme& theme, double most_width_pt, bool as_bars);

  /// Lists these lines in the order of their ends, other entries staying in place.
  void order_by_ends(const std::vector<LineEnd>& ends);

  bool empty() const { return entries_.empty(); }
  /// One entry below the other.
  LegendArrangement in_one_column() const { return in_columns(1); }
  /// In as few rows as a width allows: in columns of equal width, at least one; on paper also one
  /// entry after the other, if that takes fewer rows.
  LegendArrangement within(double width) const;
  /// A corner or edge inside `frame` where no data is covered; the corners first. Empty if all are.
  std::optional<Box> free_place(const Box& frame, const Obstacles& data) const;
  /// Hides the grid behind a legend inside the frame, and separates it from the data by a border.
  void draw_box(const Box& position, std::size_t panel_index, Drawing& drawing) const;
  /// @param at  The upper left corner.
  void draw(Point at, const LegendArrangement& arrangement, std::size_t panel_index,
            Drawing& drawing) const;

 private:
  double width_of(const LegendEntry& entry) const;
  double height_of(const LegendEntry& entry) const;
  LegendArrangement in_columns(std::size_t columns) const;
  /// One entry after the other in rows of at most this width.
  LegendArrangement in_rows(double width) const;
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
