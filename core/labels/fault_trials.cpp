#include "core/labels/fault_trials.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "core/labels/label_search.hpp"
#include "core/labels/mixed_fault.hpp"
#include "core/labels/place_costs.hpp"
#include "core/labels/scan_by_scan.hpp"
#include "core/labels/scattered_fault.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kTried = 40;  ///< Hypotheses that a map is made for.
/// The best of each kind, whose maps are made from nothing too.
constexpr std::size_t kBegunAnew = 4;
/// A fault in single scans has more freedom: it must cost less than this share of a stretch's.
constexpr double kPlainer = 0.9;

/// The stretch of steps over which the fault explains the scans better, in a map that holds it.
StepStretch sharpened(const LabelledScans& scans, const std::vector<int>& labels,
                      const LabelHypothesis& one, const RobustMap& map) {
  const auto order = static_cast<std::size_t>(one.order);
  Eigen::VectorXd gains = Eigen::VectorXd::Zero(scans.log.steps);
  const auto cost = [&](int a, int b, double distance) {
    const double between = (map.positions_m.row(a) - map.positions_m.row(b)).norm();
    return std::isnan(between) ? 0.0 : huber_cost(distance - between, map.width_m);
  };
  for (const ScanPair& pair : scans.pairs) {
    const int a = labels[pair.first];
    const int b = labels[pair.second];
    gains(static_cast<Eigen::Index>(scans.places[order][static_cast<std::size_t>(pair.step)])) +=
        cost(a, b, pair.distance_m) -
        cost(other_label(one, a), other_label(one, b), pair.distance_m);
  }
  return greatest_sum(order, gains);
}

/// The items with the fault corrected in whole blocks: what makes trying many cheap.
std::vector<PairItem> corrected_items(const LabelledScans& scans,
                                      const std::vector<PairItem>& items,
                                      const LabelHypothesis& one) {
  std::vector<char> inside(static_cast<std::size_t>(scans.blocks.count), 0);
  const std::vector<int>& order = scans.blocks.block_orders[static_cast<std::size_t>(one.order)];
  for (int k = one.begin; k < one.end; ++k)
    inside[static_cast<std::size_t>(order[static_cast<std::size_t>(k)])] = 1;
  std::vector<PairItem> result;
  result.reserve(items.size());
  for (PairItem item : items) {
    if (inside[static_cast<std::size_t>(item.block)] != 0) {
      const int a = other_label(one, item.first);
      const int b = other_label(one, item.second);
      if (a == b) continue;
      item.first = std::min(a, b);
      item.second = std::max(a, b);
    }
    result.push_back(item);
  }
  return result;
}

/// The map under corrected labels, from the one before with both landmarks put where the fault has
/// them.
RobustMap moved_map(const std::vector<PairItem>& items, const RobustMap& map,
                    const LabelHypothesis& one) {
  Points start = map.positions_m;
  start.row(one.first) = one.first_m;
  start.row(one.second) = one.second_m;
  return lowered_map(items, start, map.width_m);
}

/// The better one of that map and of one from nothing: wrong labels may have folded the map before.
RobustMap refolded_map(const LabelledScans& scans, const std::vector<PairItem>& items,
                       const RobustMap& map, const LabelHypothesis& one) {
  RobustMap moved = moved_map(items, map, one);
  const auto landmarks = static_cast<int>(map.positions_m.rows());
  RobustMap anew = lowered_map(items, robust_map(items, landmarks).positions_m, map.width_m);
  return unfolded_map(items, anew.cost < moved.cost ? std::move(anew) : std::move(moved),
                      scans.blocks.count);
}

/// The fault over the stretch of steps that its map makes of it.
FaultTrial sharp_trial(const LabelledScans& scans, const std::vector<int>& labels,
                       LabelHypothesis one, RobustMap map) {
  FaultTrial trial{one, sharpened(scans, labels, one, map), {}, std::move(map)};
  trial.labels = corrected_labels(scans, labels, one, trial.stretch);
  trial.fault.first_m = trial.map.positions_m.row(one.first);
  trial.fault.second_m = trial.map.positions_m.row(one.second);
  trial.map =
      moved_map(pair_items(scans.pairs, trial.labels, scans.blocks), trial.map, trial.fault);
  return trial;
}

/// The first few of each kind of fault.
void choose(const std::vector<LabelHypothesis>& from, std::vector<LabelHypothesis>& chosen) {
  std::map<LabelFault, std::size_t> taken;
  for (const LabelHypothesis& one : from)
    if (taken[one.fault]++ < kBegunAnew) chosen.push_back(one);
}

/// The hypotheses that are promising enough to be tried from nothing.
std::vector<LabelHypothesis> worth_a_map(const LabelledScans& scans,
                                         const std::vector<PairItem>& items, const RobustMap& map) {
  std::vector<LabelHypothesis> in_map = hypotheses_in_map(items, map, scans.blocks, kTried);
  for (LabelHypothesis& one : in_map)
    one.gain = map.cost - moved_map(corrected_items(scans, items, one), map, one).cost;
  std::ranges::stable_sort(in_map, std::greater<>(), &LabelHypothesis::gain);
  std::vector<LabelHypothesis> chosen;
  choose(in_map, chosen);
  choose(hypotheses_of_distances(items, map, scans.blocks, kTried), chosen);
  return chosen;
}

}  // namespace

std::optional<FaultTrial> best_trial(const LabelledScans& scans, const std::vector<int>& labels,
                                     const RobustMap& map) {
  const std::vector<PairItem> items = pair_items(scans.pairs, labels, scans.blocks);
  std::map<LabelFault, std::pair<LabelHypothesis, RobustMap>> best;
  for (const LabelHypothesis& one : worth_a_map(scans, items, map)) {
    RobustMap other = refolded_map(scans, corrected_items(scans, items, one), map, one);
    const auto found = best.find(one.fault);
    if (other.cost < (found == best.end() ? map.cost : found->second.second.cost))
      best[one.fault] = {one, std::move(other)};
  }
  std::optional<FaultTrial> lowest;
  for (const auto& [fault, found] : best) {
    FaultTrial trial = sharp_trial(scans, labels, found.first, found.second);
    trial = settled_trial(scans, labels, std::vector(trial.labels), trial, trial.map.positions_m,
                          trial.map.width_m, map.width_m);
    trial = simplified(scans, labels, std::move(trial));
    if (trial.map.cost < (lowest ? lowest->map.cost : map.cost)) lowest = std::move(trial);
  }
  std::optional<FaultTrial> mixed = mixed_trial(scans, labels, map);
  if (mixed)
    mixed = settled_trial(scans, labels, labels, *mixed, mixed->map.positions_m, map.width_m,
                          map.width_m);
  if (mixed && mixed->map.cost < (lowest ? lowest->map.cost : map.cost)) lowest = std::move(mixed);
  std::optional<FaultTrial> scattered = scattered_trial(scans, labels, map);
  if (scattered && scattered->map.cost < (lowest ? kPlainer * lowest->map.cost : map.cost))
    lowest = std::move(scattered);
  return lowest;
}

}  // namespace mapproof
