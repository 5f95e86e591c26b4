#pragma once

#include <optional>
#include <string>

#include "render/plot/figure.hpp"
#include "reports/sections/results/results_view.hpp"

namespace mapproof {

/// Where no factor has numbers: the distribution over runs, a panel per level; of runs that are too
/// few for one, each of them.
std::optional<Figure> distribution_figure(const ResultsView& view, const ResultsBlock& block,
                                          const Quantity& quantity);

/// Why distribution_figure() has no figure, a sentence; empty where it has one.
std::string why_no_distribution(const ResultsView& view, const ResultsBlock& block,
                                const Quantity& quantity);

}  // namespace mapproof
