#include "core/embed/isomap.hpp"

#include "core/base/not_finite.hpp"
#include "core/embed/connected_graph.hpp"
#include "core/embed/pca.hpp"
#include "core/graph/shortest_paths.hpp"

namespace mapproof {

Embedding isomap(const Graph& graph) {
  Eigen::MatrixXd paths = shortest_paths(graph);
  paths = paths.cwiseAbs2();
  return lpca(paths);
}

Embedding isomap(const Eigen::MatrixXd& distances, const NeighbourOptions& options) {
  ConnectedGraph neighbours = connected_neighbour_graph(distances, options);
  Embedding result;
  if (neighbours.connected) {
    result = isomap(neighbours.graph);
  } else {
    result.coordinates.setConstant(distances.rows(), 2, kNaN);
  }
  result.statuses.insert(result.statuses.begin(), neighbours.statuses.begin(),
                         neighbours.statuses.end());
  return result;
}

}  // namespace mapproof
