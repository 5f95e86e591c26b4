#include "core/missing/covisible.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/embed/isomap.hpp"
#include "core/graph/components.hpp"
#include "core/graph/shortest_paths.hpp"
#include "core/linalg/gram.hpp"

namespace mapproof {
namespace {

/// sqrt(2 - 2 cos) of the angle between two landmarks' lists of when they were observed.
Eigen::MatrixXd visibility_distances(const Eigen::MatrixXd& common, int least_common) {
  const Eigen::VectorXd counts = common.diagonal();
  Eigen::MatrixXd distances = Eigen::MatrixXd::Zero(common.rows(), common.cols());
  for (Eigen::Index j = 0; j < common.cols(); ++j)
    for (Eigen::Index i = 0; i < common.rows(); ++i) {
      if (i == j) continue;
      const double cosine = common(i, j) / std::sqrt(counts(i) * counts(j));
      distances(i, j) =
          common(i, j) >= least_common ? std::sqrt(std::max(0.0, 2.0 - 2.0 * cosine)) : kInfinity;
    }
  return distances;
}

Embedding failed(Eigen::Index landmarks, Status why) {
  Embedding result;
  result.coordinates.setConstant(landmarks, 2, kNaN);
  result.statuses.push_back(std::move(why));
  return result;
}

Graph graph_of(const Eigen::MatrixXd& squared_distances) {
  Graph graph(static_cast<std::size_t>(squared_distances.rows()));
  for (Eigen::Index i = 0; i < squared_distances.rows(); ++i)
    for (Eigen::Index j = 0; j < squared_distances.cols(); ++j)
      if (i != j && std::isfinite(squared_distances(i, j)))
        graph[static_cast<std::size_t>(i)].push_back({j, std::sqrt(squared_distances(i, j))});
  return graph;
}

/// 1 / d^2 off the diagonal; d is at least a small share of the largest.
Eigen::MatrixXd relative_weights(const Eigen::MatrixXd& distances) {
  const double least = 1e-3 * distances.maxCoeff();
  Eigen::MatrixXd weights = distances.cwiseMax(least).cwiseAbs2().cwiseInverse();
  weights.diagonal().setZero();
  return weights;
}

}  // namespace

Proximities covisible_proximities(const ObservationHistory& history, Eigen::Index steps,
                                  const CovisibleOptions& options) {
  if (options.neighbours < 1 || options.least_common < 1)
    throw InvalidInput("covisible pairs need one neighbour and one common step or more");
  if (history.sensor == Sensor::kVisibility)
    throw InvalidInput("covisible pairs need bearings or ranges, not visibility");
  Proximities result = proximities(history, steps);
  const Eigen::Index M = history.landmarks();
  const Eigen::MatrixXd seen =
      (!history.values.leftCols(steps).array().isNaN()).cast<double>().matrix();
  const Eigen::MatrixXd apart = visibility_distances(gram(seen), options.least_common);
  if (M < 2) return result;
  Graph graph = neighbour_graph(
      apart, {.neighbours = static_cast<int>(std::min<Eigen::Index>(options.neighbours, M - 1))});
  bridge_components(graph, apart);
  Eigen::MatrixXd joined = Eigen::MatrixXd::Constant(M, M, kInfinity);
  joined.diagonal().setZero();
  for (Eigen::Index i = 0; i < M; ++i)
    for (const Edge& edge : graph[static_cast<std::size_t>(i)])
      joined(i, edge.to) = result.squared_distances(i, edge.to);
  result.squared_distances = std::move(joined);
  return result;
}

Embedding relative_stress_map(const Proximities& proximities, const SmacofOptions& options) {
  const Graph graph = graph_of(proximities.squared_distances);
  const Eigen::MatrixXd distances = shortest_paths(graph);
  const Eigen::Index M = distances.rows();
  if (M < 3) return failed(M, status_of<StatusReason::kTooFewLandmarks>(M));
  if (!distances.allFinite()) return failed(M, status_of<StatusReason::kTrustedPairsInPieces>());
  Embedding start = isomap(graph);
  if (distances.maxCoeff() <= 0.0) return start;
  Embedding result = smacof(distances, relative_weights(distances), start.coordinates, options);
  result.statuses.insert(result.statuses.begin(), start.statuses.begin(), start.statuses.end());
  return result;
}

}  // namespace mapproof
