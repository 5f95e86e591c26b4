#pragma once

#include <string>
#include <vector>

namespace mapproof {

/// A small curve of changes in percent, oldest first, with a line at zero: an <svg> element without
/// text of its own. Above zero is worse. Classes give the colours: "better", "same", "worse".
/// @param percent  NaN: a gap.
std::string curve_svg(const std::vector<double>& percent);

}  // namespace mapproof
