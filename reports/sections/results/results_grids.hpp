#pragma once

#include "reports/sections/results/results_view.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {

/// The group of heat maps of a setup whose conditions differ in two factors of numbers: one per
/// quantity and method, the factor with more levels across. Its id is the setup's and "grid"; it is
/// empty for other setups, and where runs are not repeats of each other.
FigureGroup heat_maps(const ResultsView& view, const Label& setup);

}  // namespace mapproof
