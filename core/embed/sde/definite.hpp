#pragma once

#include <Eigen/Core>

namespace mapproof::unfolding {

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

}  // namespace mapproof::unfolding
