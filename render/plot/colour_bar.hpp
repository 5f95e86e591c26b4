#pragma once

#include <cstddef>

#include "render/plot/drawing.hpp"
#include "render/plot/figure.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// The cells of a panel that ask for a colour bar; null if none do.
const Cells* cells_with_bar(const Panel& panel);

/// What the colour bar of a panel needs right of its frame, in points; 0 without one.
/// @param height  Of the frame, which is the bar's.
double colour_bar_room(const Panel& panel, double height, const Theme& theme);

/// What of it lines of the bar's label after the first need, in points.
double colour_bar_label_room(const Panel& panel, double height, const Theme& theme);

/// Draws the bar beside the frame, its least value at the foot, with ticks and its label.
void draw_colour_bar(const Panel& panel, std::size_t panel_index, const Box& frame,
                     const Theme& theme, Drawing& drawing);

}  // namespace mapproof
