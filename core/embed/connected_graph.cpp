#include "core/embed/connected_graph.hpp"

#include <algorithm>
#include <utility>

#include "core/graph/closed_groups.hpp"
#include "core/graph/components.hpp"

namespace mapproof {

ConnectedGraph connected_neighbour_graph(const Eigen::MatrixXd& distances,
                                         const NeighbourOptions& options) {
  return connected_neighbour_graph(distances, nearest_neighbours(distances, options),
                                   options.neighbours);
}

ConnectedGraph connected_neighbour_graph(const Eigen::MatrixXd& distances,
                                         const NeighbourLists& nearest, int neighbours) {
  ConnectedGraph result{.graph = neighbour_graph(nearest, neighbours), .statuses = {}};
  const auto bridging = bridge_components(result.graph, distances);
  if (!bridging) {
    result.connected = false;
    result.statuses.push_back(status_of<StatusReason::kNoSharedObservation>());
  } else if (bridging->pieces > 1) {
    result.statuses.push_back(
        status_of<StatusReason::kGraphInPieces>(neighbours, bridging->pieces, bridging->longest));
  }
  return result;
}

ConnectedGraph connected_neighbourhoods(const Eigen::MatrixXd& distances,
                                        const NeighbourLists& nearest, int neighbours) {
  ConnectedGraph result = connected_neighbour_graph(distances, nearest, neighbours);
  const Graph symmetric = std::exchange(result.graph, nearest);
  for (std::vector<Edge>& edges : result.graph)
    if (std::ssize(edges) > neighbours) edges.resize(static_cast<std::size_t>(neighbours));
  if (result.statuses.empty()) return result;

  const auto lists = [&](std::size_t i, Eigen::Index j) {
    return std::ranges::find(result.graph[i], j, &Edge::to) != result.graph[i].end();
  };
  for (std::size_t i = 0; i < symmetric.size(); ++i)
    for (const Edge& edge : symmetric[i]) {
      const auto j = static_cast<std::size_t>(edge.to);
      if (lists(i, edge.to) || lists(j, static_cast<Eigen::Index>(i))) continue;
      result.graph[i].push_back(edge);
      result.graph[j].push_back({static_cast<Eigen::Index>(i), edge.length});
    }
  return result;
}

void tie_blends(ConnectedGraph& neighbourhoods, const Eigen::MatrixXd& distances) {
  const int added = open_closed_groups(neighbourhoods.graph, distances).value_or(0);
  if (added == 0) return;
  neighbourhoods.statuses.push_back(status_of<StatusReason::kClosedGroups>(added));
}

void tie_sets(ConnectedGraph& neighbourhoods) {
  const int joined = join_sets(neighbourhoods.graph);
  if (joined == 0) return;
  neighbourhoods.statuses.push_back(status_of<StatusReason::kLandmarksUntied>(joined));
}

}  // namespace mapproof
