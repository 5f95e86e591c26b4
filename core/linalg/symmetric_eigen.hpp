#pragma once

#include <Eigen/Core>

namespace mapproof {

/// Some eigenpairs of a symmetric matrix.
struct EigenPairs {
  Eigen::VectorXd values;   ///< k, descending.
  Eigen::MatrixXd vectors;  ///< n x k, orthonormal columns, signs fixed (see sign.hpp).
  bool converged = true;    ///< False: the solver gave up; the pairs are its best.
};

/// The k algebraically largest eigenpairs.
///
/// Dense up to n = 300, above that Lanczos with a fixed start (Spectra), and dense again where
/// that does not converge.
/// @param matrix  n x n, symmetric (the lower half is read), finite.
/// @throws InvalidInput unless 1 <= k <= n and all entries are finite.
/// @note O(n^3) time dense, O(k n^2) an iteration otherwise. Deterministic.
EigenPairs largest_eigenpairs(const Eigen::MatrixXd& matrix, Eigen::Index k);

}  // namespace mapproof
