#pragma once

#include <vector>

#include "reports/sections/results/results_comparison.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {

/// One group of figures per block, by the id of the block: of each quantity a curve over a factor
/// of numbers, else the distribution over runs; of comparisons of three methods or more, their mean
/// ranks with the critical difference.
StudyFigures results_figures(const ResultsView& view,
                             const std::vector<MethodComparison>& comparisons);

}  // namespace mapproof
