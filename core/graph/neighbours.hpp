#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/base/not_finite.hpp"

namespace mapproof {

/// An edge of a graph whose nodes are landmarks.
struct Edge {
  Eigen::Index to = 0;
  double length = 0.0;
};

/// Undirected graph as neighbour lists: graph[i] lists the edges at i, ascending in `to`.
using Graph = std::vector<std::vector<Edge>>;

/// Directed lists of neighbours of the same form: lists[i] are those of i, nearest first, and after
/// them such as were added to tie a map together (in join_sets even i itself, at length 0).
using NeighbourLists = Graph;

/// Which pairs become edges.
struct NeighbourOptions {
  int neighbours = 8;  ///< K, 1 <= K < n.
  /// Pairs at this distance or farther are never edges. For visibility, sqrt(2) leaves out pairs
  /// never seen together, whose order is arbitrary.
  double cutoff = kInfinity;
};

/// The K nearest others of each node, nearest first: lists[i] are those of i, fewer where fewer are
/// within the cutoff. Ties, after rounding to 40 bits (some 12 digits), go to the lower row.
///
/// @param distances  n x n, symmetric, entries >= 0 or infinite, which are not edges.
/// @throws InvalidInput if K is not in [1, n).
/// @note O(n^2 + n K log K log n) time on average, O(n^2 log K) at most.
NeighbourLists nearest_neighbours(const Eigen::MatrixXd& distances,
                                  const NeighbourOptions& options);

/// The same of distances that come piece by piece, so that no n x n array is needed.
class NearestLists {
 public:
  /// @throws InvalidInput if K is not in [1, n).
  NearestLists(Eigen::Index n, const NeighbourOptions& options);

  /// Takes distances of node i to some others. Different nodes may be given at the same time.
  /// @param others  None that node i was given before, nor i itself; infinite ones do not count.
  void take(Eigen::Index i, std::span<const Edge> others);

  /// The same of the distances to all nodes in their order, of which that to i itself does not
  /// count.
  void take(Eigen::Index i, std::span<const double> lengths);

  /// What nearest_neighbours() makes of the same distances.
  NeighbourLists lists() &&;

 private:
  struct Candidate {
    double rounded;
    Edge edge;

    bool operator<(const Candidate& other) const {
      return rounded != other.rounded ? rounded < other.rounded : edge.to < other.edge.to;
    }
  };

  template <typename EdgeAt>
  void take_each(Eigen::Index i, std::size_t count, const EdgeAt& edge_at);

  NeighbourOptions options_;
  std::vector<std::vector<Candidate>> nearest_;  ///< Of each node a heap, the farthest first.
};

/// Symmetric K-nearest-neighbour graph: i and j are joined if either is among the K nearest of the
/// other. Ties, after rounding to 40 bits (some 12 digits), go to the lower row. Infinite distances
/// join nothing.
///
/// @param distances  n x n, symmetric, entries >= 0 or infinite.
/// @throws InvalidInput if K is not in [1, n).
/// @note nearest_neighbours, and O(n K log n).
Graph neighbour_graph(const Eigen::MatrixXd& distances, const NeighbourOptions& options);

/// The same graph from the first K of each list of `nearest` (see nearest_neighbours).
/// @note O(n K log n) time.
Graph neighbour_graph(const NeighbourLists& nearest, int neighbours);

}  // namespace mapproof
