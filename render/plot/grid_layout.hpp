#pragma once

#include "render/plot/drawing.hpp"
#include "render/plot/figure.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// Lays several panels out in rows from the top of `room` down; the page becomes as high as they
/// need. Panels that share an axis get frames of one size and one legend.
void lay_out_grid(const Figure& figure, const Box& room, const Theme& theme, Drawing& drawing);

}  // namespace mapproof
