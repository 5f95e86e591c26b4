#pragma once

#include <Eigen/Core>

#include "core/graph/neighbours.hpp"
#include "core/model/embedding.hpp"

namespace mapproof {

/// ISOMAP: classical scaling of the shortest paths in the neighbour graph [tenenbaum2000].
///
/// @param distances  n x n, symmetric, zero diagonal, entries >= 0; infinite entries are not edges.
/// @return kBridged if the graph was in pieces and had to be joined by its shortest bridges;
///         kFailed, with NaN coordinates, if no finite bridge exists.
/// @throws InvalidInput if K is not in [1, n) or n < 3.
/// @note O(n^2 K log n + n^3) time.
Embedding isomap(const Eigen::MatrixXd& distances, const NeighbourOptions& options);

/// The same of a graph of n >= 3 nodes that is in one piece.
Embedding isomap(const Graph& graph);

}  // namespace mapproof
