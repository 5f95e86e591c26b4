#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/graph/neighbours.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// A neighbour graph in one piece, with what it took.
struct ConnectedGraph {
  Graph graph;
  std::vector<Status> statuses;  ///< kBridged, or kFailed if it stays in pieces.
  bool connected = true;
};

/// The K-nearest-neighbour graph, its pieces joined by their shortest bridges.
/// @throws InvalidInput if K is not in [1, n).
ConnectedGraph connected_neighbour_graph(const Eigen::MatrixXd& distances,
                                         const NeighbourOptions& options);

/// The same from the first K of each list of `nearest` (see nearest_neighbours).
ConnectedGraph connected_neighbour_graph(const Eigen::MatrixXd& distances, const Graph& nearest,
                                         int neighbours);

/// The K nearest neighbours of each landmark, in `graph`. Where the symmetric graph is in pieces,
/// the ends of its shortest bridges become neighbours of each other, beyond their K.
ConnectedGraph connected_neighbourhoods(const Eigen::MatrixXd& distances, const Graph& nearest,
                                        int neighbours);

}  // namespace mapproof
