#pragma once

#include "render/plot/drawing.hpp"
#include "render/plot/figure.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// No marker's outline is farther from its middle than this, in units of its size.
inline constexpr double kMarkerReach = 0.62;

/// The symbol of a marker about the origin; markers of one size have about the same area. An open
/// one is filled with the background, so that lines below end at its rim.
Shape marker_symbol(Marker marker, bool filled, double size_pt, Colour colour, const Theme& theme);

/// The head of an arrow that ends at `to`.
Shape arrow_head(Point from, Point to, Colour colour, const Theme& theme);

/// The symbol's index in the drawing; added if it is not there yet.
std::size_t symbol_index(Drawing& drawing, const Shape& symbol);

}  // namespace mapproof
