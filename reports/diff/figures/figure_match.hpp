#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "reports/diff/figures/figure_layers.hpp"

namespace mapproof {

/// A layer or point of the baseline and its counterpart in the current; one side is empty if there
/// is none.
struct Match {
  std::optional<std::size_t> baseline;
  std::optional<std::size_t> current;
};

/// Matches layers by equal value, then by kind, label and mark, then by kind alone, in order. The
/// layers of the baseline come first, in their order.
std::vector<Match> match_layers(const std::vector<Layer>& baseline,
                                const std::vector<Layer>& current);

/// Matches points by the id of their marks or by their text where these are unique; else by index,
/// equal points at both ends first, so that one lost point is one difference.
std::vector<Match> match_points(const LayerView& baseline, const LayerView& current);

/// Whether a point of each layer has the same coordinates, NaN included.
bool have_equal_coordinates(const LayerView& a, std::size_t i, const LayerView& b, std::size_t j);

}  // namespace mapproof
