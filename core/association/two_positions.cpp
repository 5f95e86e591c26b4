#include "core/association/two_positions.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "core/association/association_search.hpp"
#include "core/association/position_costs.hpp"
#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

constexpr int kFewestOfTwo = 10;               ///< Of two landmarks, to test for two distances.
constexpr std::size_t kAskedScans = 200;       ///< Of two landmarks, at most.
constexpr std::size_t kAskedDetections = 250;  ///< Of an ID, at most.
constexpr std::size_t kIds = 4;                ///< Of either type of doubt, tested in pairs.
constexpr std::size_t kAskedIds = 20;          ///< Tested for two positions.
constexpr int kSide = 18;                      ///< Of the grid of positions.

/// Every so many of the values that at most `most` are left.
template <typename Value>
void thin_out(std::vector<Value>& values, std::size_t most) {
  const std::size_t stride = (values.size() + most - 1) / std::max<std::size_t>(most, 1);
  if (stride < 2) return;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < values.size(); k += stride) values[kept++] = values[k];
  values.resize(kept);
}

/// By how much two distances explain the values better than one, per value, m^2.
double gain_of_two(const std::vector<double>& values, double width_m) {
  const auto [low, high] = std::ranges::minmax(values);
  const auto steps = static_cast<Eigen::Index>(std::min(40.0, std::ceil((high - low) / width_m)));
  if (steps < 2) return 0.0;
  const auto n = std::ssize(values);
  Eigen::ArrayXXd costs(n, steps + 1);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k <= steps; ++k)
      costs(i, k) =
          huber_cost(values[static_cast<std::size_t>(i)] -
                         (low + (high - low) * static_cast<double>(k) / static_cast<double>(steps)),
                     width_m);
  const double one = costs.colwise().sum().minCoeff();
  double two = one;
  for (Eigen::Index a = 0; a <= steps; ++a)
    for (Eigen::Index b = a + 2; b <= steps; ++b)
      two = std::min(two, costs.col(a).min(costs.col(b)).sum());
  return (one - two) / static_cast<double>(n);
}

/// Costs of an ID's detections at each point of a grid: detections x points.
Eigen::MatrixXf detection_costs(const IdentifiedScans& scans, const std::vector<int>& ids,
                                const RobustMap& core, int id, const Points& grid) {
  std::map<std::size_t, std::vector<std::pair<int, double>>> seen;  // row: others and distances
  for (const ScanPair& pair : scans.pairs)
    for (const auto& [own, other] :
         {std::pair(pair.first, pair.second), std::pair(pair.second, pair.first)})
      if (ids[own] == id && core.positions_m.row(ids[other]).allFinite())
        seen[own].emplace_back(ids[other], pair.distance_m);
  std::vector<std::vector<std::pair<int, double>>> asked;
  for (auto& [row, others] : seen) asked.push_back(std::move(others));
  thin_out(asked, kAskedDetections);
  Eigen::MatrixXf costs(std::ssize(asked), grid.rows());
  for (Eigen::Index i = 0; i < costs.rows(); ++i)
    for (Eigen::Index g = 0; g < grid.rows(); ++g) {
      double sum = 0.0;
      const auto& others = asked[static_cast<std::size_t>(i)];
      for (const auto& [other, distance] : others)
        sum +=
            huber_cost(distance - (grid.row(g) - core.positions_m.row(other)).norm(), core.width_m);
      costs(i, g) = static_cast<float>(sum / static_cast<double>(others.size()));
    }
  return costs;
}

/// The map of all landmarks but two, which may be one.
RobustMap core_map(const std::vector<PairItem>& items, int landmarks, int first, int second,
                   int blocks) {
  std::vector<PairItem> others;
  for (const PairItem& item : items)
    if (item.first != first && item.first != second && item.second != first &&
        item.second != second)
      others.push_back(item);
  RobustMap resampled = robust_map(others, landmarks);
  resampled = unfolded_map(others, std::move(resampled), blocks);
  resampled.positions_m.row(first).setConstant(kNaN);
  resampled.positions_m.row(second).setConstant(kNaN);
  return resampled;
}

/// Finds the two positions, and which is whose: as fewer detections ask for.
void position(SharedPositions& shared, const Eigen::MatrixXf& A, const Eigen::MatrixXf& B,
              const Points& grid) {
  const Eigen::VectorXf of_a = A.colwise().sum();
  const Eigen::VectorXf of_b = B.colwise().sum();
  const double one_each = static_cast<double>(of_a.minCoeff()) + of_b.minCoeff();
  double least = one_each;
  for (Eigen::Index p = 0; p < grid.rows(); ++p)
    for (Eigen::Index q = p + 1; q < grid.rows(); ++q) {
      const double sum = static_cast<double>(A.col(p).cwiseMin(A.col(q)).sum()) +
                         B.col(p).cwiseMin(B.col(q)).sum();
      if (sum >= least) continue;
      least = sum;
      shared.map.positions_m.row(shared.first) = grid.row(p);
      shared.map.positions_m.row(shared.second) = grid.row(q);
    }
  shared.gain =
      (one_each - least) / std::max<double>(1.0, static_cast<double>(A.rows() + B.rows()));
}

/// One ID whose detections may be at two positions.
struct TwoPositions {
  int id = 0;
  double gain = 0.0;         ///< Over one position, m^2 per detection.
  std::vector<int> next_to;  ///< The landmarks nearest to both.
};

int nearest_to(const Points& map, const Eigen::RowVector2d& position) {
  int nearest = -1;
  double least = kInfinity;
  for (int k = 0; k < map.rows(); ++k)
    if (const double distance = (map.row(k) - position).norm(); distance < least) {
      least = distance;
      nearest = k;
    }
  return nearest;
}

/// The two positions that explain one ID's detections best, in a map of all others.
TwoPositions two_positions(const IdentifiedScans& scans, const std::vector<int>& ids,
                           const std::vector<PairItem>& items, int landmarks, int id) {
  const RobustMap core = core_map(items, landmarks, id, id, scans.blocks.count);
  const Points grid = grid_over(core.positions_m, kSide);
  const Eigen::MatrixXf costs = detection_costs(scans, ids, core, id, grid);
  if (costs.rows() == 0) return {id, 0.0, {}};
  Eigen::Index first = 0;
  Eigen::Index second = 0;
  const float one = costs.colwise().sum().minCoeff();
  float least = one;
  for (Eigen::Index p = 0; p < grid.rows(); ++p)
    for (Eigen::Index q = p + 1; q < grid.rows(); ++q)
      if (const float sum = costs.col(p).cwiseMin(costs.col(q)).sum(); sum < least) {
        least = sum;
        first = p;
        second = q;
      }
  TwoPositions found{id, static_cast<double>(one - least) / static_cast<double>(costs.rows()), {}};
  for (const Eigen::Index point : {first, second})
    if (const int near = nearest_to(core.positions_m, grid.row(point)); near >= 0)
      found.next_to.push_back(near);
  return found;
}

/// All pairs of the IDs that seem to have two distances or two positions, and each of them with
/// those whose positions it seems to have.
std::set<std::pair<int, int>> worth_asking(const IdentifiedScans& scans,
                                           const std::vector<int>& ids,
                                           const std::vector<PairItem>& items,
                                           const RobustMap& map) {
  const auto landmarks = static_cast<int>(map.positions_m.rows());
  std::vector<TwoPositions> positions;
  for (const int id : costly_ids(items, map, kAskedIds))
    positions.push_back(two_positions(scans, ids, items, landmarks, id));
  std::ranges::stable_sort(positions, std::greater<>(), &TwoPositions::gain);
  std::set<int> doubtful;
  for (const int id : ids_of_two_distances(scans, ids, landmarks, map.width_m, kIds))
    doubtful.insert(id);
  for (std::size_t k = 0; k < std::min(kIds, positions.size()); ++k)
    doubtful.insert(positions[k].id);
  std::set<std::pair<int, int>> twos;
  for (const int one : doubtful)
    for (const int other : doubtful)
      if (one < other) twos.emplace(one, other);
  for (const TwoPositions& one : positions)
    if (doubtful.contains(one.id))
      for (const int other : one.next_to) twos.insert(std::minmax(one.id, other));
  return twos;
}

}  // namespace

std::vector<int> ids_of_two_distances(const IdentifiedScans& scans, const std::vector<int>& ids,
                                      int landmarks, double width_m, std::size_t most) {
  std::map<std::pair<int, int>, std::vector<double>> distances;
  for (const ScanPair& pair : scans.pairs)
    if (ids[pair.first] != ids[pair.second])
      distances[std::minmax(ids[pair.first], ids[pair.second])].push_back(pair.distance_m);
  std::vector<double> gains(static_cast<std::size_t>(landmarks), 0.0);
  for (auto& [pair, values] : distances) {
    if (std::ssize(values) < kFewestOfTwo) continue;
    thin_out(values, kAskedScans);
    const double gain = gain_of_two(values, width_m);
    gains[static_cast<std::size_t>(pair.first)] += gain;
    gains[static_cast<std::size_t>(pair.second)] += gain;
  }
  std::vector<int> found;
  for (int k = 0; k < landmarks; ++k)
    if (gains[static_cast<std::size_t>(k)] > 0.0) found.push_back(k);
  std::ranges::stable_sort(found, std::greater<>(),
                           [&](int k) { return gains[static_cast<std::size_t>(k)]; });
  if (found.size() > most) found.resize(most);
  return found;
}

std::vector<SharedPositions> shared_positions(const IdentifiedScans& scans,
                                              const std::vector<int>& ids, const RobustMap& map,
                                              std::size_t most) {
  const std::vector<PairItem> items = pair_items(scans.pairs, ids, scans.blocks);
  const auto landmarks = static_cast<int>(map.positions_m.rows());
  std::vector<SharedPositions> found;
  for (const auto& [first, second] : worth_asking(scans, ids, items, map)) {
    SharedPositions shared{first, second, {}, 0.0};
    shared.map = core_map(items, landmarks, first, second, scans.blocks.count);
    const Points grid = grid_over(shared.map.positions_m, kSide);
    position(shared, detection_costs(scans, ids, shared.map, first, grid),
             detection_costs(scans, ids, shared.map, second, grid), grid);
    if (shared.gain > 0.0) found.push_back(std::move(shared));
  }
  std::ranges::stable_sort(found, std::greater<>(), &SharedPositions::gain);
  if (found.size() > most) found.resize(most);
  return found;
}

}  // namespace mapproof
