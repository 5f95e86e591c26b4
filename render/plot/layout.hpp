#pragma once

#include "render/plot/drawing.hpp"
#include "render/plot/figure.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// Everything about the figure's geometry: limits, ticks, margins, and room for the legend and
/// for labels where they cover nothing.
/// @throws InvalidInput if the figure cannot be drawn (see `problem`).
Drawing lay_out(const Figure& figure, const Theme& theme);

/// Whether the figure's notes are drawn: as the theme has it, but for a figure without content,
/// whose notes say why.
bool draws_notes(const Figure& figure, const Theme& theme);

}  // namespace mapproof
