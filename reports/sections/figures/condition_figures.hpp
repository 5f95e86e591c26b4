#pragma once

#include <vector>

#include "render/plot/figure.hpp"
#include "reports/sections/figures/figure_source.hpp"

namespace mapproof {

/// What the experiment's variations show, and how often occlusion decided.
std::vector<Figure> condition_figures(FigureSource& source);

}  // namespace mapproof
