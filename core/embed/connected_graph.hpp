#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/graph/neighbours.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// Whether neighbours were chosen among landmarks on which the observations have no information.
///
/// @param nearest  K or more of each landmark, nearest first (see nearest_neighbours).
/// @param apart  The distance of landmarks never seen together; infinite: there are no such.
/// @return kArbitraryNeighbours, with how many landmarks have such neighbours among their first K,
///         and into how many pieces the graph falls without them; empty if none has, or
///         if all others are neighbours.
/// @note O(n K log n).
std::optional<Status> arbitrary_neighbours(const NeighbourLists& nearest, int neighbours,
                                           double apart);

/// How many groups the landmarks fall into if those seen together belong to one.
/// @param squared_distances  n x n; those of `apart_squared` or more are of landmarks never seen
///                           together. Infinite `apart_squared`: 1.
/// @note O(n^2).
int groups_seen_together(const Eigen::MatrixXd& squared_distances, double apart_squared);

/// A neighbour graph in one piece, with its warnings.
struct ConnectedGraph {
  Graph graph;                   ///< Of connected_neighbourhoods: NeighbourLists.
  std::vector<Status> statuses;  ///< kBridged, or kFailed if it stays in pieces.
  bool connected = true;
};

/// The K-nearest-neighbour graph, its pieces joined by their shortest bridges.
/// @throws InvalidInput if K is not in [1, n).
ConnectedGraph connected_neighbour_graph(const Eigen::MatrixXd& distances,
                                         const NeighbourOptions& options);

/// The same from the first K of each list of `nearest` (see nearest_neighbours).
ConnectedGraph connected_neighbour_graph(const Eigen::MatrixXd& distances,
                                         const NeighbourLists& nearest, int neighbours);

/// The K nearest neighbours of each landmark, in `graph`. Where the symmetric graph is in pieces,
/// the ends of its shortest bridges become neighbours of each other, beyond their K.
ConnectedGraph connected_neighbourhoods(const Eigen::MatrixXd& distances,
                                        const NeighbourLists& nearest, int neighbours);

/// Neighbourhoods for LLE: no group of landmarks but one has all of its neighbours within itself,
/// which would let each such group shrink to a point of its own. Where there are more, the shortest
/// way out of a group becomes a neighbour of the one it starts from (kBridged).
void tie_blends(ConnectedGraph& neighbourhoods, const Eigen::MatrixXd& distances);

/// Neighbourhoods for HLLE: all tied together by landmarks in common, unlike a landmark that is not
/// a neighbour of any other. Where they are not, landmarks join their own (kBridged).
void tie_sets(ConnectedGraph& neighbourhoods);

}  // namespace mapproof
