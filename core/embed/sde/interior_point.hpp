#pragma once

#include "core/embed/sde/problem.hpp"

namespace mapproof::unfolding {

/// Up to here the interior point's matrix of pairs squared is made: 200 MB for each thread that
/// solves. K = 7 keeps 9 pairs a
/// landmark.
inline constexpr Eigen::Index kMostInteriorPairs = 5000;

/// When to stop.
struct InteriorPointOptions {
  double relative_gap = 1e-8;
  double constraint_residual = 1e-8;
  int max_iterations = 60;
};

/// Solves by a primal-dual interior point with predictor and corrector steps [helmberg1996].
///
/// The first point is held at the origin, which leaves the feasible set an interior. All iterates
/// are dual feasible, so that each proves a bound. A constraint is b'K b with b = e_i - e_j, so the
/// Schur complement's entries are (b_k'X b_l)(b_k'Z^-1 b_l): its Cholesky factor is the work, and
/// is used for several corrections of a step.
///
/// @param gram  points x points: inner products the pairs' distances nearly follow from.
/// @return The last iterate, whether or not it meets the options.
/// @note O(m^3 / 3 + n^3) time an iteration, O(m^2) memory for m pairs. Deterministic.
ProvedSolution solve_by_interior_point(const Problem& problem, const Eigen::MatrixXd& gram,
                                       const InteriorPointOptions& options = {});

}  // namespace mapproof::unfolding
