#pragma once

#include <Eigen/Core>

#include "core/linalg/planarity.hpp"
#include "core/model/experiment.hpp"
#include "core/model/points.hpp"

namespace mapproof {

/// z -> z * linear + offset, points as rows.
struct Affine {
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  Eigen::RowVector2d offset = Eigen::RowVector2d::Zero();

  Points operator()(const Points& points) const { return (points * linear).rowwise() + offset; }
};

/// The affine map that takes `from` closest to `to` [yairi2007, section 3, step 4].
///
/// kLeastDistances: through 4 points exact, in closed form (it meets 3 of them); through more, by
/// iteratively reweighted least squares from the least-squares solution, to about 1e-6 of the sum.
/// @param from, to  n x 2, finite, n >= 3; `from` not on one line (planarity > 1e-9).
/// @throws InvalidInput if the bounds above are broken.
Affine fit_affine(const Points& from, const Points& to, AffineFit fit);

}  // namespace mapproof
