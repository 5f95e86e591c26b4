#pragma once

#include "render/plot/axis_map.hpp"
#include "render/plot/drawing.hpp"
#include "render/plot/obstacles.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// Draws the panel's point labels where they cover neither `taken`, nor each other, nor the frame;
/// farther ones get a line to their point. One that fits nowhere is left out.
void draw_mark_labels(const Panel& panel, std::size_t panel_index, const PanelMap& map,
                      const Box& frame, Obstacles taken, const Theme& theme, Drawing& drawing);

}  // namespace mapproof
