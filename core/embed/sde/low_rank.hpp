#pragma once

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
ProvedSolution solve_low_rank(const Problem& problem, const Eigen::MatrixXd& start,
                              const LowRankOptions& options = {});

}  // namespace mapproof::unfolding
