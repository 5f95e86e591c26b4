#include "core/embed/connected_graph.hpp"

#include <fmt/format.h>

#include "core/graph/components.hpp"

namespace mapproof {

ConnectedGraph connected_neighbour_graph(const Eigen::MatrixXd& distances,
                                         const NeighbourOptions& options) {
  ConnectedGraph result{.graph = neighbour_graph(distances, options), .statuses = {}};
  const auto bridging = bridge_components(result.graph, distances);
  if (!bridging) {
    result.connected = false;
    result.statuses.push_back({StatusCode::kFailed,
                               "Some groups of landmarks share no observation: nothing tells where "
                               "they lie to each other."});
  } else if (bridging->pieces > 1) {
    result.statuses.push_back(
        {StatusCode::kBridged,
         fmt::format("The graph of K = {} neighbours was in {} pieces; joined by its shortest "
                     "bridges, the longest {:.3g}.",
                     options.neighbours, bridging->pieces, bridging->longest)});
  }
  return result;
}

}  // namespace mapproof
