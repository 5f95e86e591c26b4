#pragma once

#include <vector>

#include "core/association/robust_map.hpp"
#include "core/association/stretch_search.hpp"

namespace mapproof {

/// The mapped IDs whose items cost most, ascending.
std::vector<int> costly_ids(const std::vector<PairItem>& items, const RobustMap& map,
                            std::size_t most);

/// The most promising wrong data associations over one stretch of blocks, judged in a map: all
/// pairs of the 40 IDs that cost most, all stretches, both landmarks where on a grid they cost
/// least while the others stay.
/// @param most  How many hypotheses, of different IDs or type or order.
/// @return Descending by gain, all gains > 0.
/// @note For L IDs: O(L^2 blocks^2) grids of 400 points.
std::vector<AssociationHypothesis> hypotheses_in_map(const std::vector<PairItem>& items,
                                                     const RobustMap& map, const LogBlocks& blocks,
                                                     std::size_t most);

/// The same judged by the distances alone, with each ID's distance to each other one as constant as
/// possible over all blocks. For maps that wrong IDs have folded; it needs pairs seen both within
/// the stretch and outside.
/// @note For L IDs: O(L^2 blocks^2) rows of 32 distances for each of M landmarks.
std::vector<AssociationHypothesis> hypotheses_of_distances(const std::vector<PairItem>& items,
                                                           const RobustMap& map,
                                                           const LogBlocks& blocks,
                                                           std::size_t most);

}  // namespace mapproof
