#pragma once

#include <optional>
#include <vector>

#include "render/plot/axis_map.hpp"
#include "render/plot/figure.hpp"
#include "reports/diff/verdict/tolerances.hpp"

namespace mapproof {

enum class Movement { kNone, kWithin, kBeyond };

/// The positions of the points of two figures, in their units and on the page.
class FigurePositions {
 public:
  /// The figures must outlive it. A figure that cannot be drawn has no page.
  FigurePositions(const Figure& baseline, const Figure& current);

  /// Whether a point of a panel moved along an axis by more than `tolerance`. The relative part
  /// refers to the span of the panel, or on a log axis to the value. A point on only one side
  /// moved.
  Movement movement(std::size_t panel, Point before, Point after, const Tolerance& tolerance) const;

  /// The distance of two positions on the page of the report's theme, in its pixels.
  std::optional<double> distance_px(std::size_t panel, Point before, Point after) const;

 private:
  struct Pages {
    std::vector<PanelMap> current;  ///< One per panel; empty: cannot be drawn.
    double px_per_pt = 1.0;
  };
  const Pages& pages() const;

  const Figure& baseline_;
  const Figure& current_;
  std::vector<PanelLimits> limits_;     ///< Of the baseline's panels.
  mutable std::optional<Pages> pages_;  ///< Computed on first use.
};

}  // namespace mapproof
