#pragma once

#include "reports/diff/images/picture_changes.hpp"
#include "reports/diff/svg/svg_tree.hpp"

namespace mapproof {

/// Compares two SVG files element by element, never by bytes: what is written otherwise and means
/// the same is not a change. Geometry may move by options.svg_distance pixels, channels of
/// colours by options.svg_colour, numbers of style by 0.001; remarks (metadata, data-*, ids that
/// nothing else tells) are listed as changes and always tolerated.
/// @throws InvalidInput if the options cannot be used.
SvgDiff svg_diff(const SvgTree& baseline, const SvgTree& current,
                 const PictureOptions& options = {});

}  // namespace mapproof
