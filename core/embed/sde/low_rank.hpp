#pragma once

#include "core/embed/sde/problem.hpp"

namespace mapproof::unfolding {

/// When to stop.
struct LowRankOptions {
  double relative_gap = 1e-6;
  double constraint_residual = 1e-6;
  int max_rounds = 250;  ///< Of the augmented Lagrangian, at most 120 Hessian products each.
  /// The same above kMostDirectPairs: under a minute at 1000 points.
  int max_rounds_of_many_pairs = 80;
};

/// Solves by factors of low rank [burer2003]: rounds of the augmented Lagrangian until the
/// distances fit to some 1e-3, then Newton steps on the conditions of optimality, which double the
/// digits (up to kMostDirectPairs pairs; above that, rounds alone). Columns are added to Y where
/// the dual is infeasible and dropped where they vanish, so the answer is the semidefinite
/// program's.
///
/// @param start  points x any number of columns; the nearer to feasible the better.
/// @return The best that was proved, whether or not it meets the options.
/// @note Deterministic. O(pairs rank) time a product, O(pairs^3) a direct step.
ProvedSolution solve_low_rank(const Problem& problem, const Eigen::MatrixXd& start,
                              const LowRankOptions& options = {});

/// Up to here Newton steps are taken with a dense factorisation.
inline constexpr Eigen::Index kMostDirectPairs = 2500;

}  // namespace mapproof::unfolding
