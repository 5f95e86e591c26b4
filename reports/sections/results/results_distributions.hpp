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

/// Where no factor has numbers: the mean of each method with its interval, or of few groups with
/// the runs, in the order of methods and a panel per level. Nothing of more levels than have room.
std::optional<Figure> means_figure(const ResultsView& view, const ResultsBlock& block,
                                   const Quantity& quantity);

/// Why distribution_figure() has no figure, a sentence; empty where it has one.
std::string why_no_distribution(const ResultsView& view, const ResultsBlock& block,
                                const Quantity& quantity);

}  // namespace mapproof
