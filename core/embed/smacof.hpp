#pragma once

#include <Eigen/Core>

#include "core/model/embedding.hpp"

namespace mapproof {

/// When to stop minimizing the stress.
struct SmacofOptions {
  /// Stop once one iteration reduces the stress by less than this share of it, >= 0.
  double relative_fall = 1e-7;
  int max_iterations = 1000;  ///< >= 1.
};

/// Least raw stress sum_{i<j} w_ij (delta_ij - |z_i - z_j|)^2 by majorisation [deleeuw1977;
/// yairi2007, eq. 6].
///
/// @param distances  n x n, symmetric, zero diagonal, finite.
/// @param weights    n x n, symmetric, finite, >= 0, connecting all landmarks; empty: all equal to
///                   one.
/// @param start      n x 2, finite.
/// @return The stress is given as a share of sum w_ij delta_ij^2. kNotConverged if the limit of
///         iterations came first; kRankDeficient if the map is flat (see planarity.hpp), as it is
///         from a flat start.
/// @throws InvalidInput if the bounds above are broken, those of `options` among them.
/// @note O(n^2) time an iteration; with weights that of the pairs that have one, and a sparse
/// solve.
Embedding smacof(const Eigen::MatrixXd& distances, const Eigen::MatrixXd& weights,
                 const Points& start, const SmacofOptions& options = {});

}  // namespace mapproof
