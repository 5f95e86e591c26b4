#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/model/status.hpp"

namespace mapproof {

/// The coordinates that a metric upgrade takes states from, and the quadric that fixed them.
struct UpgradeTransform {
  Eigen::MatrixXd S;                ///< n x n: whitened states = S X; zero if there is none.
  Eigen::MatrixXd Q;                ///< The quadric, scaled so that S' Q S is the cone.
  Eigen::VectorXd monomial_values;  ///< Singular values of the monomials, descending.
  double condition = 1.0;           ///< Largest of them over the least that must not vanish.
  std::vector<Status> statuses;     ///< Empty if all went well.
};

/// Share of the largest singular value of the monomials at or below which another is rounding: of
/// the monomials themselves, and of a root of their moments, which squared them.
inline constexpr double kMonomialRounding = 1e-10;
inline constexpr double kMomentRounding = 1e-7;

/// What metric_upgrade() does, from moments of whitened states alone (mean square I), which a
/// stream of steps can keep. States have n = d + 2 entries, in the plane 4 and in space 5.
/// @param U          N x n, n >= 4: the other side's factor, against whitened states.
/// @param mean       Mean of the whitened states.
/// @param monomials  R with R'R = sum of outer products of the states' quadratic_monomials() (or
///                   these rows themselves); n (n + 1) / 2 columns.
/// @param rounding   kMonomialRounding or kMomentRounding, as R was made.
/// @return kDegenerateGeometry and S = 0 where no quadric of the cone's signature fits;
///         kUndetermined where another quadric fits nearly as well.
/// @throws InvalidInput if the sizes break these bounds, or a number is not finite.
/// @note O(N + R) time for R rows.
UpgradeTransform upgrade_transform(const Eigen::MatrixXd& U, const Eigen::VectorXd& mean,
                                   const Eigen::MatrixXd& monomials,
                                   double rounding = kMonomialRounding);

}  // namespace mapproof
