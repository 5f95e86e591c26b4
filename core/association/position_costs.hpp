#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/association/robust_map.hpp"
#include "core/association/stretch_search.hpp"

namespace mapproof {

/// side^2 points over a map and a quarter of its extent around; NaN rows do not count.
/// @param side  >= 2.
Points grid_over(const Points& map, int side);

/// What the detections under one ID cost in each block, for each position of their landmark on a
/// grid while the others stay: the data association over any stretch of blocks then needs sums
/// alone.
struct PositionCosts {
  Points grid_m;       ///< G x 2, over the map and a quarter of its extent around.
  StretchCosts costs;  ///< Values are the grid's points.
};

/// @param map  Its width is that of the cost; unmapped landmarks are partners of no landmark.
/// @param ids  The IDs to cost, each a row of the map.
/// @param side  Of the grid, points, >= 2.
/// @note O(items * side^2) time; 4 * side^2 * blocks * ids bytes.
PositionCosts position_costs(const std::vector<PairItem>& items, const RobustMap& map, int blocks,
                             const std::vector<int>& ids, int side = 20);

/// Moves each landmark in turn to where it costs least while the others stay, and minimizes the
/// cost of the whole again, as long as that helps: it resolves folds that majorisation alone does
/// not.
RobustMap unfolded_map(const std::vector<PairItem>& items, RobustMap map, int blocks);

}  // namespace mapproof
