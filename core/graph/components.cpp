#include "core/graph/components.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>

#include "core/graph/disjoint_sets.hpp"

namespace mapproof {
namespace {

/// Nodes in the order in which a depth-first search leaves them, over `next`.
std::vector<std::size_t> finishing_order(const NeighbourLists& next) {
  std::vector<std::size_t> order;
  std::vector<bool> seen(next.size(), false);
  std::vector<std::pair<std::size_t, std::size_t>> open;  // a node and its next edge
  for (std::size_t start = 0; start < next.size(); ++start) {
    if (seen[start]) continue;
    seen[start] = true;
    open.emplace_back(start, 0);
    while (!open.empty()) {
      auto& [node, edge] = open.back();
      if (edge == next[node].size()) {
        order.push_back(node);
        open.pop_back();
        continue;
      }
      const auto to = static_cast<std::size_t>(next[node][edge++].to);
      if (seen[to]) continue;
      seen[to] = true;
      open.emplace_back(to, 0);
    }
  }
  return order;
}

/// The strong component of each node, by Kosaraju's two searches, and how many there are.
std::pair<std::vector<int>, int> strong_components(const NeighbourLists& lists) {
  NeighbourLists reversed(lists.size());
  for (std::size_t i = 0; i < lists.size(); ++i)
    for (const Edge& edge : lists[i])
      reversed[static_cast<std::size_t>(edge.to)].push_back({static_cast<Eigen::Index>(i), 0.0});
  const std::vector<std::size_t> order = finishing_order(lists);
  std::vector<int> component(lists.size(), -1);
  int count = 0;
  std::vector<std::size_t> open;
  for (auto start = order.rbegin(); start != order.rend(); ++start) {
    if (component[*start] >= 0) continue;
    component[*start] = count;
    open.push_back(*start);
    while (!open.empty()) {
      const std::size_t node = open.back();
      open.pop_back();
      for (const Edge& edge : reversed[node]) {
        const auto to = static_cast<std::size_t>(edge.to);
        if (component[to] >= 0) continue;
        component[to] = count;
        open.push_back(to);
      }
    }
    ++count;
  }
  return {component, count};
}

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
  const auto position = std::ranges::lower_bound(edges, to, {}, &Edge::to);
  edges.insert(position, {to, length});
}

/// The shortest edge that leaves a group, and its start; `to` is negative if none is finite.
std::pair<Eigen::Index, Edge> shortest_way_out(const std::vector<Eigen::Index>& group,
                                               const Eigen::MatrixXd& distances) {
  Edge best{.to = -1, .length = HUGE_VAL};
  Eigen::Index from = -1;
  for (const Eigen::Index i : group)
    for (Eigen::Index j = 0; j < distances.rows(); ++j)
      if (distances(j, i) < best.length && !std::ranges::binary_search(group, j)) {
        best = {j, distances(j, i)};
        from = i;
      }
  return {from, best};
}

}  // namespace

std::vector<std::vector<Eigen::Index>> closed_groups(const NeighbourLists& lists) {
  const auto [component, count] = strong_components(lists);
  std::vector<bool> closed(static_cast<std::size_t>(count), true);
  for (std::size_t i = 0; i < lists.size(); ++i)
    for (const Edge& edge : lists[i])
      if (component[static_cast<std::size_t>(edge.to)] != component[i])
        closed[static_cast<std::size_t>(component[i])] = false;
  std::vector<std::vector<Eigen::Index>> groups(closed.size());
  for (std::size_t i = 0; i < lists.size(); ++i)
    if (closed[static_cast<std::size_t>(component[i])])
      groups[static_cast<std::size_t>(component[i])].push_back(static_cast<Eigen::Index>(i));
  std::erase_if(groups, [](const auto& group) { return group.empty(); });
  std::ranges::sort(groups);
  return groups;
}

std::optional<int> open_closed_groups(NeighbourLists& lists, const Eigen::MatrixXd& distances) {
  int added = 0;
  // Each round opens all groups but the first, so that there are fewer every time.
  for (auto groups = closed_groups(lists); groups.size() > 1; groups = closed_groups(lists))
    for (std::size_t g = 1; g < groups.size(); ++g) {
      const auto [from, best] = shortest_way_out(groups[g], distances);
      if (best.to < 0) return std::nullopt;
      lists[static_cast<std::size_t>(from)].push_back(best);
      ++added;
    }
  return added;
}

int join_sets(NeighbourLists& lists) {
  DisjointSets sets(lists.size());
  for (const std::vector<Edge>& edges : lists)
    for (const Edge& edge : edges)
      sets.merge(static_cast<std::size_t>(edge.to), static_cast<std::size_t>(edges.front().to));
  int joined = 0;
  for (std::size_t i = 0; i < lists.size(); ++i) {
    if (lists[i].empty()) continue;
    const auto first = static_cast<std::size_t>(lists[i].front().to);
    if (!sets.merge(i, first)) continue;
    lists[i].push_back({static_cast<Eigen::Index>(i), 0.0});
    ++joined;
  }
  return joined;
}

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

std::vector<Eigen::Index> largest_component(const Graph& graph) {
  std::vector<std::vector<Eigen::Index>> groups(graph.size() + 1);
  const std::vector<int> component = components(graph);
  for (std::size_t i = 0; i < component.size(); ++i)
    groups[static_cast<std::size_t>(component[i])].push_back(static_cast<Eigen::Index>(i));
  return *std::ranges::max_element(groups, {}, [](const auto& group) { return group.size(); });
}

namespace {

/// The shortest finite edge between each two components that are given one, ascending.
std::vector<Bridge> shortest_bridges(const std::vector<int>& piece,
                                     const VisitedDistances& distances) {
  std::map<std::pair<int, int>, Bridge> best;
  std::mutex mutex;
  distances.visit([&](Eigen::Index i, std::span<const Edge> others) {
    const int here = piece[static_cast<std::size_t>(i)];
    for (const Edge& edge : others) {
      const int there = piece[static_cast<std::size_t>(edge.to)];
      // Each pair comes at both of its nodes.
      if (here == there || edge.to < i || !std::isfinite(edge.length)) continue;
      const Bridge bridge{edge.length, i, edge.to};
      const std::lock_guard lock(mutex);
      const auto [found, is_new] = best.emplace(std::minmax(here, there), bridge);
      if (!is_new) found->second = std::min(found->second, bridge);
    }
  });
  std::vector<Bridge> bridges;
  for (const auto& [pieces, bridge] : best) bridges.push_back(bridge);
  std::ranges::sort(bridges);
  return bridges;
}

/// Of components, as bridges join them (Kruskal).
class JoinedComponents {
 public:
  explicit JoinedComponents(const std::vector<int>& piece)
      : piece_(piece), sets_(static_cast<std::size_t>(std::ranges::max(piece) + 1)) {}

  /// Keeps a bridge between components that no others join.
  void offer(const Bridge& bridge) {
    if (sets_.merge(of(bridge.to), of(bridge.from))) joining_.push_back(bridge);
  }

  std::size_t of(Eigen::Index node) {
    return sets_.of(static_cast<std::size_t>(piece_[static_cast<std::size_t>(node)]));
  }

  const std::vector<Bridge>& bridges() const { return joining_; }

 private:
  const std::vector<int>& piece_;
  DisjointSets sets_;
  std::vector<Bridge> joining_;
};

/// Adds the bridges, if they join all components.
std::optional<Bridging> lay_bridges(Graph& graph, int pieces, const std::vector<Bridge>& bridges) {
  if (std::ssize(bridges) != pieces - 1) return std::nullopt;
  Bridging result{.pieces = pieces};
  for (const Bridge& bridge : bridges) {
    insert_edge(graph, bridge.from, bridge.to, bridge.length);
    insert_edge(graph, bridge.to, bridge.from, bridge.length);
    result.longest = std::max(result.longest, bridge.length);
  }
  return result;
}

}  // namespace

std::optional<Bridging> bridge_components(Graph& graph, const Eigen::MatrixXd& distances) {
  const std::vector<int> piece = components(graph);
  const int pieces = piece.empty() ? 0 : std::ranges::max(piece) + 1;
  if (pieces <= 1) return Bridging{.pieces = pieces};
  JoinedComponents joined(piece);
  for (const Bridge& bridge : shortest_bridges(piece, pieces, distances)) joined.offer(bridge);
  return lay_bridges(graph, pieces, joined.bridges());
}

std::optional<Bridging> bridge_components(Graph& graph, const VisitedDistances& distances) {
  const std::vector<int> piece = components(graph);
  const int pieces = piece.empty() ? 0 : std::ranges::max(piece) + 1;
  if (pieces <= 1) return Bridging{.pieces = pieces};
  JoinedComponents joined(piece);
  for (const Bridge& bridge : shortest_bridges(piece, distances)) joined.offer(bridge);
  // Of bridges of one length those between the lowest nodes come first: from the first node to the
  // first of each other group.
  if (std::isfinite(distances.others))
    for (Eigen::Index node = 1; node < std::ssize(graph); ++node)
      joined.offer({distances.others, 0, node});
  return lay_bridges(graph, pieces, joined.bridges());
}

}  // namespace mapproof
