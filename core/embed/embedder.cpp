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

/// What went wrong with the map that `result` started from, unless it says the same of itself.
void add_statuses_of_start(Embedding& result, const Embedding& start, std::string_view name) {
  std::vector<Status> added;
  for (const Status& status : start.statuses)
    if (std::ranges::find(result.statuses, status.code, &Status::code) == result.statuses.end())
      added.push_back({status.code, fmt::format("Its start, {}: {}", name, status.detail)});
  result.statuses.insert(result.statuses.begin(), added.begin(), added.end());
}

/// "L3, L7", at most ten of them.
std::string listed(const std::vector<std::string>& names, const std::vector<Eigen::Index>& rows) {
  constexpr std::size_t kShown = 10;
  std::string list;
  for (std::size_t i = 0; i < std::min(rows.size(), kShown); ++i)
    list += (i == 0 ? "" : ", ") + names[static_cast<std::size_t>(rows[i])];
  return rows.size() > kShown ? fmt::format("{} and {} more", list, rows.size() - kShown) : list;
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
  const Embedding& start = equal_weights();
  Embedding result =
      smacof(complete_distances_, adjacency(graph.graph), start.coordinates, options_.smacof_knn);
  add_statuses_of_start(result, start, info(Method::kSmacof).label);
  result.statuses.insert(result.statuses.begin(), graph.statuses.begin(), graph.statuses.end());
  return result;
}

const Embedding& Embedder::linear() {
  if (!linear_) linear_ = lpca(complete_distances_.cwiseAbs2());
  return *linear_;
}

const Embedding& Embedder::equal_weights() {
  if (!equal_weights_) {
    equal_weights_ = smacof(complete_distances_, {}, linear().coordinates, options_.smacof);
    add_statuses_of_start(*equal_weights_, linear(), info(Method::kLpca).label);
  }
  return *equal_weights_;
}

HistoryEmbedder::HistoryEmbedder(const ObservationHistory& history, Eigen::Index steps,
                                 EmbedderOptions options)
    : landmarks_(history.landmarks()) {
  const std::vector<Eigen::Index> unseen = unseen_landmarks(history, steps);
  for (Eigen::Index i = 0; i < landmarks_; ++i)
    if (!std::ranges::binary_search(unseen, i)) seen_.push_back(i);
  if (!unseen.empty())
    statuses_.push_back(
        {StatusCode::kLandmarkUnseen,
         fmt::format("{} of {} landmarks were never observed and are not on the map: {}.",
                     unseen.size(), landmarks_, listed(history.names, unseen))});
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
