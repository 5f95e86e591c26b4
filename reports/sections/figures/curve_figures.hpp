#pragma once

#include <vector>

#include "render/plot/figure.hpp"
#include "reports/sections/figures/figure_source.hpp"

namespace mapproof {

/// Error over steps: the paper's, then MPE of the methods that they leave out, then MOE.
std::vector<Figure> curve_figures(FigureSource& source);

}  // namespace mapproof
