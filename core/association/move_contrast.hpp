#pragma once

#include <vector>

#include "core/association/log_blocks.hpp"
#include "core/association/robust_map.hpp"

namespace mapproof {

/// The shift of one landmark's position at some time, compared with how far the errors of the scans
/// shift it in parts of the log.
struct MoveContrast {
  int landmark = 0;
  double statistic = 0.0;  ///< Squared shift over its variance, the greatest over all times.
  int clusters = 0;        ///< Of scans, whose scatter the variance is estimated from.
  double shift_m = 0.0;    ///< At that time,
  int slice = 0;           ///< which is the beginning of this slice.
};

/// Below so many clusters, as in the log of one robot, a contrast is worth less.
inline constexpr int kManyClusters = 20;

/// The contrast of each mapped landmark with enough pairs, in the order of the landmarks.
///
/// The positions before and after a time are those of least Huber cost, linearized at the map's.
/// Their variance is estimated from the sums of the scores in clusters of scans, one robot's over a
/// tenth of the time each [liang1986]: within a cluster errors may be correlated as they like.
/// @note O(pairs times) for each landmark, times being the slices of the blocks.
std::vector<MoveContrast> move_contrasts(const std::vector<PairItem>& items, const RobustMap& map,
                                         const LogBlocks& blocks);

/// By how much a contrast exceeds that of the median landmark, over the bound that holds for its
/// number of clusters: above 1 it is a move. 0 for fewer than 8 clusters.
///
/// The bounds, 8 from 20 clusters on and 20 below, are set on the logs of sets 2 and 3 of MRCLAM,
/// in which nothing moved (docs/methods/moved-landmarks.md).
double contrast_ratio(const std::vector<MoveContrast>& all, int landmark);

}  // namespace mapproof
