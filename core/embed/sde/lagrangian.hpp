#pragma once

#include <vector>

#include "core/embed/sde/problem.hpp"

namespace mapproof::unfolding {

/// When to stop.
struct LowRankOptions {
  double relative_gap = 1e-6;
  double constraint_residual = 1e-6;
  int max_rounds = 80;  ///< Of the augmented Lagrangian, at most 120 Hessian products each.
};

/// Approaches the solution by factors of low rank [burer2003]: rounds of the augmented Lagrangian.
/// Columns are added to Y where the dual is infeasible and dropped where they vanish, so the
/// solution nears the semidefinite program's. For programs that are too large for the interior
/// point: the rounds certify a gap of some 1e-2.
///
/// @param start  points x any number of columns; the nearer to feasible the better.
/// @return The best certified solution, whether or not it meets the options.
/// @note Deterministic. O(pairs rank) time per product, O(points^3) per certificate.
CertifiedSolution solve_low_rank(const Problem& problem, const Eigen::MatrixXd& start,
                                 const LowRankOptions& options = {});

/// One row per point, contiguous: everything here reads pairs of rows.
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Y less its mass-weighted mean.
void centre(const Problem& problem, Rows& Y);

/// |y_i - y_j|^2 - squared_ij, per pair.
Eigen::VectorXd residuals(const Problem& problem, const Rows& Y);

/// (L(w) - M + M11'M / sum) Y, half the Lagrangian's gradient: zero at the optimum.
Rows slack_times(const Problem& problem, const Eigen::VectorXd& w, const Rows& Y);

/// The augmented Lagrangian of the factorised program [burer2003],
///   f(Y) = -variance(Y) + sum w_k c_k + 1/2 sum penalty_k c_k^2,  c_k = |y_i - y_j|^2 - squared_k,
/// with penalty_k = kPenalty / squared_k, so that relative errors of distances weigh the same.
class AugmentedLagrangian {
 public:
  explicit AugmentedLagrangian(const Problem& problem);

  /// Minimizes f from Y by Newton steps, each solved by conjugate gradients, preconditioned by the
  /// points' own blocks. Sets w to the multipliers that the residuals at the new Y suggest.
  /// @note O(pairs rank) time a product; O(points rank^3) once where `refresh` asks for new blocks.
  void descend(Rows& Y, Eigen::VectorXd& w, bool refresh);

  int products() const { return products_; }  ///< Of the Hessian with a vector, so far.

 private:
  double value(const Rows& Y, const Eigen::VectorXd& w, Eigen::VectorXd& c) const;
  Eigen::VectorXd multipliers(const Eigen::VectorXd& w, const Eigen::VectorXd& c) const;
  void hessian_times(const Rows& Y, const Eigen::VectorXd& x, const Rows& V, Rows& out);
  void make_blocks(const Rows& Y, const Eigen::VectorXd& x);
  Rows preconditioned(const Rows& R) const;
  Rows newton_direction(const Rows& Y, const Eigen::VectorXd& x, const Rows& gradient);

  const Problem& problem_;
  Eigen::VectorXd penalty_;
  std::vector<Eigen::MatrixXd> blocks_;  ///< Inverses of the Hessian's diagonal blocks.
  int products_ = 0;
};

}  // namespace mapproof::unfolding
