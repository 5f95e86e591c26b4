#pragma once

#include <optional>
#include <string>

#include "render/plot/figure.hpp"
#include "reports/sections/results/results_view.hpp"

namespace mapproof {

/// A quantity over the numbers of the block's factor, a curve per method; nothing if all its values
/// are the same.
std::optional<Figure> curve_figure(const ResultsView& view, const ResultsBlock& block,
                                   const Quantity& quantity);

/// The curves of several blocks, a panel each on one y axis.
std::optional<Figure> overview_figure(const ResultsView& view, const ResultsOverview& overview,
                                      const Quantity& quantity);

/// Why curve_figure() has no figure, a sentence; empty where it has one.
std::string why_no_curve(const ResultsView& view, const ResultsBlock& block,
                         const Quantity& quantity);

}  // namespace mapproof
