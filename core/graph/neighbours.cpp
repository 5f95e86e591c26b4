#include "core/graph/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

/// 40 bits, some 12 significant digits: distances that differ by rounding alone become ties.
double rounded(double distance) {
  if (distance == 0.0 || !std::isfinite(distance)) return distance;
  int exponent = 0;
  const double mantissa = std::frexp(distance, &exponent);
  return std::ldexp(std::nearbyint(mantissa * 0x1p40), exponent - 40);
}

}  // namespace

NeighbourLists nearest_neighbours(const Eigen::MatrixXd& distances,
                                  const NeighbourOptions& options) {
  const Eigen::Index n = distances.rows();
  if (options.neighbours < 1 || options.neighbours >= n)
    throw InvalidInput(
        fmt::format("K = {} nearest neighbours need 1 <= K < {} landmarks", options.neighbours, n));

  NeighbourLists nearest(static_cast<std::size_t>(n));
  std::vector<double> finite;
  std::vector<std::pair<double, Eigen::Index>> order;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto row = distances.col(i);
    const auto usable = [&](Eigen::Index j) {
      return j != i && row(j) < options.cutoff && std::isfinite(row(j));
    };
    finite.clear();
    for (Eigen::Index j = 0; j < n; ++j)
      if (usable(j)) finite.push_back(row(j));
    const auto count = std::min<std::ptrdiff_t>(options.neighbours, std::ssize(finite));
    if (count == 0) continue;
    // Rounding is slow: only what may be among the nearest is rounded.
    std::nth_element(finite.begin(), finite.begin() + (count - 1), finite.end());
    const double farthest = finite[static_cast<std::size_t>(count - 1)] * (1.0 + 1e-11);
    order.clear();
    for (Eigen::Index j = 0; j < n; ++j)
      if (row(j) <= farthest && usable(j)) order.emplace_back(rounded(row(j)), j);
    std::sort(order.begin(), order.end());
    std::vector<Edge>& edges = nearest[static_cast<std::size_t>(i)];
    edges.reserve(static_cast<std::size_t>(count));
    for (std::ptrdiff_t rank = 0; rank < count; ++rank) {
      const Eigen::Index j = order[static_cast<std::size_t>(rank)].second;
      edges.push_back({j, row(j)});
    }
  }
  return nearest;
}

Graph neighbour_graph(const NeighbourLists& nearest, int neighbours) {
  Graph graph(nearest.size());
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    const auto count = std::min<std::ptrdiff_t>(neighbours, std::ssize(nearest[i]));
    for (std::ptrdiff_t rank = 0; rank < count; ++rank) {
      const Edge& edge = nearest[i][static_cast<std::size_t>(rank)];
      graph[i].push_back(edge);
      graph[static_cast<std::size_t>(edge.to)].push_back(
          {static_cast<Eigen::Index>(i), edge.length});
    }
  }
  for (std::vector<Edge>& edges : graph) {
    std::ranges::sort(edges, {}, &Edge::to);
    const auto twice = std::ranges::unique(edges, {}, &Edge::to);
    edges.erase(twice.begin(), twice.end());
  }
  return graph;
}

Graph neighbour_graph(const Eigen::MatrixXd& distances, const NeighbourOptions& options) {
  return neighbour_graph(nearest_neighbours(distances, options), options.neighbours);
}

}  // namespace mapproof
