#pragma once

#include <optional>
#include <vector>

#include "render/plot/axis_map.hpp"
#include "render/plot/figure.hpp"
#include "reports/diff/verdict/tolerances.hpp"

namespace mapproof {

enum class Movement { kNone, kWithin, kBeyond };

/// Where the points of two figures stand, in their units and on the page.
class FigurePlaces {
 public:
  /// The figures must outlive it. A figure that cannot be drawn has no page.
  FigurePlaces(const Figure& baseline, const Figure& current);

  /// Whether a point of a panel moved: along an axis by more than `tolerance`, its relative part
  /// that of what the panel spans, or on a log axis of the value. A point on one side alone moved.
  Movement movement(std::size_t panel, Point before, Point after, const Tolerance& tolerance) const;

  /// Between the two places on the pages of the report's theme, in its pixels.
  std::optional<double> distance_px(std::size_t panel, Point before, Point after) const;

 private:
  struct Pages {
    std::vector<PanelMap> current;  ///< One a panel; empty: cannot be drawn.
    double px_per_pt = 1.0;
  };
  const Pages& pages() const;

  const Figure& baseline_;
  const Figure& current_;
  std::vector<PanelLimits> limits_;     ///< Of the baseline's panels.
  mutable std::optional<Pages> pages_;  ///< Laid out when first asked for.
};

}  // namespace mapproof
