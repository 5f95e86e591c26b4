#include "core/submaps/submap_embedding.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/graph/components.hpp"
#include "core/graph/shortest_paths.hpp"
#include "core/statistics/intervals.hpp"
#include "core/submaps/join.hpp"

namespace mapproof {
namespace {

using Rows = std::vector<Eigen::Index>;

/// Along the neighbour graph; pieces of it are further apart than anything within them.
Eigen::MatrixXd paths_of(const Eigen::MatrixXd& distances, int neighbours) {
  const auto K = static_cast<int>(std::min<Eigen::Index>(neighbours, distances.rows() - 1));
  Graph graph = neighbour_graph(distances, {.neighbours = K});
  bridge_components(graph, distances);
  Eigen::MatrixXd paths = shortest_paths(graph);
  double longest = 0.0;
  for (const double path : paths.reshaped())
    if (std::isfinite(path)) longest = std::max(longest, path);
  return paths.array().isFinite().select(paths, 2.0 * longest + 1.0);
}

Eigen::Index furthest_from(const Eigen::MatrixXd& paths, Eigen::Index from, const Rows& among) {
  return *std::ranges::max_element(
      among, [&](Eigen::Index a, Eigen::Index b) { return paths(a, from) < paths(b, from); });
}

/// Splits `rows` into `parts` of like size.
void divide(const Eigen::MatrixXd& paths, Rows rows, std::size_t parts, std::vector<Rows>& out) {
  if (parts <= 1) {
    std::ranges::sort(rows);
    out.push_back(std::move(rows));
    return;
  }
  const Eigen::Index a = furthest_from(paths, rows.front(), rows);
  const Eigen::Index b = furthest_from(paths, a, rows);
  const auto side = [&](Eigen::Index i) { return paths(i, a) - paths(i, b); };
  std::ranges::sort(rows, [&](Eigen::Index i, Eigen::Index j) {
    return side(i) < side(j) || (side(i) == side(j) && i < j);
  });
  const std::size_t first_parts = parts / 2;
  const auto cut = static_cast<std::ptrdiff_t>(rows.size() * first_parts / parts);
  divide(paths, Rows(rows.begin(), rows.begin() + cut), first_parts, out);
  divide(paths, Rows(rows.begin() + cut, rows.end()), parts - first_parts, out);
}

/// `own` and the nearest others, `size` in all.
Rows grown(const Eigen::MatrixXd& paths, const Rows& own, std::size_t size) {
  const Eigen::VectorXd nearness = paths(Eigen::all, own).rowwise().minCoeff();
  Rows order(static_cast<std::size_t>(paths.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, [&](Eigen::Index i, Eigen::Index j) {
    const bool i_own = std::ranges::binary_search(own, i);
    const bool j_own = std::ranges::binary_search(own, j);
    if (i_own != j_own) return i_own;
    return nearness(i) < nearness(j) || (nearness(i) == nearness(j) && i < j);
  });
  order.resize(std::min(size, order.size()));
  std::ranges::sort(order);
  return order;
}

/// Of some rows, without the steps that show none of them.
ObservationHistory seen_by(const ObservationHistory& history, Eigen::Index steps,
                           const std::vector<Eigen::Index>& rows) {
  ObservationHistory part = with_rows(history, rows);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index t = 0; t < steps; ++t)
    if (!part.values.col(t).array().isNaN().all()) kept.push_back(t);
  if (kept.empty()) kept.push_back(0);
  part.values = Eigen::MatrixXd(part.values(Eigen::all, kept));
  return part;
}

/// The setting with a number of neighbours that is possible for a group of that size.
MethodSetting fitting(MethodSetting setting, std::size_t size) {
  if (on_graph(setting.method) && setting.parameter)
    setting.parameter = std::min(*setting.parameter, static_cast<double>(size) - 1.0);
  return setting;
}

/// Sub-maps with a position for every landmark that got one, and the first status of each code with
/// its count.
struct Mapped {
  std::vector<Submap> maps;
  std::map<StatusCode, Status> statuses;
  int failed = 0;
};

void add_map(const Embedding& embedding, const std::vector<Eigen::Index>& members, Mapped& mapped) {
  for (const Status& status : embedding.statuses) {
    Status& first = mapped.statuses.try_emplace(status.code, status).first->second;
    if (!first.submaps) first.submaps.emplace();
    ++first.submaps->count;
  }
  Submap map;
  std::vector<Eigen::Index> rows;
  for (std::size_t k = 0; k < members.size(); ++k)
    if (embedding.coordinates.row(static_cast<Eigen::Index>(k)).allFinite()) {
      map.landmarks.push_back(members[k]);
      rows.push_back(static_cast<Eigen::Index>(k));
    }
  if (rows.empty()) {
    ++mapped.failed;
    return;
  }
  map.positions = embedding.coordinates(rows, Eigen::all);
  mapped.maps.push_back(std::move(map));
}

std::vector<Status> statuses_of(const Mapped& mapped, std::size_t groups) {
  std::vector<Status> statuses;
  for (const auto& [code, first] : mapped.statuses) {
    Status& status = statuses.emplace_back(first);
    status.submaps->submaps = static_cast<int>(groups);
    // A sub-map that failed does not fail the whole.
    if (code == StatusCode::kFailed && !mapped.maps.empty())
      status.code = StatusCode::kTooFewObservations;
  }
  return statuses;
}

double median_residual(const std::vector<SubmapJoin>& joins) {
  std::vector<double> residuals;
  for (const SubmapJoin& join : joins)
    if (std::isfinite(join.residual)) residuals.push_back(join.residual);
  return residuals.empty() ? kNaN : median(residuals);
}

}  // namespace

std::vector<LandmarkGroup> overlapping_groups(const Eigen::MatrixXd& distances,
                                              const GroupOptions& options) {
  if (options.size < 6 || options.neighbours < 1 ||
      !(options.overlap_share >= 0.0 && options.overlap_share <= 0.8))
    throw InvalidInput("groups need 6 landmarks or more and share 0 to 80 % of them");
  const Eigen::Index M = distances.rows();
  Rows all(static_cast<std::size_t>(M));
  std::iota(all.begin(), all.end(), 0);
  if (M <= options.size) return {{.own = all, .members = all}};
  const Eigen::MatrixXd paths = paths_of(distances, options.neighbours);
  const double part_size = std::max(1.0, std::floor(options.size * (1.0 - options.overlap_share)));
  const auto parts = static_cast<std::size_t>(std::ceil(static_cast<double>(M) / part_size));
  std::vector<Rows> owned;
  divide(paths, all, parts, owned);
  std::vector<LandmarkGroup> groups;
  for (const Rows& own : owned)
    groups.push_back(
        {.own = own, .members = grown(paths, own, static_cast<std::size_t>(options.size))});
  return groups;
}

bool joined_by_affine(Method method) {
  return method == Method::kLle || method == Method::kLaplacianEigenmap ||
         method == Method::kHessianLle || method == Method::kKpcaGaussian ||
         method == Method::kKpcaPolynomial;
}

SubmapEmbedding embed_submaps(const ObservationHistory& history, Eigen::Index steps,
                              const MethodSetting& setting, const SubmapOptions& options) {
  const Eigen::Index M = history.landmarks();
  const std::vector<Eigen::Index> seen = seen_landmarks(history, steps);
  SubmapEmbedding result;
  result.embedding.coordinates.setConstant(M, 2, kNaN);
  result.median_residual = kNaN;
  Mapped mapped;
  std::vector<LandmarkGroup> groups;
  if (seen.size() > 1) {
    const Proximities all = proximities(with_rows(history, seen), steps);
    groups = overlapping_groups(all.squared_distances.cwiseSqrt(), options.groups);
  }
  for (const LandmarkGroup& group : groups) {
    std::vector<Eigen::Index> rows;
    for (const Eigen::Index member : group.members)
      rows.push_back(seen[static_cast<std::size_t>(member)]);
    const ObservationHistory part = seen_by(history, steps, rows);
    HistoryEmbedder embedder(part, part.steps(), options.embedder, options.rule);
    add_map(embedder.embed(fitting(setting, rows.size())), rows, mapped);
  }
  result.embedding.statuses = statuses_of(mapped, groups.size());
  if (const Eigen::Index unseen = M - std::ssize(seen); unseen > 0)
    result.embedding.statuses.push_back(status_of<StatusReason::kNeverObserved>(unseen, M));
  if (mapped.maps.empty()) {
    result.embedding.statuses.push_back(status_of<StatusReason::kNoSubmap>());
    return result;
  }
  JoinResult joined =
      join_submaps(std::move(mapped.maps),
                   joined_by_affine(setting.method) ? JoinKind::kAffine : JoinKind::kSimilarity, M);
  result.joined = std::move(joined.joined);
  result.embedding.coordinates = result.joined.positions;
  result.embedding.statuses.insert(result.embedding.statuses.end(), joined.statuses.begin(),
                                   joined.statuses.end());
  result.median_residual = median_residual(result.joined.joins);
  return result;
}

}  // namespace mapproof
