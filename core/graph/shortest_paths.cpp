#include "core/graph/shortest_paths.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <queue>
#include <utility>
#include <vector>

#include "core/linalg/unset_matrix.hpp"

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
  double shortest = HUGE_VAL;
  double longest = 0.0;

  explicit FlatGraph(const Graph& graph) {
    for (const std::vector<Edge>& edges : graph) {
      first.push_back(steps.size());
      for (const Edge& edge : edges) {
        steps.push_back({edge.length, static_cast<std::int32_t>(edge.to)});
        shortest = std::min(shortest, edge.length);
        longest = std::max(longest, edge.length);
      }
    }
    first.push_back(steps.size());
  }

  /// Reports to `shortened` each new length and its node, where the way through `node` is shorter.
  template <typename Shortened>
  void relax(std::int32_t node, double* lengths, const Shortened& shortened) const {
    const double length = lengths[node];
    const std::size_t end = first[static_cast<std::size_t>(node) + 1];
    for (std::size_t step = first[static_cast<std::size_t>(node)]; step < end; ++step) {
      const auto [further, to] = steps[step];
      const double through = length + further;
      if (through >= lengths[to]) continue;
      lengths[to] = through;
      shortened(through, to);
    }
  }
};

/// Nodes by their length so far, in buckets no wider than the shortest edge: no node of a bucket
/// can shorten another's way, so that their order within it does not count. The buckets are a ring,
/// as long as the longest edge. A node whose length fell stays in its old bucket as well and is met
/// there after its length is final, which changes nothing.
class Buckets {
 public:
  static constexpr double kMost = 4096.0;

  Buckets(double shortest, double longest)
      : per_length_(1.001 / shortest),
        ring_(std::bit_ceil(static_cast<std::size_t>(longest * per_length_) + 3)),
        mask_(ring_.size() - 1) {}

  /// Shortest lengths from the source, into n values that hold infinity.
  void search(const FlatGraph& graph, std::int32_t source, double* lengths) {
    lengths[source] = 0.0;
    ring_[0].push_back(source);
    std::size_t waiting = 1;
    for (std::size_t at = 0; waiting > 0; at = (at + 1) & mask_) {
      waiting -= ring_[at].size();
      for (const std::int32_t node : ring_[at])
        graph.relax(node, lengths, [&](double length, std::int32_t reached) {
          ring_[static_cast<std::size_t>(length * per_length_) & mask_].push_back(reached);
          ++waiting;
        });
      ring_[at].clear();
    }
  }

 private:
  double per_length_;
  std::vector<std::vector<std::int32_t>> ring_;  ///< As many as a power of two.
  std::size_t mask_;
};

/// The same for edges of any lengths.
void heap_search(const FlatGraph& graph, std::int32_t source, double* lengths) {
  using Reached = std::pair<double, std::int32_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  lengths[source] = 0.0;
  open.emplace(0.0, source);
  while (!open.empty()) {
    const auto [length, node] = open.top();
    open.pop();
    if (length > lengths[node]) continue;
    graph.relax(node, lengths,
                [&open](double through, std::int32_t reached) { open.emplace(through, reached); });
  }
}

}  // namespace

PathSearch::PathSearch(const Graph& graph) : nodes_(std::ssize(graph)) {
  auto flat = std::make_shared<const FlatGraph>(graph);
  if (flat->shortest > 0.0 && flat->longest <= Buckets::kMost * flat->shortest)
    search_ = [flat, buckets = Buckets(flat->shortest, flat->longest)](std::int32_t source,
                                                                       double* lengths) mutable {
      buckets.search(*flat, source, lengths);
    };
  else
    search_ = [flat](std::int32_t source, double* lengths) { heap_search(*flat, source, lengths); };
}

void PathSearch::from(Eigen::Index source, double* lengths) {
  std::fill_n(lengths, nodes_, HUGE_VAL);
  search_(static_cast<std::int32_t>(source), lengths);
}

Eigen::MatrixXd shortest_paths(const Graph& graph) {
  const Eigen::Index n = std::ssize(graph);
  Eigen::MatrixXd lengths = unset_matrix(n, n);
  PathSearch search(graph);
  for (Eigen::Index source = 0; source < n; ++source)
    search.from(source, lengths.col(source).data());
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
