#pragma once

#include <string>

#include "render/plot/figure.hpp"
#include "render/scene/scene.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// A script of Python that draws the figure's data by matplotlib, for a person to go on with: the
/// data as lists, one call per layer, the colours and sizes of the theme. It writes
/// ID-matplotlib.pdf, or the file that it is called with. The script places labels where they cover
/// the fewest marks.
/// @throws InvalidInput if the figure cannot be drawn.
std::string figure_script(const Figure& figure, const Theme& theme);

/// As figure_script() of a scene, by mpl_toolkits.mplot3d: one 3-D axes per view.
std::string scene_script(const Scene& scene, const Theme& theme);

}  // namespace mapproof
