#pragma once

#include <span>
#include <vector>

#include "render/plot/figure.hpp"
#include "reports/sections/figures/figure_source.hpp"

namespace mapproof {

/// Mean ranks, distances and eigenvalues of the methods.
std::vector<Figure> comparison_figures(FigureSource& source);

/// Error against seconds; varies from run to run.
std::vector<Figure> cost_figures(FigureSource& source, std::span<const Timing> timings);

}  // namespace mapproof
