#include "core/pairs/pair_graph.hpp"

#include <algorithm>

namespace mapproof {
namespace {

std::vector<int> pairs_of_each(const std::vector<MeasuredPair>& pairs, std::size_t landmarks,
                               int fewest_scans) {
  std::vector<int> count(landmarks, 0);
  for (const MeasuredPair& pair : pairs)
    if (pair.scans >= fewest_scans)
      for (const Eigen::Index i : {pair.first, pair.second}) ++count[static_cast<std::size_t>(i)];
  return count;
}

}  // namespace

std::vector<bool> are_trusted(const std::vector<MeasuredPair>& pairs, std::size_t landmarks,
                              int fewest_scans) {
  const std::vector<int> count = pairs_of_each(pairs, landmarks, fewest_scans);
  const auto is_short = [&](Eigen::Index i) {
    return count[static_cast<std::size_t>(i)] < kPairsToPlace;
  };
  std::vector<bool> result;
  for (const MeasuredPair& pair : pairs)
    result.push_back(pair.scans >= fewest_scans || is_short(pair.first) || is_short(pair.second));
  return result;
}

Graph graph_of(const std::vector<MeasuredPair>& pairs, std::size_t landmarks) {
  Graph graph(landmarks);
  for (const MeasuredPair& pair : pairs) {
    graph[static_cast<std::size_t>(pair.first)].push_back({pair.second, pair.distance_m});
    graph[static_cast<std::size_t>(pair.second)].push_back({pair.first, pair.distance_m});
  }
  for (std::vector<Edge>& edges : graph) std::ranges::sort(edges, {}, &Edge::to);
  return graph;
}

}  // namespace mapproof
