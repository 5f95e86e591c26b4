#pragma once

#include <Eigen/Core>

#include "core/align/affine.hpp"

namespace mapproof {

/// What may be done to a sub-map to fit it to the others; a mirror image always may.
enum class JoinKind {
  kRigid,       ///< Turn and shift.
  kSimilarity,  ///< And scale: maps whose axes have one scale.
  kAffine,      ///< Any affine map: eigenmaps, whose axes have a scale each.
};

/// The map of that kind that takes `from` closest to `to` in weighted least squares.
/// @param from, to  n x 2, finite, n >= 1.
/// @param weights   n, >= 0, with a positive sum.
/// @return Where the points fix it only in part, one of the best.
Affine fit_join(const Points& from, const Points& to, const Eigen::VectorXd& weights,
                JoinKind kind);

/// The same with less trust in points that fit badly (Huber's weights about the median residual).
/// @param residual  Set to the RMS residual over the RMS radius of `to`, at those weights.
Affine fit_join_robustly(const Points& from, const Points& to, JoinKind kind, double& residual);

/// Huber's weights of residuals: 1 up to some two standard deviations as their median tells them,
/// falling as 1/r beyond.
Eigen::VectorXd huber_weights(const Eigen::VectorXd& residuals, double median);

}  // namespace mapproof
