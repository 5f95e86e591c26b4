#pragma once

#include <cstdint>
#include <functional>

#include "core/graph/neighbours.hpp"

namespace mapproof {

/// Shortest paths from one node after the other, as shortest_paths() finds them.
class PathSearch {
 public:
  explicit PathSearch(const Graph& graph);

  /// Lengths from the node to all n, into n values; infinite to other components.
  void from(Eigen::Index source, double* lengths);

 private:
  Eigen::Index nodes_;
  std::function<void(std::int32_t source, double* lengths)> search_;
};

/// Lengths of the shortest paths between all nodes; infinite between components.
/// @return n x n, exactly symmetric, zero diagonal.
/// @note Dijkstra's search from each node: O(n e) time for e edges, over buckets as wide as the
///       shortest edge; O(n e log n) over a heap where the longest is more than 4096 times as
///       long, so always where an edge has length 0.
Eigen::MatrixXd shortest_paths(const Graph& graph);

/// Shortest paths over a complete weighted graph: fills the infinite entries of `distances`.
/// @note Floyd and Warshall's O(n^3) time.
Eigen::MatrixXd completed_distances(const Eigen::MatrixXd& distances);

}  // namespace mapproof
