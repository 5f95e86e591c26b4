#pragma once

#include <string>
#include <vector>

#include "reports/model/report.hpp"
#include "reports/sections/results/results_comparison.hpp"
#include "reports/sections/results/results_view.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {

/// The heat maps of setups with two factors of numbers, then one group of figures per overview and
/// block, by their ids. Of an overview the curves of its blocks beside each other. Of a block of
/// each quantity a curve over a factor of numbers, else the distribution over runs; of comparisons
/// of three methods or more, their mean ranks with the critical difference. Where runs are data
/// sets and no repeats, of a block without an axis the methods' values by data set, of the quantity
/// that the study judges by first.
StudyFigures results_figures(const ResultsView& view,
                             const std::vector<MethodComparison>& comparisons);

/// The ids of what results_figures() may have of a quantity, the best view of it first: overviews,
/// then blocks.
std::vector<std::string> figures_of_quantity(const ResultsView& view, const std::string& quantity);

/// The group of heat maps of a setup whose conditions differ in two factors of numbers: one per
/// quantity and method, the factor with more levels across. It is empty for other setups, and where
/// runs are not repeats of each other.
FigureGroup heat_maps(const ResultsView& view, const Label& setup);

/// The id of that group, and of its section.
std::string heat_maps_id(const ResultsView& view, const std::string& setup);

/// Why results_figures() has no figure of a quantity of a block, a sentence; empty where it has
/// one, and where runs are not repeats of each other and there is no axis for a curve.
std::string why_no_figure(const ResultsView& view, const ResultsBlock& block,
                          const Quantity& quantity);

}  // namespace mapproof
