#include "core/association/hypothesis_fits.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "core/association/association_search.hpp"
#include "core/association/identified_scans.hpp"
#include "core/association/position_costs.hpp"
#include "core/association/robust_map.hpp"
#include "core/association/scan_costs.hpp"
#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

/// Two IDs whose detections alternate between the same two positions, at any time.
struct SharedPositions {
  int first = 0;  ///< first < second.
  int second = 0;
  RobustMap map;      ///< Of the others alone, with both IDs' likeliest positions.
  double gain = 0.0;  ///< Over one position each, m^2 per tested detection.
};

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

/// The IDs whose distances from each other one have two values, the clearest first: evidence of
/// mixed IDs without any map.
/// @note O(P log P) time for P pairs.
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

/// For each pair of those IDs the two positions that explain both IDs' detections best, each
/// detection being at either, in a map of the other landmarks.
/// @return Descending by gain.
/// @note For each pair of IDs a map without a start, and some 5e7 comparisons.
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

constexpr std::size_t kSettledPairs = 4;  ///< Pairs of IDs that are refined scan by scan.
constexpr double kLeastGain = 0.3;        ///< Of the first pair's.
/// Below this share, and so much below the other ID's, one ID's changes are chance.
constexpr double kByChance = 0.1;
constexpr double kRarer = 0.25;
/// Scans that contradict a stretch, as a share of those that it explains, and how much more it may
/// cost.
constexpr double kStrays = 0.05;
constexpr double kAsGood = 1.1;

/// Detections that a hypothesis gives another ID, of each of both.
struct Changes {
  double all = 0.0;
  double first_share = 0.0;  ///< Of those under the first ID.
  double second_share = 0.0;

  bool one_sided() const {
    const auto [less, more] = std::minmax(first_share, second_share);
    return less < kByChance && less < kRarer * more;
  }
};

Changes changes_of(const std::vector<int>& ids, const HypothesisFit& fit) {
  double first = 0.0;
  double second = 0.0;
  double of_first = 1.0;
  double of_second = 1.0;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const double changed = ids[k] != fit.ids[k] ? 1.0 : 0.0;
    if (ids[k] == fit.fault.first) {
      of_first += 1.0;
      first += changed;
    } else if (ids[k] == fit.fault.second) {
      of_second += 1.0;
      second += changed;
    }
  }
  return {first + second, first / of_first, second / of_second};
}

/// A fault of the two IDs that share positions. @param turned  The second one comes first.
AssociationHypothesis fault_of(const SharedPositions& shared, AssociationFault fault,
                               bool turned = false) {
  AssociationHypothesis result;
  result.fault = fault;
  result.first = turned ? shared.second : shared.first;
  result.second = turned ? shared.first : shared.second;
  return result;
}

/// The fault in single scans of the whole log, scans being judged at `predicted_m`.
HypothesisFit converged(const ScanIds& of, const AssociationHypothesis& fault, const Points& start,
                        double predicted_m, double width_m) {
  HypothesisFit fit;
  fit.fault = fault;
  fit.stretch = {0, 0, of.scans.positions.front().size()};
  fit.scattered = true;
  return converged_fit(of, std::move(fit), start, predicted_m, width_m);
}

/// Both ways of deciding which landmark has which position; of them the simpler one.
HypothesisFit simpler_fit(const IdentifiedScans& scans, const std::vector<int>& ids,
                          const SharedPositions& shared, double width_m) {
  const Points& start = shared.map.positions_m;
  Points exchanged = start;
  exchanged.row(shared.first).swap(exchanged.row(shared.second));
  const ScanIds of{scans, ids, ids};
  const double predicted_m = shared.map.width_m;
  const AssociationHypothesis swap = fault_of(shared, AssociationFault::kSwapped);
  HypothesisFit best = converged(of, swap, start, predicted_m, width_m);
  HypothesisFit other = converged(of, swap, exchanged, predicted_m, width_m);
  Changes changes = changes_of(ids, best);
  const Changes of_other = changes_of(ids, other);
  if (changes.one_sided() != of_other.one_sided() ? of_other.one_sided()
                                                  : of_other.all < changes.all) {
    best = std::move(other);
    changes = of_other;
  }
  if (!changes.one_sided()) return best;
  const Points positions = best.map.positions_m;
  const bool turned = changes.second_share > changes.first_share;
  return converged(of, fault_of(shared, AssociationFault::kInPart, turned), positions, predicted_m,
                   width_m);
}

/// For each position of an order: scans given another ID, less those that have evidence and keep
/// theirs.
Eigen::VectorXi balance(const IdentifiedScans& scans, const std::vector<int>& ids,
                        const HypothesisFit& fit, std::size_t order) {
  Eigen::VectorXi result = Eigen::VectorXi::Zero(scans.log.steps);
  const bool both = fit.fault.fault == AssociationFault::kSwapped;
  ScanCosts costs(scans, fit.map.positions_m, 1.0);
  for (std::size_t row = 0, end = 0; row < ids.size(); row = end) {
    end = costs.take(ids, row, fit.fault.first, fit.fault.second);
    if (!costs.determines()) continue;
    const auto step = static_cast<std::size_t>(scans.log.detections[row].step);
    int& sum = result(static_cast<Eigen::Index>(scans.positions[order][step]));
    for (std::size_t k = row; k < end; ++k)
      if (ids[k] == fit.fault.first || (both && ids[k] == fit.fault.second))
        sum = ids[k] != fit.ids[k] ? 1 : -1;
  }
  return result;
}

/// The stretch that holds the fault, if one does except for a few scans.
std::optional<StepStretch> stretch_of(const IdentifiedScans& scans, const std::vector<int>& ids,
                                      const HypothesisFit& fit) {
  for (std::size_t order = 0; order < scans.positions.size(); ++order) {
    const Eigen::VectorXi balances = balance(scans, ids, fit, order);
    const StepStretch best = greatest_sum(order, balances.cast<double>());
    const auto begin = static_cast<Eigen::Index>(best.begin);
    const auto length = static_cast<Eigen::Index>(best.end) - begin;
    const auto changed = static_cast<double>((balances.array() > 0).count());
    const auto inside = balances.segment(begin, length).array();
    const double against = changed - static_cast<double>((inside > 0).count()) +
                           static_cast<double>((inside < 0).count());
    if (against <= kStrays * changed) return best;
  }
  return std::nullopt;
}

/// The same fault over a stretch, where detections without evidence from their scan are corrected
/// too.
HypothesisFit over_stretch(const IdentifiedScans& scans, const std::vector<int>& ids,
                           HypothesisFit fit, double width_m) {
  const std::optional<StepStretch> stretch = stretch_of(scans, ids, fit);
  if (!stretch) return fit;
  HypothesisFit whole = fit;
  whole.scattered = false;
  whole.stretch = *stretch;
  if (whole.fault.fault == AssociationFault::kInPart) whole.fault.fault = AssociationFault::kWrong;
  whole.ids = corrected_ids(scans, ids, whole.fault, *stretch);
  whole = converged_fit({scans, ids, std::vector(whole.ids)}, whole, fit.map.positions_m, width_m,
                        width_m);
  return whole.map.cost < kAsGood * fit.map.cost ? whole : fit;
}

/// Whether a scan holds a detection of a landmark.
bool seen_in_scan(const DetectionLog& log, const std::vector<int>& ids, std::size_t row,
                  int landmark) {
  const int step = log.detections[row].step;
  while (row > 0 && log.detections[row - 1].step == step) --row;
  for (; row < ids.size() && log.detections[row].step == step; ++row)
    if (ids[row] == landmark) return true;
  return false;
}

/// What each detection costs in a map under each ID instead of its own, while the others in its
/// scan keep theirs: detections x landmarks, zero but for those with the ID `ids`.
Eigen::MatrixXd id_costs(const IdentifiedScans& scans, const std::vector<int>& ids,
                         const RobustMap& map, int id) {
  const Eigen::Index M = map.positions_m.rows();
  Eigen::MatrixXd costs = Eigen::MatrixXd::Zero(std::ssize(ids), M);
  for (const ScanPair& pair : scans.pairs)
    for (const auto& [own, other] :
         {std::pair(pair.first, pair.second), std::pair(pair.second, pair.first)}) {
      if (ids[own] != id) continue;
      const Eigen::RowVector2d partner = map.positions_m.row(ids[other]);
      for (Eigen::Index k = 0; k < M; ++k)
        costs(static_cast<Eigen::Index>(own), k) +=
            huber_cost(pair.distance_m - (map.positions_m.row(k) - partner).norm(), map.width_m);
    }
  return costs;
}

constexpr std::size_t kTried = 40;  ///< Hypotheses that a map is made for.
/// The best of each type, whose maps are also made without a start.
constexpr std::size_t kRestarted = 4;
/// A fault in single scans has more freedom: it must cost less than this share of a stretch's cost.
constexpr double kPlainer = 0.9;

/// The stretch of steps over which the fault explains the scans better, in a map that holds it.
StepStretch refined_width(const IdentifiedScans& scans, const std::vector<int>& ids,
                          const AssociationHypothesis& one, const RobustMap& map) {
  const auto order = static_cast<std::size_t>(one.order);
  Eigen::VectorXd gains = Eigen::VectorXd::Zero(scans.log.steps);
  const auto cost = [&](int a, int b, double distance) {
    const double between = (map.positions_m.row(a) - map.positions_m.row(b)).norm();
    return std::isnan(between) ? 0.0 : huber_cost(distance - between, map.width_m);
  };
  for (const ScanPair& pair : scans.pairs) {
    const int a = ids[pair.first];
    const int b = ids[pair.second];
    gains(static_cast<Eigen::Index>(scans.positions[order][static_cast<std::size_t>(pair.step)])) +=
        cost(a, b, pair.distance_m) - cost(other_id(one, a), other_id(one, b), pair.distance_m);
  }
  return greatest_sum(order, gains);
}

/// The items with the fault corrected in whole blocks: this makes many hypotheses cheap to test.
std::vector<PairItem> corrected_items(const IdentifiedScans& scans,
                                      const std::vector<PairItem>& items,
                                      const AssociationHypothesis& one) {
  std::vector<char> inside(static_cast<std::size_t>(scans.blocks.count), 0);
  const std::vector<int>& order = scans.blocks.block_orders[static_cast<std::size_t>(one.order)];
  for (int k = one.begin; k < one.end; ++k)
    inside[static_cast<std::size_t>(order[static_cast<std::size_t>(k)])] = 1;
  std::vector<PairItem> result;
  result.reserve(items.size());
  for (PairItem item : items) {
    if (inside[static_cast<std::size_t>(item.block)] != 0) {
      const int a = other_id(one, item.first);
      const int b = other_id(one, item.second);
      if (a == b) continue;
      item.first = std::min(a, b);
      item.second = std::max(a, b);
    }
    result.push_back(item);
  }
  return result;
}

/// The map under corrected IDs, from the previous one with both landmarks at the positions that the
/// fault implies.
RobustMap moved_map(const std::vector<PairItem>& items, const RobustMap& map,
                    const AssociationHypothesis& one) {
  Points start = map.positions_m;
  start.row(one.first) = one.first_m;
  start.row(one.second) = one.second_m;
  return minimized_map(items, start, map.width_m);
}

/// The better one of that map and of one without a start: wrong IDs may have folded the previous
/// map.
RobustMap refolded_map(const IdentifiedScans& scans, const std::vector<PairItem>& items,
                       const RobustMap& map, const AssociationHypothesis& one) {
  RobustMap moved = moved_map(items, map, one);
  const auto landmarks = static_cast<int>(map.positions_m.rows());
  RobustMap resampled = minimized_map(items, robust_map(items, landmarks).positions_m, map.width_m);
  return unfolded_map(items, resampled.cost < moved.cost ? std::move(resampled) : std::move(moved),
                      scans.blocks.count);
}

/// The fault over the stretch of steps that its map yields.
HypothesisFit sharp_fit(const IdentifiedScans& scans, const std::vector<int>& ids,
                        const AssociationHypothesis& one, RobustMap map) {
  HypothesisFit fit{one, refined_width(scans, ids, one, map), {}, std::move(map)};
  fit.ids = corrected_ids(scans, ids, one, fit.stretch);
  fit.fault.first_m = fit.map.positions_m.row(one.first);
  fit.fault.second_m = fit.map.positions_m.row(one.second);
  fit.map = moved_map(pair_items(scans.pairs, fit.ids, scans.blocks), fit.map, fit.fault);
  return fit;
}

/// The first few of each type of fault.
void choose(const std::vector<AssociationHypothesis>& from,
            std::vector<AssociationHypothesis>& chosen) {
  std::map<AssociationFault, std::size_t> taken;
  for (const AssociationHypothesis& one : from)
    if (taken[one.fault]++ < kRestarted) chosen.push_back(one);
}

/// The hypotheses that are promising enough for a map without a start.
std::vector<AssociationHypothesis> worth_a_map(const IdentifiedScans& scans,
                                               const std::vector<PairItem>& items,
                                               const RobustMap& map) {
  std::vector<AssociationHypothesis> in_map = hypotheses_in_map(items, map, scans.blocks, kTried);
  for (AssociationHypothesis& one : in_map)
    one.gain = map.cost - moved_map(corrected_items(scans, items, one), map, one).cost;
  std::ranges::stable_sort(in_map, std::greater<>(), &AssociationHypothesis::gain);
  std::vector<AssociationHypothesis> chosen;
  choose(in_map, chosen);
  choose(hypotheses_of_distances(items, map, scans.blocks, kTried), chosen);
  return chosen;
}

}  // namespace

std::optional<HypothesisFit> best_fit(const IdentifiedScans& scans, const std::vector<int>& ids,
                                      const RobustMap& map) {
  const std::vector<PairItem> items = pair_items(scans.pairs, ids, scans.blocks);
  std::map<AssociationFault, std::pair<AssociationHypothesis, RobustMap>> best;
  for (const AssociationHypothesis& one : worth_a_map(scans, items, map)) {
    RobustMap other = refolded_map(scans, corrected_items(scans, items, one), map, one);
    const auto found = best.find(one.fault);
    if (other.cost < (found == best.end() ? map.cost : found->second.second.cost))
      best[one.fault] = {one, std::move(other)};
  }
  std::optional<HypothesisFit> lowest;
  for (const auto& [fault, found] : best) {
    HypothesisFit fit = sharp_fit(scans, ids, found.first, found.second);
    fit = converged_fit({scans, ids, std::vector(fit.ids)}, fit, fit.map.positions_m,
                        fit.map.width_m, map.width_m);
    fit = plainest(scans, ids, std::move(fit));
    if (fit.map.cost < (lowest ? lowest->map.cost : map.cost)) lowest = std::move(fit);
  }
  std::optional<HypothesisFit> mixed = mixed_fit(scans, ids, map);
  if (mixed)
    mixed =
        converged_fit({scans, ids, ids}, *mixed, mixed->map.positions_m, map.width_m, map.width_m);
  if (mixed && mixed->map.cost < (lowest ? lowest->map.cost : map.cost)) lowest = std::move(mixed);
  std::optional<HypothesisFit> scattered = scattered_fit(scans, ids, map);
  if (scattered && scattered->map.cost < (lowest ? kPlainer * lowest->map.cost : map.cost))
    lowest = std::move(scattered);
  return lowest;
}

std::optional<HypothesisFit> mixed_fit(const IdentifiedScans& scans, const std::vector<int>& ids,
                                       const RobustMap& map) {
  const double much = 8.0 * residual_variance(map);
  const auto M = static_cast<int>(map.positions_m.rows());
  HypothesisFit best;
  double greatest = 0.0;
  for (int a = 0; a < M && map.positions_m.row(a).allFinite(); ++a) {
    const Eigen::MatrixXd costs = id_costs(scans, ids, map, a);
    Eigen::VectorXd gains = Eigen::VectorXd::Zero(M);
    const auto mistaken = [&](Eigen::Index row, int b) {
      return costs(row, a) > much && costs(row, b) < 0.5 * costs(row, a);
    };
    for (Eigen::Index row = 0; row < costs.rows(); ++row)
      for (int b = 0; b < M; ++b)
        if (mistaken(row, b)) gains(b) += costs(row, a) - costs(row, b);
    Eigen::Index other = 0;
    if (gains.maxCoeff(&other) <= greatest) continue;
    greatest = gains(other);
    const auto b = static_cast<int>(other);
    best.fault = {.fault = AssociationFault::kInPart, .first = a, .second = b};
    best.stretch = {0, 0, scans.positions.front().size()};
    best.ids = ids;
    for (std::size_t row = 0; row < ids.size(); ++row)
      if (ids[row] == a && mistaken(static_cast<Eigen::Index>(row), b) &&
          !seen_in_scan(scans.log, ids, row, b))
        best.ids[row] = b;
  }
  if (greatest == 0.0) return std::nullopt;
  best.map =
      minimized_map(pair_items(scans.pairs, best.ids, scans.blocks), map.positions_m, map.width_m);
  return best;
}

HypothesisFit plainest(const IdentifiedScans& scans, const std::vector<int>& ids,
                       HypothesisFit fit) {
  if (fit.fault.fault != AssociationFault::kSwapped) return fit;
  const Changes changes = changes_of(ids, fit);
  if (!changes.one_sided()) return fit;
  HypothesisFit simple = fit;
  simple.fault.fault = AssociationFault::kWrong;
  if (changes.second_share > changes.first_share) {
    std::swap(simple.fault.first, simple.fault.second);
    std::swap(simple.fault.first_m, simple.fault.second_m);
  }
  for (std::size_t k = 0; k < ids.size(); ++k)
    if (ids[k] != simple.fault.first) simple.ids[k] = ids[k];
  const double width_m = fit.map.width_m;
  simple = converged_fit({scans, ids, std::vector(simple.ids)}, simple, fit.map.positions_m,
                         width_m, width_m);
  return simple.map.cost < kAsGood * fit.map.cost ? simple : fit;
}

std::optional<HypothesisFit> scattered_fit(const IdentifiedScans& scans,
                                           const std::vector<int>& ids, const RobustMap& map) {
  std::optional<HypothesisFit> best;
  const std::vector<SharedPositions> all = shared_positions(scans, ids, map, kSettledPairs);
  for (const SharedPositions& shared : all) {
    if (shared.gain < kLeastGain * all.front().gain) break;
    HypothesisFit fit = simpler_fit(scans, ids, shared, map.width_m);
    if (!best || fit.map.cost < best->map.cost) best = std::move(fit);
  }
  return best ? std::optional(over_stretch(scans, ids, std::move(*best), map.width_m)) : best;
}

}  // namespace mapproof
