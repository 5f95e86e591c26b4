#include "core/embed/seen_together.hpp"

#include <algorithm>
#include <cmath>

#include "core/graph/components.hpp"

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
  Graph together(static_cast<std::size_t>(squared_distances.rows()));
  for (Eigen::Index j = 0; j < squared_distances.cols(); ++j)
    for (Eigen::Index i = 0; i < squared_distances.rows(); ++i)
      if (i != j && squared_distances(i, j) < apart)
        together[static_cast<std::size_t>(j)].push_back({i, 0.0});
  return std::ranges::max(components(together)) + 1;
}

}  // namespace mapproof
