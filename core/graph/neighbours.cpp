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
  NearestLists lists(n, options);
  for (Eigen::Index i = 0; i < n; ++i)
    lists.take(i, {distances.col(i).data(), static_cast<std::size_t>(n)});
  return std::move(lists).lists();
}

NearestLists::NearestLists(Eigen::Index n, const NeighbourOptions& options)
    : options_(options), nearest_(static_cast<std::size_t>(n)) {
  require_neighbours(options.neighbours, n);
}

void NearestLists::take(Eigen::Index i, std::span<const Edge> others) {
  take_each(i, others.size(), [&](std::size_t k) { return others[k]; });
}

void NearestLists::take(Eigen::Index i, std::span<const double> lengths) {
  const auto take_from = [&](Eigen::Index first, std::span<const double> some) {
    take_each(i, some.size(), [&](std::size_t k) {
      return Edge{first + static_cast<Eigen::Index>(k), some[k]};
    });
  };
  const auto own = static_cast<std::size_t>(i);
  take_from(0, lengths.first(own));
  take_from(i + 1, lengths.subspan(own + 1));
}

template <typename EdgeAt>
void NearestLists::take_each(Eigen::Index i, std::size_t count, const EdgeAt& edge_at) {
  std::vector<Candidate>& heap = nearest_[static_cast<std::size_t>(i)];
  const auto most = static_cast<std::size_t>(options_.neighbours);
  // Rounding is slow: only what may be among the nearest is rounded.
  double bound = heap.size() < most ? kInfinity : heap.front().edge.length * kRounding;
  for (std::size_t k = 0; k < count; ++k) {
    const Edge edge = edge_at(k);
    if (!(edge.length <= bound) || !(edge.length < options_.cutoff) || !std::isfinite(edge.length))
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
