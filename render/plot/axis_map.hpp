#pragma once

#include "render/base/geometry.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// From values on an axis to points of the page.
class AxisMap {
 public:
  AxisMap() = default;
  /// `limits.low` comes to stand at `start_pt`, `limits.high` at `end_pt`.
  AxisMap(Scale scale, Range limits, double start_pt, double end_pt);

  /// NaN for NaN.
  double operator()(double value) const;

 private:
  Scale scale_ = Scale::kLinear;
  double low_ = 0.0;
  double points_per_unit_ = 1.0;
  double start_pt_ = 0.0;
};

/// Both axes of a panel.
struct PanelMap {
  AxisMap x, y;
  Point operator()(double value_x, double value_y) const { return {x(value_x), y(value_y)}; }
};

struct PanelLimits {
  Range x, y;
};

/// The upright box about one of the ellipses; NaN if the ellipse has one.
PanelLimits ellipse_box(const Ellipses& ellipses, std::size_t i);

/// The limits asked for, or what the layers span and a little more; never empty. Equal aspect keeps
/// the longer side below 2.5 times the shorter.
PanelLimits panel_limits(const Panel& panel);

}  // namespace mapproof
