#pragma once

#include <vector>

#include "render/plot/figure.hpp"
#include "reports/sections/figures/figure_source.hpp"

namespace mapproof {

/// Error over the parameter of each method.
std::vector<Figure> parameter_figures(FigureSource& source);

}  // namespace mapproof
