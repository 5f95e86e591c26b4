#pragma once

#include <string>
#include <vector>

#include "render/plot/drawing.hpp"

namespace mapproof::test {

/// Everything that a reader would hold against the drawing, a line each; empty if it is clean.
/// Looks at pixels and colour, not at what the layout believes: text or legend on data, text on
/// text, text on frame or ticks, colour cut by the border, contrast below 4.5:1 (text) or 3:1
/// (marks), glyphs that the font lacks, a frame too small to read.
std::vector<std::string> flaws(const Drawing& drawing);

}  // namespace mapproof::test
