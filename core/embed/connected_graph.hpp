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

}  // namespace mapproof
