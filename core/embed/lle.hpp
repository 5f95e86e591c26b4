#pragma once

#include <Eigen/Core>

#include "core/graph/neighbours.hpp"
#include "core/model/embedding.hpp"

namespace mapproof {

struct LleOptions {
  /// Added to the diagonal of each local Gram matrix, as a share of its trace, > 0: with more
  /// neighbours than dimensions the weights would not be unique.
  double regularization = 1e-3;
};

/// Locally linear embedding: the map in which the weights that blend each landmark from its
/// neighbours in the data blend it best, too [roweis2000].
///
/// @param squared_distances  n x n, symmetric, zero diagonal, finite, n >= 3.
/// @param neighbours  Those of each landmark (see nearest_neighbours), one at least, in one piece.
/// @return Columns of length 1; statuses as of bottom_eigenmap, kRankDeficient if in every
///         neighbourhood the data spread in one direction alone, and kNotEuclidean if in some no
///         points have such distances: the negative eigenvalues of their Gram matrix are cut.
/// @throws InvalidInput if the bounds above are broken.
/// @note O(n K^3) time beside that of the eigenvalues.
Embedding lle(const Eigen::MatrixXd& squared_distances, const NeighbourLists& neighbours,
              const LleOptions& options = {});

}  // namespace mapproof
