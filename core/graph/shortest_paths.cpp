#include "core/graph/shortest_paths.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

namespace mapproof {
namespace {

using Reached = std::pair<double, Eigen::Index>;

void dijkstra(const Graph& graph, Eigen::Index source, Eigen::Ref<Eigen::VectorXd> lengths) {
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  lengths.setConstant(HUGE_VAL);
  lengths(source) = 0.0;
  open.emplace(0.0, source);
  while (!open.empty()) {
    const auto [length, node] = open.top();
    open.pop();
    if (length > lengths(node)) continue;
    for (const Edge& edge : graph[static_cast<std::size_t>(node)]) {
      const double through = length + edge.length;
      if (through >= lengths(edge.to)) continue;
      lengths(edge.to) = through;
      open.emplace(through, edge.to);
    }
  }
}

}  // namespace

Eigen::MatrixXd shortest_paths(const Graph& graph) {
  const Eigen::Index n = std::ssize(graph);
  Eigen::MatrixXd lengths(n, n);
  for (Eigen::Index source = 0; source < n; ++source) dijkstra(graph, source, lengths.col(source));
  // The two directions add the same edges in another order: take the lower sum for both.
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < j; ++i)
      lengths(i, j) = lengths(j, i) = std::min(lengths(i, j), lengths(j, i));
  return lengths;
}

Eigen::MatrixXd completed_distances(const Eigen::MatrixXd& distances) {
  const Eigen::Index n = distances.rows();
  Eigen::MatrixXd paths = distances;
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index j = 0; j < n; ++j)
      if (std::isfinite(paths(k, j)))
        paths.col(j) = paths.col(j).cwiseMin((paths.col(k).array() + paths(k, j)).matrix());
  return distances.array().isFinite().select(distances, paths);
}

}  // namespace mapproof
