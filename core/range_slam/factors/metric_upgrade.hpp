#pragma once

#include <Eigen/Core>

#include "core/range_slam/factors/factorization.hpp"
#include "core/range_slam/factors/spectral_map.hpp"

namespace mapproof {

/// Whose states the quadric is fitted to.
enum class UpgradeSide {
  kPoses,      ///< 8 steps or more, 4 landmarks or more; in space 13 and 5.
  kLandmarks,  ///< The same the other way round, as the paper has it.
};

/// Points and the quadric through them, [p' 1] Q [p' 1]' = 0: in space for a map of the plane, one
/// dimension higher for a map of space.
struct QuadricCloud {
  Eigen::MatrixXd points;  ///< T x (d + 1).
  Eigen::MatrixXd Q;       ///< (d + 2) x (d + 2).
};

/// A map defined up to a rigid motion and a reflection, and the quadric that fixed it.
struct MetricUpgrade {
  SpectralMap map;
  Eigen::MatrixXd S;  ///< V = S X; empty if no map came out.
  /// Of the whitened monomials, descending: the last is the misfit of the quadric, the last but one
  /// separates it from the next best.
  Eigen::VectorXd monomial_values;
  QuadricCloud before;  ///< Whitened states of the fitted side in their plane of scale 1.
  QuadricCloud after;   ///< The same as (p, |p|^2/2), on the paraboloid.
};

/// Map and path with no landmark known, in closed form: a quadric is fitted to the states and its
/// coordinates changed so that it becomes the cone of state_cone() [boots2013, section 2]. In space
/// states have one entry more, and all else is the same.
///
/// Where a pencil of quadrics fits, of 8 states (in space 13) or of a path along a conic (a
/// quadric), the one is taken whose dual vanishes on the plane of scale 1 or on a state of the
/// other side, and of those the one that the other side fits best.
/// @param factors  Of rank 4, for a map of the plane, or 5, for one of space.
/// @return An empty map with kTooFewObservations below the side's bounds, and with
///         kDegenerateGeometry where no quadric of the cone's signature fits; kUndetermined with
///         a map where another quadric fits nearly as well. `condition` is the largest over the
///         least of the monomials' singular values that must not vanish.
/// @throws InvalidInput unless the rank is 4 or 5.
/// @note O(T) time.
MetricUpgrade metric_upgrade(const Factorization& factors, UpgradeSide side = UpgradeSide::kPoses);

}  // namespace mapproof
