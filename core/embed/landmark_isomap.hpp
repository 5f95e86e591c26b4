#pragma once

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

/// The neighbour graph of histories whose distances are no array, its pieces joined by their
/// shortest bridges: that of connected_neighbour_graph(), and kArbitraryNeighbours where the
/// neighbours were chosen among landmarks never seen together.
/// @throws InvalidInput if K is not in [1, n).
/// @note One visit of the distances, another one if the graph is in pieces; O(n K) memory.
ConnectedGraph connected_neighbour_graph(const HistoryDistances& distances,
                                         const NeighbourOptions& options);

}  // namespace mapproof
