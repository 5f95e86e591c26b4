#pragma once

#include <optional>
#include <vector>

#include "core/graph/neighbours.hpp"

namespace mapproof {

/// The connected component of each node, numbered from 0 in the order of their lowest node.
std::vector<int> components(const Graph& graph);

/// What it took to make a graph connected.
struct Bridging {
  int pieces = 1;        ///< Components before; 1 if nothing was done.
  double longest = 0.0;  ///< Length of the longest bridge laid.
};

/// Joins the components of `graph` by the shortest bridges (a minimum spanning tree over them).
/// @param distances  n x n, symmetric; infinite entries cannot be bridges.
/// @return Empty if no finite bridge exists between some of them; the graph is then left as it was.
std::optional<Bridging> bridge_components(Graph& graph, const Eigen::MatrixXd& distances);

}  // namespace mapproof
