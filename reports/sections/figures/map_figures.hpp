#pragma once

#include <vector>

#include "render/plot/figure.hpp"
#include "reports/sections/figures/figure_source.hpp"

namespace mapproof {

/// The run nearest to the paper's example beside the median run; then each method's median run.
std::vector<Figure> map_figures(FigureSource& source);

/// A map forming over the steps, and what scatters between the runs of one layout.
std::vector<Figure> forming_figures(FigureSource& source);

}  // namespace mapproof
