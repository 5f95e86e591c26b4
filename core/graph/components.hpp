#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/graph/neighbours.hpp"

namespace mapproof {

/// Groups of nodes of a directed graph that no list of a member leaves (closed strong components),
/// each ascending, in the order of their lowest node.
/// @note O(nodes + edges) time.
std::vector<std::vector<Eigen::Index>> closed_groups(const NeighbourLists& lists);

/// Opens all closed groups but one: the shortest distance that leaves a group becomes an edge,
/// until one group is left.
/// @return How many edges were added; empty, with `lists` as they became, if a group has no finite
///         distance out of it.
std::optional<int> open_closed_groups(NeighbourLists& lists, const Eigen::MatrixXd& distances);

/// Joins the sets of neighbours where they fall apart: a landmark that its own neighbours' sets do
/// not reach, through sets that have a landmark in common, joins its own set. After that all are in
/// one piece if the graph of the lists is.
/// @return How many landmarks joined their own set.
int join_sets(NeighbourLists& lists);

/// The connected component of each node, numbered from 0 in the order of their lowest node.
std::vector<int> components(const Graph& graph);

/// The nodes of the largest connected component, ascending; of equally large ones the first.
std::vector<Eigen::Index> largest_component(const Graph& graph);

/// What it took to make a graph connected.
struct Bridging {
  int pieces = 1;        ///< Components before; 1 if nothing was done.
  double longest = 0.0;  ///< Length of the longest bridge.
};

/// Joins the components of `graph` by the shortest bridges (a minimum spanning tree over them).
/// @param distances  n x n, symmetric; infinite entries cannot be bridges.
/// @return Empty if no finite bridge exists between some of them; the graph is then left as it was.
std::optional<Bridging> bridge_components(Graph& graph, const Eigen::MatrixXd& distances);

/// Distances of pairs of n nodes that come piece by piece: see bridge_components().
struct VisitedDistances {
  /// Takes distances of node i to some others.
  using Take = std::function<void(Eigen::Index i, std::span<const Edge> others)>;

  /// Calls `take` until it has given all of them: of each pair at both of its nodes. Several calls
  /// may be made at the same time, but not of one node.
  std::function<void(const Take& take)> visit;
  /// The length of all pairs that are not given; infinite: they cannot be bridges.
  double others = kInfinity;
};

/// The same bridges where the distances are no array.
/// @note One visit of all distances if there are several components; memory for each pair of
///       components that some distance joins.
std::optional<Bridging> bridge_components(Graph& graph, const VisitedDistances& distances);

}  // namespace mapproof
