#pragma once

#include <string>

#include "render/plot/figure.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// A script of Python that draws the figure's data by matplotlib, for a person to go on with: the
/// data as lists, one call per layer, the colours and sizes of the theme. It writes ID.pdf, or the
/// file that it is called with. Positions of labels and legend are matplotlib's.
/// @throws InvalidInput if the figure cannot be drawn.
std::string figure_script(const Figure& figure, const Theme& theme);

}  // namespace mapproof
