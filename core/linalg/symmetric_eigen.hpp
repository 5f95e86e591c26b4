#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace mapproof {

/// Some eigenpairs of a symmetric matrix.
struct EigenPairs {
  Eigen::VectorXd values;   ///< k; the first requested one first.
  Eigen::MatrixXd vectors;  ///< n x k, orthonormal columns, signs fixed (see sign.hpp).
  bool converged = true;    ///< False: the solver gave up; the pairs are its best.
};

/// The k algebraically largest eigenpairs, descending.
///
/// Dense up to n = 40 or 8 k, above that Lanczos with a fixed start (Spectra), and dense again
/// where that does not converge or is found to have missed a copy of a multiple eigenvalue.
/// @param matrix  n x n, symmetric (the lower half is read), finite.
/// @throws InvalidInput unless 1 <= k <= n and all entries are finite.
/// @note O(n^3) time dense, O(k n^2) an iteration otherwise. Deterministic.
EigenPairs largest_eigenpairs(const Eigen::MatrixXd& matrix, Eigen::Index k);

/// The k smallest eigenpairs, ascending, apart from a null vector that is known beforehand.
///
/// Dense up to n = 40 or 8 k. Above that Lanczos with a fixed start on the inverse of the matrix
/// shifted off zero, which a sparse Cholesky factor applies; what comes out is judged by its
/// residuals, and dense again where they are above 1e-9 of the matrix.
/// @param matrix       n x n, symmetric, positive semidefinite up to rounding, finite.
/// @param null_vector  n, of length 1, with matrix * null_vector = 0 up to rounding.
/// @return Orthogonal to the null vector.
/// @throws InvalidInput unless 1 <= k < n, sizes agree and all entries are finite.
/// @note O(n^3) time dense; else that of a sparse Cholesky factor and some 40 solves.
/// Deterministic.
EigenPairs smallest_eigenpairs(const Eigen::SparseMatrix<double>& matrix, Eigen::Index k,
                               const Eigen::VectorXd& null_vector);

/// What is requested of leading_eigenpairs(), which takes two numbers.
struct LeadingPairs {
  Eigen::Index exact;  ///< So many eigenvectors have to be exact to rounding,
  Eigen::Index count;  ///< of so many: of the others the span of a few products is enough.
};

/// The largest eigenpairs of a symmetric matrix that has changed little since the last ones.
///
/// Up to 64 rows, or without a start, all eigenpairs are computed. Elsewhere by Rayleigh and Ritz
/// in the span of the start and of its next products [golub1977], from the result again until the
/// first ones are exact; all eigenpairs if that takes too long.
/// @param matrix  n x n, positive semidefinite up to rounding, finite.
/// @param start   n x k, columns orthogonal, none zero: the last eigenvectors, most important
///                first; may have no columns.
/// @return min(count, n) pairs, descending, with orthonormal columns.
/// @note O(n^2 count) time from a good start, O(n^3) otherwise. Deterministic.
EigenPairs leading_eigenpairs(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& start,
                              const LeadingPairs& pairs);

}  // namespace mapproof
