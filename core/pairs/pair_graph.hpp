#pragma once

#include <cstddef>
#include <vector>

#include "core/graph/neighbours.hpp"
#include "core/pairs/pair_distances.hpp"

namespace mapproof {

inline constexpr int kPairsToPlace = 3;  ///< Two leave a landmark its mirror image.

/// Of each pair: it was seen in so many scans, or one of its landmarks has too few that were.
std::vector<bool> are_trusted(const std::vector<MeasuredPair>& pairs, std::size_t landmarks,
                              int fewest_scans);

/// The pairs as edges as long as they were measured; edges ascend.
Graph graph_of(const std::vector<MeasuredPair>& pairs, std::size_t landmarks);

}  // namespace mapproof
