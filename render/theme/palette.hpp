#pragma once

#include <array>

#include "render/theme/colour.hpp"

namespace mapproof {

/// Colours that the colour-blind can distinguish [okabe2008], in the order of a figure's curves,
/// each at least 3:1 on white: its sky blue and yellow are darkened to that; its orange, which
/// would then be near vermilion, is left out.
inline constexpr std::array<Colour, 7> kSeriesColours = {
    colour(0x0072B2),  // blue
    colour(0xD55E00),  // vermilion
    colour(0x009E73),  // bluish green
    colour(0xC66FA1),  // reddish purple
    colour(0x000000),  // black
    colour(0x8A7D00),  // yellow, darkened
    colour(0x3A90C4),  // sky blue, darkened
};

/// The same on a dark page, each the lighter one of its light counterpart.
inline constexpr std::array<Colour, 7> kDarkSeriesColours = {
    colour(0x4BA6E0), colour(0xF08A3C), colour(0x2CC79A), colour(0xDE9CC2),
    colour(0xFFFFFF), colour(0xC9B93A), colour(0x7CC0EA)};

/// The colour at `share` of viridis [vanderwalt2015], 0 (dark) to 1 (light), clamped; for fields.
Colour viridis(double share);

}  // namespace mapproof
