#pragma once

#include <optional>

#include "core/embed/sde/lagrangian.hpp"
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

  /// (b_k' P b_l)(b_k' Q b_l), on and below the diagonal, P and Q symmetric: the matrix of the
  /// pairs after Newton's other unknowns are eliminated.
  void schur(const Eigen::MatrixXd& P, const Eigen::MatrixXd& Q, Eigen::MatrixXd& S);

 private:
  Pair ends(Eigen::Index k) const {
    const auto& [i, j] = problem_.pairs[static_cast<std::size_t>(k)];
    return {i - 1, j - 1};
  }

  void differences(const Eigen::MatrixXd& P, Eigen::Index first, Eigen::Index count,
                   Eigen::MatrixXd& out) const;

  const Problem& problem_;
  Eigen::Index n_;
  Eigen::MatrixXd C_;
  Eigen::MatrixXd p_, q_;  ///< Differences of some pairs, kept from one matrix to the next.
};

/// How far (Y, w) is from optimal, apart from the sign of the slack.
struct KktResiduals {
  double pairs = 0.0;     ///< Norm of the violated distances.
  double gradient = 0.0;  ///< Norm of the slack times Y.

  double sum() const { return pairs + gradient; }
};

KktResiduals kkt_residuals(const Problem& problem, const Rows& Y, const Eigen::VectorXd& w);

/// A change of (Y, w).
struct KktStep {
  Rows Y;
  Eigen::VectorXd w;
};

/// The Newton step on (slack(w) Y, residuals(Y)) = 0, the slack shifted just far enough to be
/// positive definite. Eliminating Y leaves a dense system in w. Steps
/// converge quadratically once the rank of Y is that of the solution.
/// @return Empty if the system could not be solved.
/// @note O(m^3 / 3) time and O(m^2) memory for m pairs.
std::optional<KktStep> kkt_newton_step(const Problem& problem, const Rows& Y,
                                       const Eigen::VectorXd& w);

/// Up to here the interior point's matrix of pairs squared is made: 800 MB for each thread that
/// solves. K = 7 keeps 9 pairs a landmark.
inline constexpr Eigen::Index kMostInteriorPairs = 10'000;

/// When to stop.
/// What is requested; the steps stop at a part of it (see interior_point.cpp).
struct InteriorPointOptions {
  double relative_gap;
  double constraint_residual;
  int max_iterations = 60;
};

/// Solves by a primal-dual interior point with predictor and corrector steps [helmberg1996].
///
/// The first point is held at the origin, which leaves the feasible set an interior. All iterates
/// are dual feasible, so that each certifies a bound. A constraint is b'K b with b = e_i - e_j, so
/// the Schur complement's entries are (b_k'X b_l)(b_k'Z^-1 b_l): its Cholesky factor dominates the
/// cost, and is used for several corrections of a step.
///
/// @param gram  points x points: inner products the pairs' distances nearly follow from.
/// @return The last iterate, whether or not it meets the options.
/// @note O(m^3 / 3 + n^3) time an iteration, O(m^2) memory for m pairs. Deterministic.
CertifiedSolution solve_by_interior_point(const Problem& problem, const Eigen::MatrixXd& gram,
                                          const InteriorPointOptions& requested);

}  // namespace mapproof::unfolding
