#include "core/embed/embedder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/embed/connected_graph.hpp"
#include "core/embed/isomap.hpp"
#include "core/embed/lpca.hpp"
#include "core/graph/shortest_paths.hpp"

namespace mapproof {
namespace {

Embedding failed(Eigen::Index landmarks, std::string why) {
  Embedding result;
  result.coordinates.setConstant(landmarks, 2, std::numeric_limits<double>::quiet_NaN());
  result.statuses.push_back({StatusCode::kFailed, std::move(why)});
  return result;
}

Eigen::MatrixXd adjacency(const Graph& graph) {
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(std::ssize(graph), std::ssize(graph));
  for (std::size_t i = 0; i < graph.size(); ++i)
    for (const Edge& edge : graph[i]) weights(static_cast<Eigen::Index>(i), edge.to) = 1.0;
  return weights;
}

}  // namespace

Embedder::Embedder(Proximities proximities, EmbedderOptions options)
    : options_(options), distances_(proximities.squared_distances.cwiseSqrt()) {
  const auto infinite = [](const Eigen::MatrixXd& D) {
    return (!D.array().isFinite()).count() / 2;
  };
  completed_pairs_ = infinite(distances_);
  complete_distances_ = completed_pairs_ > 0 ? completed_distances(distances_) : distances_;
  seen_apart_ = infinite(complete_distances_) > 0;
  // Normalised visibility vectors without a common sighting are at right angles.
  cutoff_ = options_.only_seen_together ? std::numbers::sqrt2 * (1.0 - 1e-12)
                                        : std::numeric_limits<double>::infinity();
}

Embedding Embedder::embed(const MethodSetting& setting) {
  const Eigen::Index n = distances_.rows();
  if (n < 3) return failed(n, fmt::format("A map needs 3 observed landmarks, {} are there.", n));
  const int neighbours = static_cast<int>(setting.parameter.value_or(0.0));
  if (info(setting.method).parameter && neighbours >= n)
    return failed(n, fmt::format("K = {} needs more than {} observed landmarks.", neighbours, n));
  if (seen_apart_)
    return failed(n,
                  "Some groups of landmarks share no observation: nothing tells where they lie "
                  "to each other.");

  switch (setting.method) {
    case Method::kLpca:
      return with_all_distances(linear());
    case Method::kSmacof:
      return with_all_distances(equal_weights());
    case Method::kSmacofKnn:
      return with_all_distances(weighted_smacof(neighbours));
    case Method::kIsomap:
      return isomap(distances_, {.neighbours = neighbours, .cutoff = cutoff_});
  }
  throw InvalidInput("unknown method");
}

Embedding Embedder::with_all_distances(Embedding embedding) const {
  if (completed_pairs_ > 0)
    embedding.statuses.push_back(
        {StatusCode::kDistancesCompleted,
         fmt::format("{} pairs of landmarks have no step in common; their distance is the shortest "
                     "path over the others.",
                     completed_pairs_)});
  return embedding;
}

Embedding Embedder::weighted_smacof(int neighbours) {
  const ConnectedGraph graph =
      connected_neighbour_graph(distances_, {.neighbours = neighbours, .cutoff = cutoff_});
  if (!graph.connected) return failed(distances_.rows(), graph.statuses.front().detail);
  Embedding result = smacof(complete_distances_, adjacency(graph.graph),
                            equal_weights().coordinates, options_.smacof_knn);
  result.statuses.insert(result.statuses.begin(), graph.statuses.begin(), graph.statuses.end());
  return result;
}

const Embedding& Embedder::linear() {
  if (!linear_) linear_ = lpca(complete_distances_.cwiseAbs2());
  return *linear_;
}

const Embedding& Embedder::equal_weights() {
  if (!equal_weights_)
    equal_weights_ = smacof(complete_distances_, {}, linear().coordinates, options_.smacof);
  return *equal_weights_;
}

HistoryEmbedder::HistoryEmbedder(const ObservationHistory& history, Eigen::Index steps,
                                 EmbedderOptions options)
    : landmarks_(history.landmarks()) {
  const std::vector<Eigen::Index> unseen = unseen_landmarks(history, steps);
  for (Eigen::Index i = 0; i < landmarks_; ++i)
    if (!std::ranges::binary_search(unseen, i)) seen_.push_back(i);
  if (!unseen.empty()) {
    std::string names;
    for (const Eigen::Index i : unseen)
      names += (names.empty() ? "" : ", ") + history.names[static_cast<std::size_t>(i)];
    statuses_.push_back(
        {StatusCode::kLandmarkUnseen,
         fmt::format("{} of {} landmarks were never observed and are not on the map: {}.",
                     unseen.size(), landmarks_, names)});
  }
  options.only_seen_together &= history.sensor == Sensor::kVisibility;
  if (seen_.empty()) {
    embedder_.emplace(Proximities{}, options);
  } else {
    embedder_.emplace(proximities(unseen.empty() ? history : with_rows(history, seen_), steps),
                      options);
  }
}

Embedding HistoryEmbedder::embed(const MethodSetting& setting) {
  Embedding result = embedder_->embed(setting);
  if (statuses_.empty()) return result;
  const Points mapped = std::move(result.coordinates);
  result.coordinates.setConstant(landmarks_, 2, std::numeric_limits<double>::quiet_NaN());
  result.coordinates(seen_, Eigen::all) = mapped;
  result.statuses.insert(result.statuses.end(), statuses_.begin(), statuses_.end());
  return result;
}

}  // namespace mapproof
