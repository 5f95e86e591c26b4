#pragma once

#include <string>
#include <string_view>

#include "render/plot/drawing.hpp"

namespace mapproof {

/// Adds `text` fit for XML content and quoted attributes. What XML 1.0 forbids and what is not
/// UTF-8 becomes U+FFFD; white space other than blanks, invisible and direction-changing characters
/// become references, so that the source shows them and a parser gives them back.
void append_xml(std::string& out, std::string_view text);

/// Adds `value` with at most two decimals, no trailing zeros: "-.5" stands for minus one half.
void append_number(std::string& out, double value);

/// The drawing as an SVG 1.1 file. Every id begins with the drawing's; text is outlines of the font
/// with the string beside it in aria-label; marks carry their ids and data attributes. The same
/// drawing gives the same bytes, with no date, no machine's name and no counter in them. A raster
/// with a dark image has both in one PNG; its palette in the dark is the attribute data-dark, in
/// base64.
std::string to_svg(const Drawing& drawing);

}  // namespace mapproof
