#include "core/graph/components.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace mapproof {
namespace {

/// The shortest finite edge between each two components, ascending.
struct Bridge {
  double length;
  Eigen::Index from;
  Eigen::Index to;

  auto operator<=>(const Bridge&) const = default;
};

std::vector<Bridge> shortest_bridges(const std::vector<int>& piece, int pieces,
                                     const Eigen::MatrixXd& distances) {
  const auto count = static_cast<std::size_t>(pieces);
  std::vector<Bridge> best(count * count, Bridge{HUGE_VAL, 0, 0});
  for (Eigen::Index i = 0; i < distances.rows(); ++i)
    for (Eigen::Index j = i + 1; j < distances.rows(); ++j) {
      const auto [a, b] =
          std::minmax(piece[static_cast<std::size_t>(i)], piece[static_cast<std::size_t>(j)]);
      Bridge& current = best[static_cast<std::size_t>(a) * count + static_cast<std::size_t>(b)];
      if (a != b && distances(i, j) < current.length) current = {distances(i, j), i, j};
    }
  std::erase_if(best, [](const Bridge& bridge) { return !std::isfinite(bridge.length); });
  std::ranges::sort(best);
  return best;
}

void insert_edge(Graph& graph, Eigen::Index from, Eigen::Index to, double length) {
  std::vector<Edge>& edges = graph[static_cast<std::size_t>(from)];
  const auto place = std::ranges::lower_bound(edges, to, {}, &Edge::to);
  edges.insert(place, {to, length});
}

}  // namespace

std::vector<int> components(const Graph& graph) {
  std::vector<int> piece(graph.size(), -1);
  std::vector<std::size_t> open;
  int count = 0;
  for (std::size_t start = 0; start < graph.size(); ++start) {
    if (piece[start] >= 0) continue;
    piece[start] = count;
    open.push_back(start);
    while (!open.empty()) {
      const std::size_t node = open.back();
      open.pop_back();
      for (const Edge& edge : graph[node]) {
        const auto next = static_cast<std::size_t>(edge.to);
        if (piece[next] >= 0) continue;
        piece[next] = count;
        open.push_back(next);
      }
    }
    ++count;
  }
  return piece;
}

std::optional<Bridging> bridge_components(Graph& graph, const Eigen::MatrixXd& distances) {
  std::vector<int> piece = components(graph);
  Bridging result{.pieces = piece.empty() ? 0 : *std::ranges::max_element(piece) + 1};
  if (result.pieces <= 1) return result;

  // Kruskal over the components: a label of each, merged as bridges are laid.
  std::vector<int> label(static_cast<std::size_t>(result.pieces));
  std::iota(label.begin(), label.end(), 0);
  std::vector<Bridge> laid;
  for (const Bridge& bridge : shortest_bridges(piece, result.pieces, distances)) {
    const int a = label[static_cast<std::size_t>(piece[static_cast<std::size_t>(bridge.from)])];
    const int b = label[static_cast<std::size_t>(piece[static_cast<std::size_t>(bridge.to)])];
    if (a == b) continue;
    std::ranges::replace(label, b, a);
    laid.push_back(bridge);
  }
  if (std::ssize(laid) != result.pieces - 1) return std::nullopt;
  for (const Bridge& bridge : laid) {
    insert_edge(graph, bridge.from, bridge.to, bridge.length);
    insert_edge(graph, bridge.to, bridge.from, bridge.length);
    result.longest = std::max(result.longest, bridge.length);
  }
  return result;
}

}  // namespace mapproof
