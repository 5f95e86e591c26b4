#include "core/graph/shortest_paths.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mapproof {
namespace {

/// The edges of all nodes in one array, node after node.
struct FlatGraph {
  struct Step {
    double length;
    std::int32_t to;
  };
  std::vector<Step> steps;
  std::vector<std::size_t> first;  ///< Of each node's steps; one more at the end.

  explicit FlatGraph(const Graph& graph) {
    for (const std::vector<Edge>& edges : graph) {
      first.push_back(steps.size());
      for (const Edge& edge : edges)
        steps.push_back({edge.length, static_cast<std::int32_t>(edge.to)});
    }
    first.push_back(steps.size());
  }
};

/// Nodes by their length so far, the shortest on top: a heap of four children a parent that knows
/// where each node stands, so that a shorter length moves it up instead of adding it again.
class NodeHeap {
 public:
  explicit NodeHeap(std::size_t nodes) : place_(nodes, kNowhere) { heap_.reserve(nodes); }

  bool empty() const { return heap_.empty(); }

  void put(std::int32_t node, double length) {
    std::size_t at = place_[static_cast<std::size_t>(node)];
    if (at == kNowhere) {
      at = heap_.size();
      heap_.push_back({length, node});
    }
    while (at > 0 && heap_[(at - 1) / 4].length > length) {
      set(at, heap_[(at - 1) / 4]);
      at = (at - 1) / 4;
    }
    set(at, {length, node});
  }

  std::int32_t pop() {
    const std::int32_t top = heap_.front().node;
    place_[static_cast<std::size_t>(top)] = kNowhere;
    const Entry moved = heap_.back();
    heap_.pop_back();
    const std::size_t size = heap_.size();
    if (size == 0) return top;
    std::size_t at = 0;
    for (std::size_t child = 1; child < size; child = 4 * at + 1) {
      const std::size_t end = std::min(child + 4, size);
      std::size_t least = child;
      for (std::size_t other = child + 1; other < end; ++other)
        if (heap_[other].length < heap_[least].length) least = other;
      if (heap_[least].length >= moved.length) break;
      set(at, heap_[least]);
      at = least;
    }
    set(at, moved);
    return top;
  }

 private:
  struct Entry {
    double length;
    std::int32_t node;
  };
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

  void set(std::size_t at, const Entry& entry) {
    heap_[at] = entry;
    place_[static_cast<std::size_t>(entry.node)] = at;
  }

  std::vector<Entry> heap_;
  std::vector<std::size_t> place_;
};

/// @param lengths  n values, to be filled.
void dijkstra(const FlatGraph& graph, Eigen::Index source, NodeHeap& open, double* lengths) {
  std::fill_n(lengths, graph.first.size() - 1, HUGE_VAL);
  lengths[source] = 0.0;
  open.put(static_cast<std::int32_t>(source), 0.0);
  while (!open.empty()) {
    const std::int32_t node = open.pop();
    const double length = lengths[node];
    const std::size_t end = graph.first[static_cast<std::size_t>(node) + 1];
    for (std::size_t step = graph.first[static_cast<std::size_t>(node)]; step < end; ++step) {
      const auto [further, to] = graph.steps[step];
      const double through = length + further;
      if (through >= lengths[to]) continue;
      lengths[to] = through;
      open.put(to, through);
    }
  }
}

}  // namespace

Eigen::MatrixXd shortest_paths(const Graph& graph) {
  const Eigen::Index n = std::ssize(graph);
  const FlatGraph flat(graph);
  NodeHeap open(graph.size());
  Eigen::MatrixXd lengths(n, n);
  for (Eigen::Index source = 0; source < n; ++source)
    dijkstra(flat, source, open, lengths.col(source).data());
  // The two directions add the same edges in another order: take the lower sum for both.
  constexpr Eigen::Index kBlock = 32;  // of both halves fits the first cache
  for (Eigen::Index j0 = 0; j0 < n; j0 += kBlock)
    for (Eigen::Index i0 = 0; i0 <= j0; i0 += kBlock)
      for (Eigen::Index j = j0; j < std::min(j0 + kBlock, n); ++j)
        for (Eigen::Index i = i0; i < std::min(i0 + kBlock, j); ++i)
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
