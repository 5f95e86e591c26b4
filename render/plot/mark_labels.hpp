#pragma once

#include "render/plot/axes_layout.hpp"
#include "render/plot/drawing.hpp"
#include "render/plot/obstacles.hpp"

namespace mapproof {

/// Draws the panel's point labels where they cover neither `taken`, nor each other, nor the frame;
/// farther ones get a line to their point. One that fits nowhere, even if it is placed before
/// others, is left out.
void draw_mark_labels(const AxesLayout& layout, std::size_t panel_index, const Box& frame,
                      Obstacles taken, Drawing& drawing);

}  // namespace mapproof
