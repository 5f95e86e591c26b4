#pragma once

#include <string>

#include "render/plot/drawing.hpp"

namespace mapproof {

/// The drawing as an SVG 1.1 file. Every id begins with the drawing's; text is outlines of the font
/// with the string beside it in aria-label; marks carry their ids and data attributes. The same
/// drawing gives the same bytes, with no date, no machine's name and no counter in them.
std::string to_svg(const Drawing& drawing);

}  // namespace mapproof
