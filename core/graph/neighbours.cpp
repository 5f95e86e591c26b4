#include "core/graph/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

void require_neighbours(int neighbours, Eigen::Index n) {
  if (neighbours < 1 || neighbours >= n)
    throw InvalidInput(
        fmt::format("K = {} nearest neighbours need 1 <= K < {} landmarks", neighbours, n));
}

/// Distances that differ by rounding alone are at most this many times each other.
constexpr double kRounding = 1.0 + 1e-11;

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
  require_neighbours(options.neighbours, n);
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
    const double farthest = finite[static_cast<std::size_t>(count - 1)] * kRounding;
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

NearestLists::NearestLists(Eigen::Index n, const NeighbourOptions& options)
    : options_(options), nearest_(static_cast<std::size_t>(n)) {
  require_neighbours(options.neighbours, n);
}

void NearestLists::take(Eigen::Index i, std::span<const Edge> others) {
  std::vector<Candidate>& heap = nearest_[static_cast<std::size_t>(i)];
  const auto most = static_cast<std::size_t>(options_.neighbours);
  double bound = heap.size() < most ? kInfinity : heap.front().edge.length * kRounding;
  for (const Edge& edge : others) {
    if (edge.length > bound || !(edge.length < options_.cutoff) || !std::isfinite(edge.length))
      continue;
    const Candidate candidate{rounded(edge.length), edge};
    if (heap.size() == most) {
      if (!(candidate < heap.front())) continue;
      std::pop_heap(heap.begin(), heap.end());
      heap.pop_back();
    }
    heap.push_back(candidate);
    std::push_heap(heap.begin(), heap.end());
    if (heap.size() == most) bound = heap.front().edge.length * kRounding;
  }
}

NeighbourLists NearestLists::lists() && {
  NeighbourLists lists(nearest_.size());
  for (std::size_t i = 0; i < nearest_.size(); ++i) {
    std::sort_heap(nearest_[i].begin(), nearest_[i].end());
    lists[i].reserve(nearest_[i].size());
    for (const Candidate& candidate : nearest_[i]) lists[i].push_back(candidate.edge);
    nearest_[i] = {};
  }
  return lists;
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
