#pragma once

#include "render/plot/drawing.hpp"
#include "render/plot/figure.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// How many panels stand in a row of that width: at most as many as the figure asks for.
std::size_t columns_within(const Figure& figure, double width, const Theme& theme);

/// As lay_out_grid, for panels that share an axis.
void lay_out_shared(const Figure& figure, const Box& room, const Theme& theme, Drawing& drawing);

}  // namespace mapproof
