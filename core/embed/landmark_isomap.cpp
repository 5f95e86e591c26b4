#include "core/embed/landmark_isomap.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/embed/pca.hpp"
#include "core/graph/shortest_paths.hpp"
#include "core/linalg/centering.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/linalg/sign.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

/// Centred, and rotated to the principal axes unless it is flat.
Points in_principal_axes(Points points) {
  points.rowwise() -= points.colwise().mean().eval();
  if (!points.col(1).isZero(0.0)) {
    const Eigen::Matrix2d scatter = points.transpose() * points;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(scatter);
    points = (points * axes.eigenvectors().rowwise().reverse()).eval();
  }
  fix_signs(points);
  return points;
}

}  // namespace

References farthest_references(const Graph& graph, Index count) {
  const Index n = std::ssize(graph);
  References references{.nodes = {}, .lengths = Eigen::MatrixXd(n, count)};
  PathSearch search(graph);
  Eigen::VectorXd nearest(n);  ///< Of the references so far.
  search.from(0, nearest.data());
  for (Index k = 0; k < count; ++k) {
    Index farthest = 0;
    nearest.maxCoeff(&farthest);
    references.nodes.push_back(farthest);
    search.from(farthest, references.lengths.col(k).data());
    nearest = k == 0 ? Eigen::VectorXd(references.lengths.col(0))
                     : Eigen::VectorXd(nearest.cwiseMin(references.lengths.col(k)));
    nearest(farthest) = -1.0;  // Where landmarks coincide, each is a reference once.
  }
  return references;
}

Embedding landmark_isomap(const Graph& graph, const LandmarkIsomapOptions& options) {
  if (options.references < 3)
    throw InvalidInput("Landmark ISOMAP needs 3 reference landmarks or more");
  const Index n = std::ssize(graph);
  if (n < 3) throw InvalidInput("Landmark ISOMAP needs 3 landmarks or more");
  const References references = farthest_references(graph, std::min<Index>(options.references, n));
  if (!references.lengths.col(0).allFinite())
    throw InvalidInput("Landmark ISOMAP needs a graph in one piece");

  // Classical scaling of the references. The two directions add the same edges in another order:
  // the lower sum serves for both.
  const Eigen::MatrixXd among = references.lengths(references.nodes, Eigen::all);
  const Eigen::MatrixXd squares = among.cwiseMin(among.transpose()).cwiseAbs2();
  Embedding result = principal_coordinates(double_centered(squares), squares.maxCoeff());

  // All landmarks by their squared lengths to the references: -1/2 L# (d - mean) with the rows
  // v'_k / sqrt(lambda_k) of L# [silva2004].
  const Points of_references = result.coordinates;
  const Eigen::RowVectorXd mean = squares.colwise().mean();
  result.coordinates.setZero(n, 2);
  for (Index k = 0; k < 2; ++k) {
    if (of_references.col(k).isZero(0.0)) continue;
    const Eigen::VectorXd pseudo_inverse = of_references.col(k) / result.spectrum(k);
    for (Index l = 0; l < std::ssize(references.nodes); ++l)
      result.coordinates.col(k).array() -=
          0.5 * pseudo_inverse(l) * (references.lengths.col(l).array().square() - mean(l));
  }
  result.coordinates = in_principal_axes(std::move(result.coordinates));
  return result;
}

NeighbourLists nearest_neighbours(const HistoryDistances& histories,
                                  const NeighbourOptions& options) {
  const VisitedDistances& distances = histories.distances;
  NearestLists gathered(histories.landmarks, options);
  distances.visit([&](Index i, std::span<const Edge> others) { gathered.take(i, others); });
  NeighbourLists nearest = std::move(gathered).lists();

  // The order of landmarks that are all equally far is that of their rows.
  if (distances.others < options.cutoff)
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      std::vector<Edge>& edges = nearest[i];
      if (std::ssize(edges) >= options.neighbours) continue;
      std::vector<Index> listed = {static_cast<Index>(i)};
      for (const Edge& edge : edges) listed.push_back(edge.to);
      std::ranges::sort(listed);
      for (Index j = 0; std::ssize(edges) < options.neighbours; ++j)
        if (!std::ranges::binary_search(listed, j)) edges.push_back({j, distances.others});
    }
  return nearest;
}

ConnectedGraph connected_neighbour_graph(const HistoryDistances& histories,
                                         const NeighbourLists& nearest, int neighbours) {
  ConnectedGraph result{.graph = neighbour_graph(nearest, neighbours), .statuses = {}};
  const auto bridging = bridge_components(result.graph, histories.distances);
  result.connected = bridging.has_value();
  if (!bridging)
    result.statuses.push_back(status_of<StatusReason::kNoSharedObservation>());
  else if (bridging->pieces > 1)
    result.statuses.push_back(status_of<StatusReason::kGraphInPieces>(
        neighbours, bridging->pieces, bridging->longest));
  const double apart = histories.apart * (1.0 - 1e-12);
  if (auto status = arbitrary_neighbours(nearest, neighbours, apart))
    result.statuses.push_back(std::move(*status));
  return result;
}

}  // namespace mapproof
