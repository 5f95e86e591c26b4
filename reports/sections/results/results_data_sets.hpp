#pragma once

#include <optional>
#include <string>

#include "render/plot/figure.hpp"
#include "reports/sections/results/results_view.hpp"

namespace mapproof {

/// The methods' values by data set, of the quantity that the study judges by first; nothing where
/// runs are repeats, and of a single data set or method.
std::optional<Figure> data_sets_figure(const ResultsView& view, const ResultsBlock& block);

/// The id of the figure of a block's values by data set.
std::string data_sets_figure_id(const ResultsBlock& block, const Quantity& quantity);

}  // namespace mapproof
