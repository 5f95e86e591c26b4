#pragma once

#include <functional>

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

/// A symmetric, positive semidefinite matrix of which only products are known: V to A V, n x k.
using BlockProduct = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& V)>;

/// The largest eigenpairs of such a matrix, from a fixed start of eight vectors.
///
/// By block Lanczos with full orthogonalisation and Ritz's values over the whole span [golub1977],
/// from the leading vectors again after twelve products. Copies of an eigenvalue are found up to
/// eight times.
/// @param n  Rows of the matrix, >= 96.
/// @param pairs  At most eight exact ones, at most 16 in all.
/// @return As many pairs, descending; the values that need not be exact are so to 1e-5 of the
///         first. `converged` is false if that is not reached after 96 products.
/// @note Mostly six to eight products with eight vectors. Deterministic.
EigenPairs largest_eigenpairs(const BlockProduct& product, Eigen::Index n,
                              const LeadingPairs& pairs);

/// X X' V.
/// @param X  n x c.
/// @param V  n x 8.
/// @note Reads X once, 16 n c multiplications and additions; same bits on all processors.
Eigen::MatrixXd gram_product(const Eigen::MatrixXd& X, const Eigen::MatrixXd& V);

/// A V, of which A is read once.
/// @param A  n x n.
/// @param V  n x 8.
/// @note 8 n^2 multiplications and additions; same bits on all processors.
Eigen::MatrixXd product_of_eight(const Eigen::MatrixXd& A, const Eigen::MatrixXd& V);

}  // namespace mapproof
