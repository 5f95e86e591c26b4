#pragma once

#include <Eigen/Core>

namespace mapproof {

/// Canonical angles between the column spaces of A and B, ascending, in [0, pi/2] rad: small ones
/// by their sine, large ones by their cosine, so that all are accurate.
/// @param A, B  n x k with independent columns, finite, k <= n.
/// @throws InvalidInput if a bound is broken.
Eigen::VectorXd canonical_angles(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// The bound on the sine of the largest canonical angle between the learned subspace and the true
/// one, N c sqrt(2 log(T) / T) / gamma [boots2013, eq. 5]; it falls as T^-1/2, so that an error
/// zeta takes some 1 / zeta^2 steps.
/// @param landmarks            N >= 1.
/// @param steps                T >= 2.
/// @param noise_constant       c, of the distribution of errors, >= 0.
/// @param smallest_eigenvalue  gamma, the smallest that is not zero of the true covariance Y Y'/T,
///                             > 0, in the unit of c.
/// @throws InvalidInput if a bound is broken.
double subspace_error_bound(Eigen::Index landmarks, Eigen::Index steps, double noise_constant,
                            double smallest_eigenvalue);

}  // namespace mapproof
