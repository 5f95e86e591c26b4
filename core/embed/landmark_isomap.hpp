#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/embed/connected_graph.hpp"
#include "core/graph/neighbours.hpp"
#include "core/model/embedding.hpp"
#include "core/observe/history_distances.hpp"

namespace mapproof {

/// How Landmark ISOMAP approximates ISOMAP. The paper's "landmarks" are reference landmarks here:
/// all of ours are landmarks.
struct LandmarkIsomapOptions {
  /// L, the landmarks from which paths are searched, >= 3; more than there are: all.
  int references = 200;
};

/// Landmark ISOMAP: classical scaling of the shortest paths between L reference landmarks, and all
/// others by their squared path lengths to these [silva2003, silva2004].
///
/// The references are chosen one after the other, each the farthest from those before, by the
/// paths; the first is the farthest from the first node.
/// @param graph  n >= 3 nodes in one piece.
/// @return Centred, columns orthogonal, in descending order of spread; with all as references the
///         map of isomap(). Statuses as of principal_coordinates(), on the references. The spectrum
///         holds up to 10 eigenvalues of the references.
/// @throws InvalidInput for fewer than 3 references or nodes, or a graph in pieces.
/// @note O(L n K) time and O(L^3); 8 L n bytes.
Embedding landmark_isomap(const Graph& graph, const LandmarkIsomapOptions& options = {});

/// Reference landmarks, and the lengths of the shortest paths from each to all.
struct References {
  std::vector<Eigen::Index> nodes;
  Eigen::MatrixXd lengths;  ///< n x L.
};

/// Each reference is the farthest from those before (MaxMin), the first one the farthest from the
/// first node [silva2004].
References farthest_references(const Graph& graph, Eigen::Index count);

/// The K nearest of each landmark in histories whose distances are no array: those of
/// nearest_neighbours() of the array.
/// @throws InvalidInput if K is not in [1, n).
/// @note One visit of the distances; O(n K) memory.
NeighbourLists nearest_neighbours(const HistoryDistances& distances,
                                  const NeighbourOptions& options);

/// Their graph from the first K of each list, its pieces joined by their shortest bridges: that of
/// connected_neighbour_graph() of the array, and kArbitraryNeighbours where the neighbours were
/// chosen among landmarks never seen together.
/// @note A visit of the distances if the graph is in pieces.
ConnectedGraph connected_neighbour_graph(const HistoryDistances& distances,
                                         const NeighbourLists& nearest, int neighbours);

}  // namespace mapproof
