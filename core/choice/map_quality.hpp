#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/model/experiment.hpp"
#include "core/model/points.hpp"

namespace mapproof {

/// How well a map keeps distances, n x n, symmetric, zero diagonal, >= 0; infinite ones (pairs
/// without a common step) count in ranks as farther than all others and nowhere else.
/// All are O(n^2 log n) at most.

/// sum (delta - s d)^2 / sum delta^2 with the best scale s, in [0, 1]; 1 for a map that is a point.
double normalised_stress(const Eigen::MatrixXd& distances, const Points& map);

/// 1 - R^2 of the distances and the map's, in [0, 1] [tenenbaum2000]; 1 where either does not vary.
double residual_variance(const Eigen::MatrixXd& distances, const Points& map);

/// Shares of neighbourhoods kept [venna2001], 1 at best.
struct NeighbourhoodsKept {
  double trustworthiness = 0.0;  ///< 1 less what the map adds to the `neighbours` nearest of each.
  double continuity = 0.0;       ///< 1 less what the map drops from them.
};

/// Equal distances have their mean rank, so that the order of rows does not matter.
/// @param neighbours  1 <= neighbours < n / 2.
/// @throws InvalidInput for another number of neighbours.
NeighbourhoodsKept neighbourhoods_kept(const Eigen::MatrixXd& distances, const Points& map,
                                       int neighbours);

/// How far each anchor on the map is from its position under an affine map fitted to the others:
/// the mean, m.
/// @param anchors_m  Read at the rows `anchors` alone.
/// @return NaN with fewer than four such anchors, or where the others never span the plane.
double anchors_left_out(const Points& map, const Points& anchors_m,
                        const std::vector<Eigen::Index>& anchors, AffineFit fit);

}  // namespace mapproof
