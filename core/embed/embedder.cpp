#include "core/embed/embedder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/embed/bottom_eigenmap.hpp"
#include "core/embed/connected_graph.hpp"
#include "core/embed/isomap.hpp"
#include "core/embed/lle.hpp"
#include "core/embed/pca.hpp"
#include "core/embed/sde/sde.hpp"
#include "core/graph/shortest_paths.hpp"
#include "core/linalg/unset_matrix.hpp"
#include "core/observe/bit_rows.hpp"
#include "core/observe/detected_proximities.hpp"
#include "core/observe/history_distances.hpp"
#include "core/observe/history_vectors.hpp"
#include "core/observe/seen_lists.hpp"

namespace mapproof {
namespace {

Embedding failed(Eigen::Index landmarks, Status why) {
  Embedding result;
  result.coordinates.setConstant(landmarks, 2, kNaN);
  result.statuses.push_back(std::move(why));
  return result;
}

/// The warnings of the map that `result` started from, except those it has itself.
void add_statuses_of_start(Embedding& result, const Embedding& start, Method method) {
  std::vector<Status> added;
  for (const Status& status : start.statuses)
    if (std::ranges::find(result.statuses, status.code, &Status::code) == result.statuses.end()) {
      added.push_back(status);
      added.back().starts.insert(added.back().starts.begin(), method);
    }
  result.statuses.insert(result.statuses.begin(), added.begin(), added.end());
}

/// The median of the finite entries above zero below the diagonal; 1 if there is none.
double median_beside_diagonal(const Eigen::MatrixXd& matrix) {
  std::vector<double> values;
  for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    for (Eigen::Index i = j + 1; i < matrix.rows(); ++i)
      if (std::isfinite(matrix(i, j)) && matrix(i, j) > 0.0) values.push_back(matrix(i, j));
  if (values.empty()) return 1.0;
  return upper_median(std::move(values));
}

double two_digits(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::round(value / unit) * unit;
}

/// Why so many landmarks are not enough; empty if they are.
std::optional<Status> too_few(const MethodSetting& setting, Eigen::Index n) {
  if (n < 3) return status_of<StatusReason::kTooFewLandmarks>(n);
  if (on_graph(setting.method) && setting.parameter.value_or(0.0) >= static_cast<double>(n))
    return status_of<StatusReason::kTooManyNeighbours>(setting.parameter.value_or(0.0), n);
  return std::nullopt;
}

/// All landmarks at one position.
Embedding point_map(Eigen::Index landmarks) {
  Embedding point;
  point.coordinates.setZero(landmarks, 2);
  point.statuses.push_back(status_of<StatusReason::kSameObservations>());
  return point;
}

/// The first K of each list.
NeighbourLists first_of(NeighbourLists nearest, int neighbours) {
  for (std::vector<Edge>& edges : nearest)
    if (std::ssize(edges) > neighbours) edges.resize(static_cast<std::size_t>(neighbours));
  return nearest;
}

Eigen::MatrixXd adjacency(const Graph& graph) {
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(std::ssize(graph), std::ssize(graph));
  for (std::size_t i = 0; i < graph.size(); ++i)
    for (const Edge& edge : graph[i]) weights(static_cast<Eigen::Index>(i), edge.to) = 1.0;
  return weights;
}

}  // namespace

Embedder::Embedder(Proximities proximities, EmbedderOptions options)
    : options_(options), proximities_(std::move(proximities)) {
  const auto infinite = [](const Eigen::MatrixXd& D) {
    return (!D.array().isFinite()).count() / 2;
  };
  completed_pairs_ = infinite(proximities_.squared_distances);
  if (completed_pairs_ > 0) {
    completed_distances_ = completed_distances(distances());
    completed_squares_ = completed_distances_.cwiseAbs2();
    seen_apart_ = infinite(completed_distances_) > 0;
  }
  apart_ = std::sqrt(proximities_.apart_squared) * (1.0 - 1e-12);
  groups_ = groups_seen_together(proximities_.squared_distances, proximities_.apart_squared);
  cutoff_ = options_.only_seen_together ? apart_ : kInfinity;
}

const Eigen::MatrixXd& Embedder::distances() {
  if (distances_.size() == 0) {
    distances_ = unset_matrix(size(), size());
    distances_ = proximities_.squared_distances.cwiseSqrt();
  }
  return distances_;
}

const Eigen::MatrixXd& Embedder::complete_distances() {
  return completed_pairs_ > 0 ? completed_distances_ : distances();
}

const Eigen::MatrixXd& Embedder::complete_squares() const {
  return completed_pairs_ > 0 ? completed_squares_ : proximities_.squared_distances;
}

Embedding Embedder::embed(const MethodSetting& setting) {
  const Eigen::Index n = size();
  if (const auto why_not = obstacle(setting)) return failed(n, *why_not);
  if (complete_squares().maxCoeff() == 0.0) return with_all_distances(point_map(n));
  Embedding result = solve(setting);
  for (Status& status : caveats(result, setting)) result.statuses.push_back(std::move(status));
  return result;
}

/// What the observations do not determine whatever the method.
std::vector<Status> Embedder::caveats(const Embedding& map, const MethodSetting& setting) {
  std::vector<Status> statuses;
  if (std::ranges::find(map.statuses, StatusCode::kFailed, &Status::code) != map.statuses.end())
    return statuses;
  if (groups_ > 1) statuses.push_back(status_of<StatusReason::kGroupsNeverTogether>(groups_));
  if (!on_graph(setting.method)) return statuses;
  const int neighbours = static_cast<int>(setting.parameter.value_or(0.0));
  if (auto status = arbitrary_neighbours(nearest(neighbours), neighbours, apart_))
    statuses.push_back(std::move(*status));
  return statuses;
}

MethodSetting Embedder::usual_setting(Method method) const {
  const std::optional<ParameterInfo>& parameter = info(method).parameter;
  if (!parameter) return {method, std::nullopt};
  if (parameter->counts_neighbours) return {method, usual_neighbours(size())};
  if (method == Method::kKpcaPolynomial) return {method, 2.0};
  const double median = median_beside_diagonal(complete_squares());
  return {method, std::clamp(two_digits(median), parameter->minimum, parameter->maximum)};
}

/// Why the method cannot give a map of these data; empty if it can.
std::optional<Status> Embedder::obstacle(const MethodSetting& setting) const {
  if (auto few = too_few(setting, size())) return few;
  if (seen_apart_) return status_of<StatusReason::kNoSharedObservation>();
  return std::nullopt;
}

Embedding Embedder::solve(const MethodSetting& setting) {
  const double parameter = setting.parameter.value_or(0.0);
  const int count = static_cast<int>(std::min(parameter, 1e6));
  switch (setting.method) {
    case Method::kLpca:
      return with_all_distances(linear());
    case Method::kSmacof:
      return with_all_distances(equal_weights());
    case Method::kSmacofKnn:
      return with_all_distances(weighted_smacof(count));
    case Method::kKpcaGaussian:
      return with_all_distances(
          kernel_pca(complete_squares(), GaussianKernel{.variance = parameter}));
    case Method::kKpcaPolynomial: {
      const PolynomialKernel kernel{.degree = count};
      return with_all_distances(completed_pairs_ > 0
                                    ? kernel_pca(completed_inner_products(), kernel)
                                    : kernel_pca(proximities_.inner_products, kernel));
    }
    case Method::kIsomap:
    case Method::kLandmarkIsomap:
    case Method::kLaplacianEigenmap:
    case Method::kLandmarkMvu:
      return on_graph_of(setting.method, count);
    case Method::kLle:
    case Method::kHessianLle:
      return with_all_distances(on_neighbourhoods(setting.method, count));
    case Method::kSde:
      return sde(distances(), {.neighbours = {.neighbours = count, .cutoff = cutoff_}});
  }
  throw InvalidInput("unknown method");
}

Embedding Embedder::with_all_distances(Embedding embedding) const {
  if (completed_pairs_ > 0)
    embedding.statuses.push_back(status_of<StatusReason::kNoCommonStep>(completed_pairs_));
  return embedding;
}

Embedding Embedder::weighted_smacof(int neighbours) {
  const ConnectedGraph graph =
      connected_neighbour_graph(distances(), nearest(neighbours), neighbours);
  if (!graph.connected) return failed(size(), graph.statuses.front());
  const Embedding& start = equal_weights();
  Embedding result =
      smacof(complete_distances(), adjacency(graph.graph), start.coordinates, options_.smacof_knn);
  add_statuses_of_start(result, start, Method::kSmacof);
  result.statuses.insert(result.statuses.begin(), graph.statuses.begin(), graph.statuses.end());
  return result;
}

Embedding Embedder::on_graph_of(Method method, int neighbours) {
  const ConnectedGraph graph =
      connected_neighbour_graph(distances(), nearest(neighbours), neighbours);
  if (!graph.connected) return failed(size(), graph.statuses.front());
  Embedding result = method == Method::kIsomap              ? isomap(graph.graph)
                     : method == Method::kLaplacianEigenmap ? laplacian_eigenmap(graph.graph)
                                                            : by_references(method, graph, neighbours);
  result.statuses.insert(result.statuses.begin(), graph.statuses.begin(), graph.statuses.end());
  return result;
}

Embedding Embedder::by_references(Method method, const ConnectedGraph& graph, int neighbours) {
  if (method == Method::kLandmarkIsomap)
    return landmark_isomap(graph.graph, options_.landmark_isomap);
  const auto distance = [&D = distances()](Eigen::Index i, Eigen::Index j) { return D(i, j); };
  return landmark_mvu(graph.graph, first_of(nearest(neighbours), neighbours), distance,
                      options_.landmark_mvu);
}

Embedding Embedder::on_neighbourhoods(Method method, int neighbours) {
  const Eigen::Index n = size();
  const bool hessian = method == Method::kHessianLle;
  if (hessian && neighbours < kFewestHessianNeighbours)
    return failed(
        n, status_of<StatusReason::kHessianNeighbours>(kFewestHessianNeighbours, neighbours));
  ConnectedGraph graph = connected_neighbourhoods(distances(), nearest(neighbours), neighbours);
  if (!graph.connected) return failed(n, graph.statuses.front());
  if (hessian)
    tie_sets(graph);
  else
    tie_blends(graph, distances());
  const auto few = std::ranges::count_if(graph.graph, [](const std::vector<Edge>& edges) {
    return std::ssize(edges) < kFewestHessianNeighbours;
  });
  if (hessian && few > 0)
    return failed(n,
                  status_of<StatusReason::kHessianNeighbourhoods>(kFewestHessianNeighbours, few));
  Embedding result = hessian ? hessian_lle(complete_squares(), graph.graph)
                             : lle(complete_squares(), graph.graph, options_.lle);
  result.statuses.insert(result.statuses.begin(), graph.statuses.begin(), graph.statuses.end());
  return result;
}

/// Sorted once for all K up to some: most studies use one K after another.
const NeighbourLists& Embedder::nearest(int neighbours) {
  constexpr int kUsual = 16;
  if (nearest_count_ < neighbours) {
    nearest_count_ =
        static_cast<int>(std::min<Eigen::Index>(std::max(neighbours, kUsual), size() - 1));
    nearest_ = nearest_neighbours(distances(), {.neighbours = nearest_count_, .cutoff = cutoff_});
  }
  return nearest_;
}

/// Those of pairs that are never co-visible as their completed distances have them.
Eigen::MatrixXd Embedder::completed_inner_products() const {
  const Eigen::VectorXd squares = proximities_.inner_products.diagonal();
  const Eigen::MatrixXd completed =
      0.5 * (squares.replicate(1, squares.size()) +
             squares.transpose().replicate(squares.size(), 1) - complete_squares());
  return proximities_.squared_distances.array().isFinite().select(proximities_.inner_products,
                                                                  completed);
}

const Embedding& Embedder::linear() {
  if (!linear_) linear_ = lpca(complete_squares());
  return *linear_;
}

const Embedding& Embedder::equal_weights() {
  if (!equal_weights_) {
    equal_weights_ = smacof(complete_distances(), {}, linear().coordinates, options_.smacof);
    add_statuses_of_start(*equal_weights_, linear(), Method::kLpca);
  }
  return *equal_weights_;
}

bool maps_by_vectors(Method method, const HistoryExtent& history) {
  if (method != Method::kLpca || history.misses_any || history.steps < kFewestSteps) return false;
  const Eigen::Index columns = history.sensor == Sensor::kBearing ? 2 * history.steps
                                                                  : history.steps;
  return history.sensor == Sensor::kVisibility
             ? history.is_list
             : is_faster_by_vectors(history.landmarks, columns);
}

double needed_bytes(Method method, Eigen::Index landmarks, const EmbedderOptions& options) {
  // Arrays of landmarks x landmarks that are held at the same time. Measured: ISOMAP of 5000
  // landmarks takes 1327 MiB.
  constexpr double kArrays = 6.0;
  constexpr double kOfLandmark = 1000.0;  // Its neighbours, and the edges of the graph.
  const auto M = static_cast<double>(landmarks);
  if (!has_references(method)) return 8.0 * kArrays * M * M;
  constexpr double kOfReferences = 5.0;
  if (method == Method::kLandmarkIsomap) {
    // Paths to the references; distances between them, their products and eigenvectors.
    const double L = std::min<double>(options.landmark_isomap.references, M);
    return M * (8.0 * L + kOfLandmark) + 8.0 * kOfReferences * L * L;
  }
  // The pairs of neighbourhoods, the sparse factor of the weights, and some arrays of landmarks x
  // references; the programs of pairs x pairs.
  constexpr double kOfNeighbourhood = 20000.0, kPairs = 20.0;
  const double l = std::min<double>(options.landmark_mvu.references, M);
  return M * (8.0 * kOfReferences * l + kOfNeighbourhood) + 16.0 * kPairs * kPairs * l * l;
}

double needed_bytes(Method method, const HistoryExtent& history, const EmbedderOptions& options) {
  if (!maps_by_vectors(method, history)) return needed_bytes(method, history.landmarks, options);
  // Two blocks of the history with their vectors, or all vectors; and the eigenvectors' span.
  constexpr double kBlocks = 8e8, kOfLandmark = 3000.0;
  return std::min(kBlocks, 24.0 * static_cast<double>(history.landmarks) *
                               static_cast<double>(history.steps)) +
         kOfLandmark * static_cast<double>(history.landmarks);
}

double usual_neighbours(Eigen::Index landmarks) {
  return std::clamp(static_cast<double>(landmarks - 1), 1.0, 6.0);
}

Embedding embed_large(const HistoryDistances& distances, const MethodSetting& setting,
                      const EmbedderOptions& options) {
  const Eigen::Index n = distances.landmarks;
  if (const auto few = too_few(setting, n)) return failed(n, *few);
  const int neighbours = static_cast<int>(setting.parameter.value_or(0.0));
  const double apart = distances.apart * (1.0 - 1e-12);
  const NeighbourLists nearest = nearest_neighbours(
      distances,
      {.neighbours = neighbours, .cutoff = options.only_seen_together ? apart : kInfinity});
  const ConnectedGraph graph = connected_neighbour_graph(distances, nearest, neighbours);
  if (!graph.connected) return failed(n, graph.statuses.front());
  const bool is_point = std::ranges::all_of(graph.graph, [](const std::vector<Edge>& edges) {
    return std::ranges::all_of(edges, [](const Edge& edge) { return edge.length == 0.0; });
  });
  if (is_point) return point_map(n);
  Embedding result = setting.method == Method::kLandmarkIsomap
                         ? landmark_isomap(graph.graph, options.landmark_isomap)
                         : landmark_mvu(graph.graph, nearest,
                                        neighbourhood_distances(distances, graph.graph),
                                        options.landmark_mvu);
  if (distances.groups > 1)
    result.statuses.push_back(status_of<StatusReason::kGroupsNeverTogether>(distances.groups));
  // As of Embedder: what the graph took first, what the observations do not determine last.
  for (const Status& status : graph.statuses)
    result.statuses.insert(status.code == StatusCode::kArbitraryNeighbours
                               ? result.statuses.end()
                               : result.statuses.begin(),
                           status);
  return result;
}

namespace {

/// Which landmarks of a history can be mapped, and why the others cannot.
struct SeenLandmarks {
  std::vector<Eigen::Index> rows;
  std::vector<Status> statuses;
};

SeenLandmarks seen_by(const HistoryBlocks& history, Eigen::Index steps) {
  const std::vector<Eigen::Index> unseen = unseen_landmarks(history, steps);
  SeenLandmarks seen{.rows = other_rows(unseen, history.landmarks()), .statuses = {}};
  if (!unseen.empty())
    seen.statuses.push_back(status_of<StatusReason::kNeverObserved>(
        history.only(unseen).names(), unseen.size(), history.landmarks()));
  if (steps < kFewestSteps)
    seen.statuses.push_back(status_of<StatusReason::kFewSteps>(steps, kFewestSteps));
  return seen;
}

/// The map of those rows as one of all landmarks, with those statuses.
Embedding in_all_rows(Embedding result, const std::vector<Eigen::Index>& rows,
                      Eigen::Index landmarks, const std::vector<Status>& statuses) {
  if (statuses.empty()) return result;
  const Points mapped = std::move(result.coordinates);
  result.coordinates.setConstant(landmarks, 2, kNaN);
  result.coordinates(rows, Eigen::all) = mapped;
  result.statuses.insert(result.statuses.end(), statuses.begin(), statuses.end());
  return result;
}

/// The linear map of products with the vectors; empty if they are all alike, or on one line, which
/// is left to their distances where these take little.
std::optional<Embedding> linear_map(const HistoryVectors& vectors) {
  constexpr Eigen::Index kFew = 5000;
  Embedding map = lpca_of_vectors(vectors);
  if (!map.statuses.empty() && vectors.landmarks <= kFew) return std::nullopt;
  return map;
}

std::optional<Embedding> linear_map(const SeenLists& seen) {
  std::optional<Embedding> map = linear_map(visibility_vectors(seen));
  if (map && seen.groups() > 1)
    map->statuses.push_back(status_of<StatusReason::kGroupsNeverTogether>(seen.groups()));
  return map;
}

}  // namespace

HistoryEmbedder::HistoryEmbedder(const HistoryBlocks& history, Eigen::Index steps,
                                 EmbedderOptions options, const ProximityRule& rule)
    : landmarks_(history.landmarks()) {
  SeenLandmarks found = seen_by(history, steps);
  seen_ = std::move(found.rows);
  statuses_ = std::move(found.statuses);
  const HistoryBlocks seen = history.only(seen_);
  if (seen_.empty())
    embedder_.emplace(Proximities{}, options);
  else if (rule)
    embedder_.emplace(rule(array_of(seen), steps), options);
  else
    embedder_.emplace(proximities(seen, steps), options);
}

Embedding HistoryEmbedder::embed(const MethodSetting& setting) {
  return in_all_rows(embedder_->embed(setting), seen_, landmarks_, statuses_);
}

Embedding embed_history(const HistoryBlocks& history, Eigen::Index steps, MethodSetting& setting,
                        const EmbedderOptions& options) {
  const bool is_large = has_references(setting.method);
  if (!is_large && setting.method != Method::kLpca) {
    HistoryEmbedder embedder(history, steps, options);
    if (!setting.parameter) setting = embedder.usual_setting(setting.method);
    return embedder.embed(setting);
  }
  const SeenLandmarks found = seen_by(history, steps);
  const HistoryBlocks seen = history.only(found.rows);
  const auto in_all = [&](Embedding map) {
    return in_all_rows(std::move(map), found.rows, history.landmarks(), found.statuses);
  };
  if (is_large) {
    if (!setting.parameter) setting.parameter = usual_neighbours(std::ssize(found.rows));
    return in_all(found.rows.empty()
                      ? failed(0, status_of<StatusReason::kTooFewLandmarks>(0))
                      : embed_large(history_distances(seen, steps), setting, options));
  }
  if (maps_by_vectors(setting.method, extent_of(seen, steps))) {
    const bool is_visibility = history.sensor() == Sensor::kVisibility;
    if (auto map = is_visibility ? linear_map(SeenLists(seen, steps))
                                 : linear_map(history_vectors(seen, steps)))
      return in_all(*std::move(map));
  }
  return HistoryEmbedder(history, steps, options).embed(setting);
}

Embedding embed_detected(const DetectionLog& log, Sensor sensor, MethodSetting& setting,
                         const EmbedderOptions& options) {
  const bool is_large = has_references(setting.method);
  if (is_large && sensor != Sensor::kVisibility)
    return embed_history(blocks_of(log, sensor), log.steps, setting, options);
  const auto with_few_steps = [&](Embedding map) {
    if (log.steps < kFewestSteps)
      map.statuses.push_back(status_of<StatusReason::kFewSteps>(log.steps, kFewestSteps));
    return map;
  };
  if (is_large) {
    if (!setting.parameter) setting.parameter = usual_neighbours(std::ssize(log.names));
    return with_few_steps(embed_large(visibility_distances(log), setting, options));
  }
  if (maps_by_vectors(setting.method, extent_of(log, sensor)))
    if (auto map = linear_map(SeenLists(log))) return *std::move(map);
  Embedder embedder(detected_proximities(log, sensor), options);
  if (!setting.parameter) setting = embedder.usual_setting(setting.method);
  return with_few_steps(embedder.embed(setting));
}

namespace {

/// LPCA by lists of what was seen takes less than by distances, which are counted, from so many
/// landmarks on, of which a quarter is seen: 0.017 s either way.
constexpr Eigen::Index kFewestAsLists = 1000;

bool are_faster_as_lists(const HistoryBlocks& history, Eigen::Index steps) {
  constexpr Eigen::Index kMostListed = 40'000'000;  // 320 MB; as many as history_vectors() holds.
  if (history.sensor() != Sensor::kVisibility || history.landmarks() < kFewestAsLists) return false;
  const HistoryBits bits = history_bits(history, steps);
  return bits.are_all && !bits.misses_any &&
         (bits.seen.ones() <= kMostListed || is_sparse_visibility(history, steps));
}

}  // namespace

HistoryExtent extent_of(const HistoryBlocks& history, Eigen::Index steps) {
  HistoryExtent extent{.sensor = history.sensor(),
                       .landmarks = history.landmarks(),
                       .steps = steps,
                       .misses_any = misses_any(history, steps)};
  extent.is_list = are_faster_as_lists(history, steps);
  return extent;
}

HistoryExtent extent_of(const DetectionLog& log, Sensor sensor) {
  // A list of what was seen is as short as its landmarks and steps allow; ranges and bearings of
  // it lack those that were not measured.
  const bool is_visibility = sensor == Sensor::kVisibility;
  return {.sensor = sensor,
          .landmarks = std::ssize(log.names),
          .steps = log.steps,
          .misses_any = !is_visibility,
          .is_list = is_visibility && std::ssize(log.names) >= kFewestAsLists};
}

}  // namespace mapproof
