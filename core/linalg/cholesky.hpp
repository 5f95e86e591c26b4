#pragma once

#include <Eigen/Core>

#include "core/linalg/packed_product.hpp"

namespace mapproof {

/// Replaces the lower half of A by its Cholesky factor L, A = L L'; the other half is left alone.
///
/// By columns of blocks where they fit the cache, recursive above that; on multiply_tile(): same
/// bits on all processors.
/// @param A  n x n, symmetric (the lower half is read).
/// @return False if A is not positive definite to working precision or not finite: A is then
///         spoilt.
/// @note n^3 / 6 multiplications and additions.
[[nodiscard]] bool factor_cholesky(Block A);

/// The solution x of L L' x = b.
Eigen::VectorXd solve_cholesky(const Eigen::MatrixXd& L, const Eigen::VectorXd& b);

/// L^-1 of a lower triangular L, whose other half is not read; the result's other half is zero.
/// @note n^3 / 6 multiplications and additions; same bits on all processors.
Eigen::MatrixXd inverse_of_lower(const Eigen::MatrixXd& L);

/// y = A x, each entry summed in the order of the columns: same bits on all processors.
/// @param x  As long as A has columns, contiguous.
/// @param y  As long as A has rows.
void multiply(const Eigen::MatrixXd& A, const Eigen::VectorXd& x, Eigen::VectorXd& y);

/// A positive definite matrix, with the inverse of its Cholesky factor.
class Definite {
 public:
  /// @param A  n x n, symmetric.
  /// @return False, and nothing changes, if A is not positive definite to working precision.
  /// @note O(n^3) time.
  [[nodiscard]] bool set(Eigen::MatrixXd A);

  bool is_set() const { return matrix_.size() > 0; }
  const Eigen::MatrixXd& matrix() const { return matrix_; }
  Eigen::MatrixXd inverse() const;

  /// L^-1 D L'^-1 v for the factor L of the matrix.
  Eigen::VectorXd scaled(const Eigen::MatrixXd& D, const Eigen::VectorXd& v) const;

 private:
  Eigen::MatrixXd matrix_;
  Eigen::MatrixXd inverse_factor_;
  Eigen::MatrixXd transposed_;  ///< The inverse factor's transpose: products go down its columns.
};

/// The smallest eigenvalue of L^-1 D L'^-1, for A = L L': A + t D is positive definite for all t
/// from 0 to 1 exactly if it is above -1.
///
/// By Lanczos' method with a fixed start [lanczos1950], less what its last steps still changed.
/// @param D  Symmetric, as large as A.
/// @return To half a percent, or to 0.005 if it is smaller than 1; minus infinity if D is not
///         finite.
/// @note O(n^2) time a step, some 10 to 30 of them. Deterministic.
double smallest_eigenvalue(const Definite& A, const Eigen::MatrixXd& D);

}  // namespace mapproof
