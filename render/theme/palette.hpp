#pragma once

#include <array>

#include "render/theme/colour.hpp"

namespace mapproof {

/// Colours that the colour-blind can distinguish, in the order of a figure's curves, each at least
/// 3:1 on white. The first five are of [okabe2008]; its orange, yellow and sky blue, darkened to
/// that, would be near vermilion and blue. Brown and indigo are darker than all of these but black,
/// so that a grey print tells them apart, too. No two are nearer than 9 in CIEDE2000 [sharma2005],
/// with or without protanopia or deuteranopia [machado2009].
inline constexpr std::array<Colour, 7> kSeriesColours = {
    colour(0x0072B2),  // blue
    colour(0xD55E00),  // vermilion
    colour(0x009E73),  // bluish green
    colour(0xC66FA1),  // reddish purple
    colour(0x000000),  // black
    colour(0x7A3300),  // brown
    colour(0x332288),  // indigo
};

/// The same on a dark page, each at least 4.5:1: yellow stands for brown, mauve for indigo, which
/// would there be near vermilion and blue.
inline constexpr std::array<Colour, 7> kDarkSeriesColours = {
    colour(0x4BA6E0), colour(0xF08A3C), colour(0x2CC79A), colour(0xDE9CC2),
    colour(0xFFFFFF), colour(0xFFEF66), colour(0xA37294)};

/// The colour at `share` of viridis [vanderwalt2015], 0 (dark) to 1 (light), clamped; for fields.
Colour viridis(double share);

}  // namespace mapproof
