#pragma once

#include "core/graph/neighbours.hpp"
#include "core/model/embedding.hpp"

namespace mapproof {

/// Laplacian eigenmap with weights 0 and 1: the two smallest solutions of L v = lambda D v beside
/// the constant, with D the degrees and L = D - A [belkin2003].
///
/// @param graph  Of n >= 3 nodes, undirected, in one piece; lengths do not count.
/// @return Columns with v'Dv = 1; statuses as of bottom_eigenmap. The spectrum holds lambda.
/// @throws InvalidInput if there are fewer than 3 nodes, or one without an edge.
/// @note O(edges) time beside that of the eigenvalues.
Embedding laplacian_eigenmap(const Graph& graph);

}  // namespace mapproof
