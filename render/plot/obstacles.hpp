#pragma once

#include <vector>

#include "render/base/geometry.hpp"
#include "render/plot/axis_map.hpp"
#include "render/plot/figure.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// What text must not cover.
struct Obstacles {
  struct Line {
    Point a, b;
    double half_width = 0.0;
  };
  std::vector<Box> boxes;
  std::vector<Line> lines;

  bool hit(const Box& box) const;
};

/// What the panel's layers take.
Obstacles data_obstacles(const Panel& panel, const PanelMap& map, const Theme& theme);

}  // namespace mapproof
