#pragma once

#include "render/plot/axes_layout.hpp"
#include "render/plot/drawing.hpp"

namespace mapproof {

/// Draws the lines of a panel's grid; they belong below its layers.
void draw_grid(const Axes& axes, std::size_t panel_index, const AxesLayout& layout,
               const Theme& theme, Drawing& drawing);

/// Draws frame, ticks and their labels, and the axes' own labels.
void draw_axes(const Panel& panel, const Axes& axes, std::size_t panel_index,
               const AxesLayout& layout, const Theme& theme, Drawing& drawing);

}  // namespace mapproof
