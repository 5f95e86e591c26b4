#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/graph/neighbours.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// A neighbour graph in one piece, with what it took.
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

/// Neighbourhoods for HLLE: all tied together by landmarks in common, which a landmark that is
/// nobody's neighbour is not. Where they are not, landmarks join their own (kBridged).
void tie_sets(ConnectedGraph& neighbourhoods);

}  // namespace mapproof
