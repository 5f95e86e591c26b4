#pragma once

#include <vector>

#include "render/plot/figure.hpp"
#include "reports/sections/figures/figure_source.hpp"

namespace mapproof {

/// The paper's figures of one kind.
std::vector<Figure> idea_figures(FigureSource& source);

std::vector<Figure> measurement_figures(FigureSource& source);

}  // namespace mapproof
