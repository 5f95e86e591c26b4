#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "reports/diff/figures/figure_layers.hpp"

namespace mapproof {

/// Which layer or point of the baseline is which of the current; one side empty: it has no partner.
struct Match {
  std::optional<std::size_t> baseline;
  std::optional<std::size_t> current;
};

/// Layers by equal value, then by kind, label and mark, then by kind alone, in order. Those of the
/// baseline first, in their order.
std::vector<Match> match_layers(const std::vector<Layer>& baseline,
                                const std::vector<Layer>& current);

/// Points by the id of their marks or by their text where these are unique; else by place in the
/// row, what is equal at both ends first, so that one lost point is one difference.
std::vector<Match> match_points(const LayerView& baseline, const LayerView& current);

}  // namespace mapproof
