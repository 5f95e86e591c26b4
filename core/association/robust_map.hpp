#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/association/log_blocks.hpp"
#include "core/model/points.hpp"

namespace mapproof {

/// What the scans of one block measured of one pair: the median of its distances.
struct PairItem {
  int first = 0;  ///< Landmarks, first < second.
  int second = 0;
  int block = 0;
  double distance_m = 0.0;
  double weight = 0.0;  ///< Scans, at most `PairItemOptions::most_scans`.
};

/// The medians of a log's pairs, block by block, under the given IDs.
/// @param ids  The landmark ID of each detection; pairs of one landmark with itself are left
///         out.
/// @param most_scans  Scans beyond which a block gives a pair no more weight: a robot that stands
///         still repeats the same measurements.
/// @note O(P log P) time for P pairs.
std::vector<PairItem> pair_items(const std::vector<ScanPair>& pairs, const std::vector<int>& ids,
                                 const LogBlocks& blocks, double most_scans = 10.0);

/// Half the square up to `width`, linear beyond: the cost of a residual [huber1964].
double huber_cost(double residual, double width);

/// A robust map of measured pairs, some of which may be wrong, and its cost.
struct RobustMap {
  Points positions_m;  ///< M x 2, defined up to translation, rotation and reflection; NaN rows: no
                       ///< pairs tie them to the others.
  double width_m = 0.0;  ///< Of Huber's cost: 1.5 standard deviations of the residuals.
  double cost = 0.0;     ///< Sum of weight * huber_cost, m^2.
  double loss_m = 0.0;   ///< sqrt(2 cost / sum of weights): root mean square of the residuals with
                         ///< outliers clipped.
};

/// 1.5 standard deviations of the items' residuals in a map by their median, never zero.
double width_of(const std::vector<PairItem>& items, const Points& map);

/// The variance of a pair's residuals that the width of the map's cost stands for.
double residual_variance(const RobustMap& map);

/// Without a start: shortest paths over the medians, classical scaling, least Huber cost by
/// majorised and reweighted stress. The width comes from the residuals' median.
/// @throws InvalidInput if landmarks > 2000, or an item names none of them.
/// @note O(M^3) time.
RobustMap robust_map(const std::vector<PairItem>& items, int landmarks);

/// From a start, at a given width: the cost falls in each round, or stays.
/// @param start  M x 2; rows with NaN are mapped only if they have a position there.
/// @param rounds  At most so many reweightings.
RobustMap minimized_map(const std::vector<PairItem>& items, const Points& start, double width_m,
                        int rounds = 40);

/// What the items cost in a map; items of unmapped landmarks cost nothing.
double map_cost(const std::vector<PairItem>& items, const Points& map, double width_m);

}  // namespace mapproof
