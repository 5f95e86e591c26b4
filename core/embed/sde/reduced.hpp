#pragma once

#include "core/embed/sde/problem.hpp"

namespace mapproof::unfolding {

/// The program with the first point held at the origin, which leaves the feasible set an interior:
///
///   max <C, X>  s.t.  b_k' X b_k = squared_k,  X psd;    min w'squared  s.t.  L(w) - C psd,
///
/// in the inner products X of the other points, where b_k = e_i - e_j (e_j, if i is the origin) and
/// L(w) = sum of w_k b_k b_k'.
class Reduced {
 public:
  /// @param problem  Has to outlive this; of two points or more.
  explicit Reduced(const Problem& problem);

  Eigen::Index size() const { return n_; }
  Eigen::Index pairs() const { return problem_.squared.size(); }
  const Eigen::MatrixXd& C() const { return C_; }
  const Eigen::VectorXd& squared() const { return problem_.squared; }

  /// b_k' P b_k per pair; P may be unsymmetric.
  Eigen::VectorXd along_pairs(const Eigen::MatrixXd& P) const;

  Eigen::MatrixXd laplacian(const Eigen::VectorXd& w) const;

  /// P L(w).
  /// @note O(pairs size) time: the Laplacian is sparse.
  Eigen::MatrixXd times_laplacian(const Eigen::MatrixXd& P, const Eigen::VectorXd& w) const;

  /// (b_k' P b_l)(b_k' Q b_l), on and below the diagonal, P and Q symmetric: the matrix of the
  /// pairs after Newton's other unknowns are eliminated.
  void schur(const Eigen::MatrixXd& P, const Eigen::MatrixXd& Q, Eigen::MatrixXd& S) const;

 private:
  Pair ends(Eigen::Index k) const {
    const auto& [i, j] = problem_.pairs[static_cast<std::size_t>(k)];
    return {i - 1, j - 1};
  }

  const Problem& problem_;
  Eigen::Index n_;
  Eigen::MatrixXd C_;
};

}  // namespace mapproof::unfolding
