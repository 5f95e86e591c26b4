#include "core/association/robust_map.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/embed/pca.hpp"
#include "core/embed/smacof.hpp"
#include "core/graph/components.hpp"
#include "core/graph/shortest_paths.hpp"

namespace mapproof {
namespace {

constexpr double kWidths = 1.5;       ///< Standard deviations in RobustMap::width_m.
constexpr double kFewestScans = 3.0;  ///< Of a pair that the start of a map is made of,
constexpr int kPairsToPlace = 3;      ///< if each of its landmarks has so many.
constexpr int kMostLandmarks = 2000;

/// The landmarks that a map can hold, and their rows in it.
struct Mapped {
  std::vector<int> row;  ///< Of each landmark; -1: not mapped.
  std::vector<int> landmarks;
};

/// The landmarks of the largest group that pairs hold together.
/// @param start  M x 2; landmarks with NaN rows do not count, and hold no others together.
Mapped mapped_landmarks(const std::vector<PairItem>& items, const Points& start) {
  Graph graph(static_cast<std::size_t>(start.rows()));
  for (const PairItem& item : items) {
    if (!start.row(item.first).allFinite() || !start.row(item.second).allFinite()) continue;
    graph[static_cast<std::size_t>(item.first)].push_back({item.second, item.distance_m});
    graph[static_cast<std::size_t>(item.second)].push_back({item.first, item.distance_m});
  }
  Mapped mapped{std::vector<int>(graph.size(), -1), {}};
  for (const Eigen::Index k : largest_component(graph)) {
    mapped.row[static_cast<std::size_t>(k)] = static_cast<int>(mapped.landmarks.size());
    mapped.landmarks.push_back(static_cast<int>(k));
  }
  return mapped;
}

/// The components that the finite distances connect, by row.
std::vector<int> pieces_of(const Eigen::MatrixXd& D) {
  Graph graph(static_cast<std::size_t>(D.rows()));
  for (Eigen::Index i = 0; i < D.rows(); ++i)
    for (Eigen::Index j = 0; j < D.rows(); ++j)
      if (i != j && std::isfinite(D(i, j)))
        graph[static_cast<std::size_t>(i)].push_back({static_cast<int>(j), D(i, j)});
  return components(graph);
}

/// Removes pairs that were seen in few scans, which may all be of wrong IDs, except those of
/// landmarks that have few better ones, and those that alone join what the others connect.
void leave_well_seen(Eigen::MatrixXd& D, const Eigen::MatrixXd& scans) {
  const auto well = [&](Eigen::Index i, Eigen::Index j) {
    return i != j && std::isfinite(D(i, j)) && scans(i, j) >= kFewestScans;
  };
  std::vector<bool> is_short;
  for (Eigen::Index i = 0; i < D.rows(); ++i) {
    int count = 0;
    for (Eigen::Index j = 0; j < D.rows(); ++j) count += well(i, j) ? 1 : 0;
    is_short.push_back(count < kPairsToPlace);
  }
  const Eigen::MatrixXd all = D;
  for (Eigen::Index i = 0; i < D.rows(); ++i)
    for (Eigen::Index j = i + 1; j < D.rows(); ++j)
      if (!well(i, j) && !is_short[static_cast<std::size_t>(i)] &&
          !is_short[static_cast<std::size_t>(j)])
        D(i, j) = D(j, i) = kInfinity;
  const std::vector<int> piece = pieces_of(D);
  for (Eigen::Index i = 0; i < D.rows(); ++i)
    for (Eigen::Index j = i + 1; j < D.rows(); ++j)
      if (piece[static_cast<std::size_t>(i)] != piece[static_cast<std::size_t>(j)])
        D(i, j) = D(j, i) = all(i, j);
}

/// Medians over the blocks, infinite for pairs never seen.
Eigen::MatrixXd median_distances(const std::vector<PairItem>& items, const Mapped& mapped) {
  const std::size_t n = mapped.landmarks.size();
  std::vector<std::vector<std::pair<double, double>>> values(n * n);
  for (const PairItem& item : items) {
    const int i = mapped.row[static_cast<std::size_t>(item.first)];
    const int j = mapped.row[static_cast<std::size_t>(item.second)];
    if (i >= 0 && j >= 0)
      values[static_cast<std::size_t>(i) * n + static_cast<std::size_t>(j)].emplace_back(
          item.distance_m, item.weight);
  }
  const auto size = static_cast<Eigen::Index>(n);
  Eigen::MatrixXd D = Eigen::MatrixXd::Constant(size, size, kInfinity);
  D.diagonal().setZero();
  Eigen::MatrixXd scans = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = i + 1; j < size; ++j) {
      auto& pair = values[static_cast<std::size_t>(i) * n + static_cast<std::size_t>(j)];
      if (pair.empty()) continue;
      std::ranges::sort(pair);
      double half = 0.0;
      for (const auto& [distance, weight] : pair) half += weight / 2.0;
      scans(i, j) = scans(j, i) = 2.0 * half;
      std::size_t at = 0;
      while (at + 1 < pair.size() && (half -= pair[at].second) > 0.0) ++at;
      D(i, j) = D(j, i) = pair[at].first;
    }
  leave_well_seen(D, scans);
  return D;
}

/// Weights and distances of the stress that majorises the cost at a map, n x n.
struct Majorant {
  Eigen::MatrixXd W;
  Eigen::MatrixXd D;
};

/// Sets the majorant at Z: the sum of the majorising parabolas of all pairs.
void majorise(const std::vector<PairItem>& items, const Mapped& mapped, const Points& Z,
              double width_m, Majorant& majorant) {
  auto& [W, D] = majorant;
  W.setZero();
  D.setZero();
  for (const PairItem& item : items) {
    const int i = mapped.row[static_cast<std::size_t>(item.first)];
    const int j = mapped.row[static_cast<std::size_t>(item.second)];
    if (i < 0 || j < 0) continue;
    const double residual = std::abs(item.distance_m - (Z.row(i) - Z.row(j)).norm());
    const double weight = item.weight * (residual > width_m ? width_m / residual : 1.0);
    W(i, j) += weight;
    D(i, j) += weight * item.distance_m;
  }
  for (Eigen::Index i = 0; i < W.rows(); ++i)
    for (Eigen::Index j = i + 1; j < W.cols(); ++j) {
      if (W(i, j) > 0.0) D(i, j) /= W(i, j);
      W(j, i) = W(i, j);
      D(j, i) = D(i, j);
    }
}

RobustMap finished(const std::vector<PairItem>& items, Points map, double width_m) {
  RobustMap result{std::move(map), width_m, 0.0, 0.0};
  double weights = 0.0;
  for (const PairItem& item : items) weights += item.weight;
  result.cost = map_cost(items, result.positions_m, width_m);
  result.loss_m = weights > 0.0 ? std::sqrt(2.0 * result.cost / weights) : 0.0;
  return result;
}

}  // namespace

double width_of(const std::vector<PairItem>& items, const Points& map) {
  std::vector<double> residuals;
  std::vector<double> distances;
  for (const PairItem& item : items) {
    const double distance = (map.row(item.first) - map.row(item.second)).norm();
    if (std::isnan(distance)) continue;
    residuals.push_back(std::abs(item.distance_m - distance));
    distances.push_back(item.distance_m);
  }
  if (residuals.empty()) return 1.0;
  const double floor = std::max(1e-3 * upper_median(distances), 1e-9);
  return std::max(kWidths * 1.4826 * upper_median(residuals), floor);
}

double huber_cost(double residual, double width) {
  const double size = std::abs(residual);
  return size <= width ? 0.5 * size * size : width * (size - 0.5 * width);
}

std::vector<PairItem> pair_items(const std::vector<ScanPair>& pairs, const std::vector<int>& ids,
                                 const LogBlocks& blocks, double most_scans) {
  std::vector<std::tuple<int, int, int, double>> sorted;
  sorted.reserve(pairs.size());
  for (const ScanPair& pair : pairs) {
    const auto [a, b] = std::minmax(ids[pair.first], ids[pair.second]);
    if (a != b)
      sorted.emplace_back(a, b, blocks.of_step[static_cast<std::size_t>(pair.step)],
                          pair.distance_m);
  }
  std::ranges::sort(sorted);
  std::vector<PairItem> items;
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    const auto [a, b, block, distance] = sorted[begin];
    while (end < sorted.size() && std::get<0>(sorted[end]) == a && std::get<1>(sorted[end]) == b &&
           std::get<2>(sorted[end]) == block)
      ++end;
    // Sorted by distance at last: the middle one is the median.
    items.push_back({a, b, block, std::get<3>(sorted[(begin + end - 1) / 2]),
                     std::min(static_cast<double>(end - begin), most_scans)});
  }
  return items;
}

double residual_variance(const RobustMap& map) {
  return map.width_m * map.width_m / (kWidths * kWidths);
}

double map_cost(const std::vector<PairItem>& items, const Points& map, double width_m) {
  double cost = 0.0;
  for (const PairItem& item : items) {
    const double distance = (map.row(item.first) - map.row(item.second)).norm();
    if (!std::isnan(distance))
      cost += item.weight * huber_cost(item.distance_m - distance, width_m);
  }
  return cost;
}

RobustMap minimized_map(const std::vector<PairItem>& items, const Points& start, double width_m,
                        int rounds) {
  const Mapped mapped = mapped_landmarks(items, start);
  Points map = Points::Constant(start.rows(), 2, kNaN);
  const auto n = static_cast<Eigen::Index>(mapped.landmarks.size());
  if (n < 3) return finished(items, std::move(map), width_m);
  Points Z = start(mapped.landmarks, Eigen::all);
  Majorant majorant{Eigen::MatrixXd(n, n), Eigen::MatrixXd(n, n)};
  map(mapped.landmarks, Eigen::all) = Z;
  double cost = map_cost(items, map, width_m);
  for (int round = 0; round < rounds; ++round) {
    majorise(items, mapped, Z, width_m, majorant);
    Z = smacof(majorant.D, majorant.W, Z, {.relative_fall = 1e-4, .max_iterations = 20})
            .coordinates;
    map(mapped.landmarks, Eigen::all) = Z;
    const double next = map_cost(items, map, width_m);
    const bool converged = cost - next <= 1e-5 * cost;
    cost = next;
    if (converged) break;
  }
  return finished(items, std::move(map), width_m);
}

RobustMap robust_map(const std::vector<PairItem>& items, int landmarks) {
  if (landmarks > kMostLandmarks)
    throw InvalidInput("the check of landmark IDs takes at most 2000 landmarks");
  for (const PairItem& item : items)
    if (item.first < 0 || item.second >= landmarks)
      throw InvalidInput("a pair names a landmark that does not exist");
  const Mapped mapped = mapped_landmarks(items, Points::Zero(landmarks, 2));
  Points start = Points::Constant(landmarks, 2, kNaN);
  if (mapped.landmarks.size() < 3) return finished(items, std::move(start), 1.0);
  const Eigen::MatrixXd D = completed_distances(median_distances(items, mapped));
  start(mapped.landmarks, Eigen::all) = lpca(D.cwiseAbs2()).coordinates;
  const double wide = 0.1 * D.mean();
  RobustMap map = minimized_map(items, start, std::max(wide, 1e-9), 10);
  for (int k = 0; k < 2; ++k)
    map = minimized_map(items, map.positions_m, width_of(items, map.positions_m));
  return map;
}

}  // namespace mapproof
