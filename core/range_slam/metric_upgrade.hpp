#pragma once

#include <Eigen/Core>

#include "core/range_slam/factorization.hpp"
#include "core/range_slam/spectral_map.hpp"

namespace mapproof {

/// Whose states the quadric is fitted to.
enum class UpgradeSide {
  kPoses,      ///< 8 steps or more, 4 landmarks or more.
  kLandmarks,  ///< 8 landmarks or more, 4 steps or more, as the paper has it.
};

/// Points in space and the quadric through them, [p' 1] Q [p' 1]' = 0.
struct QuadricCloud {
  Eigen::Matrix<double, Eigen::Dynamic, 3> points;
  Eigen::Matrix4d Q = Eigen::Matrix4d::Zero();
};

/// A map known up to a motion and a mirror, and the quadric that fixed it.
struct MetricUpgrade {
  SpectralMap map;
  Eigen::Matrix4d S = Eigen::Matrix4d::Zero();  ///< V = S X.
  /// Ten, of the whitened monomials, descending: the last is the misfit of the quadric, the last
  /// but one what tells it from another.
  Eigen::VectorXd monomial_values;
  QuadricCloud before;  ///< Whitened states of the fitted side in their plane of scale 1.
  QuadricCloud after;   ///< The same as (x, y, (x^2 + y^2)/2), on the paraboloid.
};

/// Map and path with no landmark known, in closed form: a quadric is fitted to the states and its
/// coordinates changed so that it becomes the cone of state_cone() [boots2013, section 2].
///
/// Where a pencil of quadrics fits, of 8 states or of a path along a conic, the one is taken whose
/// dual vanishes on the plane of scale 1 or on a state of the other side, and of those the one that
/// the other side fits best.
/// @param factors  Of rank 4.
/// @return An empty map with kTooFewObservations below the side's bounds, and with
///         kDegenerateGeometry where no quadric of the cone's signature fits; kUndetermined beside
///         a map where another quadric fits nearly as well. `condition` is the largest over the
///         least of the monomials' singular values that must not vanish.
/// @throws InvalidInput unless the rank is 4.
/// @note O(T) time.
MetricUpgrade metric_upgrade(const Factorization& factors, UpgradeSide side = UpgradeSide::kPoses);

}  // namespace mapproof
