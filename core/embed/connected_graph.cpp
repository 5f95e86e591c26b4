#include "core/embed/connected_graph.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/graph/components.hpp"
#include "core/graph/disjoint_sets.hpp"

namespace mapproof {

std::optional<Status> arbitrary_neighbours(const NeighbourLists& nearest, int neighbours,
                                           double apart) {
  // Where all others are neighbours there is no choice.
  if (!std::isfinite(apart) || neighbours >= std::ssize(nearest) - 1) return std::nullopt;
  const auto is_apart = [&](const Edge& edge) { return edge.length >= apart; };
  NeighbourLists together = nearest;
  long long landmarks = 0;
  for (std::vector<Edge>& edges : together) {
    if (std::ssize(edges) > neighbours) edges.resize(static_cast<std::size_t>(neighbours));
    if (std::erase_if(edges, is_apart) > 0) ++landmarks;
  }
  if (landmarks == 0) return std::nullopt;

  const int pieces = std::ranges::max(components(neighbour_graph(together, neighbours))) + 1;
  return status_of<StatusReason::kFewSeenTogether>(landmarks, neighbours, pieces);
}

int groups_seen_together(const Eigen::MatrixXd& squared_distances, double apart_squared) {
  if (!std::isfinite(apart_squared) || squared_distances.rows() == 0) return 1;
  const double apart = apart_squared * (1.0 - 1e-12);
  const Eigen::Index n = squared_distances.rows();
  DisjointSets sets(static_cast<std::size_t>(n));
  auto groups = static_cast<int>(n);
  for (Eigen::Index j = 0; j < n && groups > 1; ++j)
    for (Eigen::Index i = j + 1; i < n; ++i)
      if (squared_distances(i, j) < apart &&
          sets.merge(static_cast<std::size_t>(i), static_cast<std::size_t>(j)))
        --groups;
  return groups;
}

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
