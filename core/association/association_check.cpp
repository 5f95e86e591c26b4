#include "core/association/association_check.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "core/association/hypothesis_fits.hpp"
#include "core/association/identified_scans.hpp"
#include "core/association/position_costs.hpp"
#include "core/association/robust_map.hpp"
#include "core/association/scan_costs.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/pairs/pair_map.hpp"

namespace mapproof {
namespace {

constexpr double kFar = 0.25;           ///< Of the median distance.
constexpr std::size_t kNamed = 4;       ///< Landmarks.
constexpr double kWorse = 2.0;          ///< Than the median landmark, to be named.
constexpr double kDeviations = 1.4826;  ///< Standard deviation over median of absolute values.

/// 0 without a value.
double median_or_zero(const std::vector<double>& values) {
  return values.empty() ? 0.0 : upper_median(values);
}

/// The median pair's spread of the blocks' distances about their median.
double spread_of(const std::vector<PairItem>& items) {
  std::map<std::pair<int, int>, std::vector<double>> distances;
  for (const PairItem& item : items)
    distances[{item.first, item.second}].push_back(item.distance_m);
  std::vector<double> spreads;
  for (auto& [pair, values] : distances) {
    if (values.size() < 3) continue;
    const double centre = median_or_zero(values);
    for (double& value : values) value = std::abs(value - centre);
    spreads.push_back(kDeviations * median_or_zero(values));
  }
  return median_or_zero(spreads);
}

/// @param map  Of the pairs under these IDs.
/// @note O(P log P) time for P pairs.
AssociationDoubts association_doubts(const IdentifiedScans& scans, const std::vector<int>& ids,
                                     const RobustMap& map) {
  const std::vector<PairItem> items = pair_items(scans.pairs, ids, scans.blocks);
  std::vector<double> distances;
  for (const PairItem& item : items) distances.push_back(item.distance_m);
  const double far = kFar * median_or_zero(distances);
  const Eigen::Index M = map.positions_m.rows();
  Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(M);
  Eigen::ArrayXd weights = Eigen::ArrayXd::Zero(M);
  for (const PairItem& item : items) {
    const double between =
        (map.positions_m.row(item.first) - map.positions_m.row(item.second)).norm();
    if (std::isnan(between)) continue;
    const double residual = std::min(far, std::abs(item.distance_m - between));
    for (const int k : {item.first, item.second}) {
      squares(k) += item.weight * residual * residual;
      weights(k) += item.weight;
    }
  }
  AssociationDoubts doubts;
  if (weights.sum() <= 0.0) return doubts;
  doubts.residual_m = std::sqrt(squares.sum() / weights.sum());
  doubts.spread_m = std::max(spread_of(items), 1e-3 * median_or_zero(distances));
  std::vector<double> worst;
  for (int k = 0; k < M; ++k)
    if (weights(k) > 0.0) {
      worst.push_back(squares(k) / weights(k));
      doubts.landmarks.push_back(k);
    }
  const double usual = median_or_zero(worst);
  const auto badness = [&](int k) { return squares(k) / weights(k); };
  std::ranges::stable_sort(doubts.landmarks, std::greater<>(), badness);
  std::erase_if(doubts.landmarks, [&](int k) { return badness(k) < kWorse * usual; });
  if (doubts.landmarks.size() > kNamed) doubts.landmarks.resize(kNamed);
  return doubts;
}

constexpr double kFitsNot = 8.0;     ///< A detection's cost, in variances, under a wrong ID.
constexpr double kNearlyAll = 0.97;  ///< Of the detections that a fault may hold for.

/// How well the relabelled detections explain the reduction of the cost.
struct Explanation {
  double share = 0.0;        ///< The reduction, of what all pairs of both IDs cost.
  double left = 0.0;         ///< Mean cost of a relabelled pair, in variances.
  std::size_t partners = 0;  ///< Landmarks that are co-visible with relabelled detections.
};

Explanation explained(const IdentifiedScans& scans, const std::vector<int>& ids,
                      const RobustMap& before, const HypothesisFit& fit) {
  double concerned = 0.0;
  for (const PairItem& item : pair_items(scans.pairs, ids, scans.blocks))
    for (const int id : {fit.fault.first, fit.fault.second})
      if (item.first == id || item.second == id) {
        concerned += map_cost({item}, before.positions_m, before.width_m);
        break;
      }
  std::vector<char> partners(scans.log.names.size(), 0);
  double after = 0.0;
  int count = 0;
  for (const ScanPair& pair : scans.pairs) {
    const int a = fit.ids[pair.first];
    const int b = fit.ids[pair.second];
    const bool first_changed = a != ids[pair.first];
    const bool second_changed = b != ids[pair.second];
    if (!first_changed && !second_changed) continue;
    const double between = (fit.map.positions_m.row(a) - fit.map.positions_m.row(b)).norm();
    if (std::isnan(between)) continue;
    after += huber_cost(pair.distance_m - between, before.width_m);
    ++count;
    if (first_changed) partners[static_cast<std::size_t>(b)] = 1;
    if (second_changed) partners[static_cast<std::size_t>(a)] = 1;
  }
  const double variance = residual_variance(before);
  return {concerned > 0.0 ? (before.cost - fit.map.cost) / concerned : 0.0,
          after / variance / std::max(count, 1),
          static_cast<std::size_t>(std::ranges::count(partners, 1))};
}

/// Whether the finding's stretch of steps is one robot's, and no detection of both IDs by it lies
/// outside.
bool is_all_of_robot(const DetectionLog& log, const std::vector<int>& ids,
                     const AssociationFinding& finding) {
  if (finding.by_time || log.scans.empty()) return false;
  const auto robot = [&](int step) { return log.scans[static_cast<std::size_t>(step)].robot; };
  const int one = robot(finding.first_step);
  if (robot(finding.last_step) != one) return false;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const int step = log.detections[k].step;
    if ((ids[k] == finding.first || ids[k] == finding.second) && robot(step) == one &&
        (step < finding.first_step || step > finding.last_step))
      return false;
  }
  return true;
}

/// Where and when the detections are that a hypothesis relabelled.
AssociationFinding found(const IdentifiedScans& scans, const std::vector<int>& ids,
                         const HypothesisFit& fit) {
  AssociationFinding finding{.fault = fit.fault.fault,
                             .first = fit.fault.first,
                             .second = fit.fault.second,
                             .by_time = fit.stretch.order > 0,
                             .scattered = fit.scattered};
  const std::vector<std::size_t>& positions = scans.positions[fit.stretch.order];
  std::size_t first = positions.size();
  std::size_t last = 0;
  std::size_t first_of_all = positions.size();
  std::size_t last_of_all = 0;
  int meant = 0;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    if (ids[k] != finding.first && ids[k] != finding.second) continue;
    const std::size_t position = positions[static_cast<std::size_t>(scans.log.detections[k].step)];
    first_of_all = std::min(first_of_all, position);
    last_of_all = std::max(last_of_all, position);
    const bool is_meant = finding.fault == AssociationFault::kSwapped || ids[k] == finding.first;
    if (is_meant && position >= fit.stretch.begin && position < fit.stretch.end) ++meant;
    if (ids[k] == fit.ids[k]) continue;
    ++finding.detections;
    // Scans near the stretch that were relabelled one by one do not widen it.
    if (position < fit.stretch.begin || position >= fit.stretch.end) continue;
    first = std::min(first, position);
    last = std::max(last, position);
  }
  if (first > last) return finding;
  finding.from_the_start = first == first_of_all;
  finding.to_the_end = last == last_of_all;
  const std::vector<int>& steps = scans.blocks.step_orders[fit.stretch.order];
  finding.first_step = steps[first];
  finding.last_step = steps[last];
  finding.in_part = finding.detections < kNearlyAll * meant;
  finding.all_of_robot = is_all_of_robot(scans.log, ids, finding);
  const std::vector<double>& times = scans.log.times_s;
  const auto time = [&](int step) {
    return times.empty() ? kNaN : times[static_cast<std::size_t>(step)];
  };
  finding.first_time_s = time(finding.first_step);
  finding.last_time_s = time(finding.last_step);
  return finding;
}

/// A swap that changes most detections of both IDs is its complement under other names. Of a
/// complement in two parts the one with more detections is taken; the other is left for the next
/// search.
void turn_to_minority(const IdentifiedScans& scans, const std::vector<int>& ids,
                      HypothesisFit& fit) {
  if (fit.fault.fault != AssociationFault::kSwapped || fit.scattered) return;
  const std::vector<std::size_t>& positions = scans.positions[fit.stretch.order];
  std::size_t before = 0;
  std::size_t inside = 0;
  std::size_t after = 0;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    if (ids[k] != fit.fault.first && ids[k] != fit.fault.second) continue;
    const std::size_t position = positions[static_cast<std::size_t>(scans.log.detections[k].step)];
    (position < fit.stretch.begin ? before : position < fit.stretch.end ? inside : after) += 1;
  }
  // In two parts only if it is clearly the smaller: halves are about equal either way.
  const bool in_parts = before > 0 && after > 0;
  const std::size_t outside = before + after;
  if (outside == 0 || (in_parts ? 2 * inside <= 3 * outside : inside <= outside)) return;
  fit.stretch = before < after ? StepStretch{fit.stretch.order, fit.stretch.end, positions.size()}
                               : StepStretch{fit.stretch.order, 0, fit.stretch.begin};
  if (in_parts)
    fit.ids = corrected_ids(scans, ids, fit.fault, fit.stretch);
  else
    for (int& id : fit.ids) id = other_id(fit.fault, id);
  fit.map.positions_m.row(fit.fault.first).swap(fit.map.positions_m.row(fit.fault.second));
  if (in_parts)
    fit.map = minimized_map(pair_items(scans.pairs, fit.ids, scans.blocks), fit.map.positions_m,
                            fit.map.width_m);
}

/// A fault that gains little in many scans may be a sensor's error in one part of the hall.
bool convincing(const Explanation& explanation, const AssociationCheckOptions& options) {
  return explanation.share >= options.least_share && explanation.left <= options.most_left &&
         explanation.partners >= static_cast<std::size_t>(options.fewest_partners);
}

/// The map, or that from another start if it costs less.
RobustMap better_map(const std::vector<PairItem>& items, RobustMap map, const Points& start_m) {
  RobustMap other = minimized_map(items, start_m, map.width_m);
  if (other.cost >= map.cost) return map;
  // The width of a folded map is too wide.
  const double own = std::min(map.width_m, width_of(items, other.positions_m));
  return minimized_map(items, other.positions_m, own);
}

/// The map of all pairs under some IDs at a width of its own: without a start, from the map that
/// rejects few scans, or from a start, whichever costs less.
RobustMap map_under(const IdentifiedScans& scans, const std::vector<int>& ids,
                    const Points* start_m = nullptr) {
  const std::vector<PairItem> items = pair_items(scans.pairs, ids, scans.blocks);
  RobustMap map = robust_map(items, static_cast<int>(scans.log.names.size()));
  map = unfolded_map(items, std::move(map), scans.blocks.count);
  map = better_map(items, std::move(map),
                   pair_map_of(reassigned(scans.log, ids)).embedding.coordinates);
  return start_m == nullptr ? map : better_map(items, std::move(map), *start_m);
}

double loss_at(const IdentifiedScans& scans, const std::vector<int>& ids, const Points& map_m,
               double width_m) {
  return minimized_map(pair_items(scans.pairs, ids, scans.blocks), map_m, width_m).loss_m;
}

/// Detections of IDs at fault in single scans that fit neither landmark: some pairs would be known
/// by them alone.
std::vector<char> fitting_neither(const IdentifiedScans& scans, const std::vector<int>& ids,
                                  const RobustMap& map, std::vector<AssociationFinding>& findings) {
  std::vector<char> left_out(ids.size(), 0);
  const Points turned_m = oriented_as_seen(scans, ids, map.positions_m);
  ScanCosts costs(scans, turned_m, map.width_m);
  for (AssociationFinding& finding : findings)
    for (std::size_t row = 0, end = 0; row < ids.size() && finding.scattered; row = end) {
      end = costs.take(ids, row, finding.first, finding.second);
      for (std::size_t k = row; k < end; ++k) {
        if (ids[k] != finding.first && ids[k] != finding.second) continue;
        finding.undetermined += costs.determines() ? 0 : 1;
        if (costs(k, ids[k]) <= kFitsNot * residual_variance(map)) continue;
        finding.left_out += left_out[k] == 0 ? 1 : 0;
        left_out[k] = 1;
      }
    }
  return left_out;
}

}  // namespace

AssociationCheck check_association(const DetectionLog& log,
                                   const AssociationCheckOptions& options) {
  const IdentifiedScans scans = identified_scans(log, options.most_blocks);
  std::vector<int> ids = given_ids(log);
  RobustMap map = map_under(scans, ids);
  const double known_width_m = map.width_m;
  AssociationCheck check{.findings = {},
                         .loss_before_m = map.loss_m,
                         .loss_after_m = map.loss_m,
                         .doubts = {},
                         .repaired = log};
  for (int round = 0; round < options.most_findings; ++round) {
    std::optional<HypothesisFit> fit = best_fit(scans, ids, map);
    if (!fit) break;
    const double evidence = (map.cost - fit->map.cost) / residual_variance(map);
    if (evidence < options.least_evidence || !convincing(explained(scans, ids, map, *fit), options))
      break;
    turn_to_minority(scans, ids, *fit);
    AssociationFinding finding = found(scans, ids, *fit);
    if (finding.detections < std::max(1, options.fewest_detections)) break;
    finding.evidence = evidence;
    finding.loss_before_m = check.loss_after_m;
    ids = std::move(fit->ids);
    // Wrong IDs may have widened the residuals that determine the width.
    map = map_under(scans, ids, &fit->map.positions_m);
    check.loss_after_m = loss_at(scans, ids, map.positions_m, known_width_m);
    finding.loss_after_m = check.loss_after_m;
    check.findings.push_back(finding);
  }
  check.doubts = association_doubts(scans, ids, map);
  check.repaired = reassigned(log, ids, fitting_neither(scans, ids, map, check.findings));
  return check;
}

}  // namespace mapproof
