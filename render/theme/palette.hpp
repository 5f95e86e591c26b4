#pragma once

#include <array>

#include "render/theme/colour.hpp"
#include "render/theme/theme_colour.hpp"

namespace mapproof {

/// Colours that the colour-blind can distinguish, in the order of a figure's curves, each at least
/// 3:1 on white. The first five are of [okabe2008]; its orange, yellow and sky blue, darkened to
/// that, would be near vermilion and blue. Brown and indigo are darker than all of these but black,
/// so that a grey print tells them apart, too. The last three were searched for: among all colours
/// of 16 levels a channel, they are the strong ones farthest from the others. The nearest two
/// differ in CIEDE2000 [sharma2005] by 21.5, with protanopia or deuteranopia [machado2009] by 9.7
/// and 12.6.
inline constexpr std::array<Colour, kSeriesCount> kSeriesColours = {
    colour(0x0072B2),  // blue
    colour(0xD55E00),  // vermilion
    colour(0x009E73),  // bluish green
    colour(0xC66FA1),  // reddish purple
    colour(0x000000),  // black
    colour(0x7A3300),  // brown
    colour(0x332288),  // indigo
    colour(0xCC2244),  // crimson
    colour(0x9977FF),  // violet
    colour(0x006666),  // dark teal
};

/// The same on a dark page, each at least 4.5:1: yellow stands for brown, mauve for indigo, which
/// would there be near vermilion and blue, and cyan for dark teal. The nearest two differ by 15.2,
/// with protanopia or deuteranopia by 9.1 and 10.8.
inline constexpr std::array<Colour, kSeriesCount> kDarkSeriesColours = {
    colour(0x4BA6E0), colour(0xF08A3C), colour(0x2CC79A), colour(0xDE9CC2), colour(0xFFFFFF),
    colour(0xFFEF66), colour(0xA37294), colour(0xEE4455), colour(0x8866FF), colour(0x55EEFF)};

/// The colour at `share` of viridis [vanderwalt2015], 0 (dark) to 1 (light), clamped; for fields.
Colour viridis(double share);

}  // namespace mapproof
