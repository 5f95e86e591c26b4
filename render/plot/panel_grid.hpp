#pragma once

#include <cstddef>

#include "render/plot/drawing.hpp"
#include "render/plot/figure.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// Lays several panels out in rows that begin at the top of `room` and are as high as they need to
/// be: in one grid with common axes where the figure shares these, else in cells of their own, with
/// the figure's arrows between them. Sets the drawing's height to where they end.
/// @param stretch  Of the usual height of the rows, but for panels of a fixed shape in cells.
void lay_out_grid(const Figure& figure, const Box& room, const Theme& theme, double stretch,
                  Drawing& drawing);

/// The lowest drawn point of the panels from `first` on.
double lowest_drawn(const Drawing& drawing, std::size_t first);

}  // namespace mapproof
