#pragma once

#include <functional>

#include "core/embed/connected_graph.hpp"
#include "core/embed/lle.hpp"
#include "core/model/certificate.hpp"
#include "core/model/embedding.hpp"
#include "core/observe/history_distances.hpp"

namespace mapproof {

/// How landmark MVU approximates maximum variance unfolding, which is SDE. The paper's "landmarks"
/// are reference landmarks here: all of ours are landmarks.
struct LandmarkMvuOptions {
  /// l, the landmarks whose inner products the program solves for, >= 3; more than there are: all.
  int references = 20;
  LleOptions weights = {};              ///< Of the reconstruction.
  double relative_gap = kCertifiedGap;  ///< To be certified, in (0, 1).
};

/// The distance between two landmarks.
using PairDistance = std::function<double(Eigen::Index, Eigen::Index)>;

/// Landmark maximum variance unfolding [weinberger2005]: the points of greatest variance among
/// those that the positions of l reference landmarks determine, by the weights that blend each
/// landmark from its neighbours (see lle()), and of which no two neighbours, nor two neighbours of
/// one landmark, are farther from each other than in the data.
///
/// The references are those of landmark_isomap(), so far as they do not coincide. The inner products
/// are Q L Q' with L of l x l; distances are bounded, not kept, since points of that form cannot
/// keep all of them. Pairs enter the program as they are found to be too far apart.
/// @param graph  In one piece, n >= 3 nodes.
/// @param nearest  The K nearest of each landmark; the pairs within {i} and its K nearest, for every
///        i, and the edges of the graph are bounded.
/// @param distance  Between two landmarks of such a pair, or that have a neighbour in the graph in
///        common; infinite: not bounded.
/// @return Centred, columns orthogonal, in descending order of spread; the spectrum holds up to 10
///         eigenvalues. The certificate is that of the program over the references: its variance
///         and the least bound on it; no pair is too far apart. kRankDeficient and kUncertified as
///         sde().
/// @throws InvalidInput if the bounds above are broken.
/// @note O(l^2) time for each pair and O(p^3) for p of them, some 10 l, in each of some 20 steps of
///       some 10 programs; a sparse Cholesky factor of n rows. 8 l n bytes besides.
Embedding landmark_mvu(const Graph& graph, const NeighbourLists& nearest,
                       const PairDistance& distance, const LandmarkMvuOptions& options = {});

/// The distances of all pairs within {i} and the neighbours of i in the graph, for every i, in
/// histories whose distances are no array: those that landmark_mvu() asks for.
/// @return Outlives what it is given; infinite for other pairs.
/// @note One visit of the distances; 24 bytes for each pair.
PairDistance neighbourhood_distances(const HistoryDistances& histories, const Graph& graph);

}  // namespace mapproof
