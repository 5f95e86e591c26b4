#include "core/labels/moved.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/base/errors.hpp"
#include "core/labels/place_costs.hpp"
#include "core/labels/place_shift.hpp"

namespace mapproof {
namespace {

/// The log as it is tried, some landmarks split already.
struct Tried {
  std::vector<std::string> names;
  std::vector<int> labels;
  std::vector<int> splits;  ///< Landmarks that were split, and what they became.
};

std::vector<PairItem> items_of(const std::vector<ScanPair>& pairs, const Tried& tried,
                               const LogBlocks& blocks) {
  return pair_items(pairs, tried.labels, blocks);
}

/// Places in time of the steps.
std::vector<std::size_t> places_in_time(const LogBlocks& blocks) {
  const std::vector<int>& order = blocks.step_orders.back();
  std::vector<std::size_t> places(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) places[static_cast<std::size_t>(order[k])] = k;
  return places;
}

/// A landmark that may have moved.
struct Suspect {
  int landmark = -1;
  std::size_t slice = 0;  ///< With which its second place begins.
  double p = 1.0;         ///< By Holm.
};

/// The landmark of the least p among those not split yet.
Suspect least_p(const std::vector<PairItem>& items, const RobustMap& map, const LogBlocks& blocks,
                const Tried& tried, const MovedOptions& options) {
  std::vector<int> candidates;
  for (int k = 0; k < map.positions_m.rows(); ++k)
    if (map.positions_m.row(k).allFinite() &&
        std::ranges::find(tried.splits, k) == tried.splits.end())
      candidates.push_back(k);
  // Holm's least p is M times the least, which so many permutations can bring below the level.
  const auto needed =
      static_cast<int>(2.0 * static_cast<double>(candidates.size()) / options.level);
  std::vector<PlaceChange> changes;
  for (const int landmark : candidates)
    changes.push_back(best_change(items, map, blocks, landmark));
  const double inflated = inflation(changes, options.seed);
  Suspect best;
  double least = 2.0;
  double strongest = 0.0;
  for (std::size_t k = 0; k < changes.size(); ++k) {
    const double p =
        chance_of(changes[k], {.count = std::max(options.permutations, needed),
                               .seed = options.seed + static_cast<std::uint64_t>(candidates[k]),
                               .inflation = inflated});
    if (p > least || (p == least && best_gain(changes[k].asked) <= strongest)) continue;
    best = {candidates[k], changes[k].first, 1.0};
    least = p;
    strongest = best_gain(changes[k].asked);
  }
  best.p = std::min(1.0, least * static_cast<double>(candidates.size()));
  return best;
}

/// Pairs of one landmark in order of time, with what they cost at its old and its new place.
struct Timed {
  std::size_t place;
  double gain;  ///< Of the new place.
};

/// Splits a landmark at the place in time that lowers the cost the most.
class Splitter {
 public:
  Splitter(const std::vector<ScanPair>& pairs, const LogBlocks& blocks,
           const std::vector<std::size_t>& places, const DetectionLog& log)
      : pairs_(pairs), blocks_(blocks), places_(places), log_(log) {}

  /// @param place  The first that is of the new landmark.
  Tried split(const Tried& tried, int landmark, std::size_t place) const {
    Tried result = tried;
    const auto fresh = static_cast<int>(tried.names.size());
    result.names.push_back(tried.names[static_cast<std::size_t>(landmark)] + " (moved)");
    result.splits.push_back(landmark);
    result.splits.push_back(fresh);
    for (std::size_t k = 0; k < result.labels.size(); ++k)
      if (result.labels[k] == landmark &&
          places_[static_cast<std::size_t>(log_.detections[k].step)] >= place)
        result.labels[k] = fresh;
    return result;
  }

  /// The map of split labels: both places where their own pairs ask for them.
  RobustMap map_of(const Tried& split, const RobustMap& before) const {
    const std::vector<PairItem> items = items_of(pairs_, split, blocks_);
    Points start(before.positions_m.rows() + 1, 2);
    start.topRows(before.positions_m.rows()) = before.positions_m;
    start.bottomRows(1) = before.positions_m.row(split.splits[split.splits.size() - 2]);
    return unfolded_map(items, lowered_map(items, start, before.width_m), blocks_.count);
  }

  /// Gains of the new place over the old one, in order of time.
  std::vector<Timed> gains(const Tried& tried, int landmark, const RobustMap& map) const {
    std::vector<Timed> result;
    const Eigen::RowVector2d old_m = map.positions_m.row(landmark);
    const Eigen::RowVector2d new_m = map.positions_m.bottomRows(1);
    for (const ScanPair& pair : pairs_) {
      const int a = tried.labels[pair.first];
      const int b = tried.labels[pair.second];
      if (a != landmark && b != landmark) continue;
      const Eigen::RowVector2d partner = map.positions_m.row(a == landmark ? b : a);
      if (!partner.allFinite()) continue;
      result.push_back({places_[static_cast<std::size_t>(pair.step)],
                        huber_cost(pair.distance_m - (partner - old_m).norm(), map.width_m) -
                            huber_cost(pair.distance_m - (partner - new_m).norm(), map.width_m)});
    }
    std::ranges::stable_sort(result, {}, &Timed::place);
    return result;
  }

 private:
  const std::vector<ScanPair>& pairs_;
  const LogBlocks& blocks_;
  const std::vector<std::size_t>& places_;
  const DetectionLog& log_;
};

/// The split that explains the scans best, and between which scans it lies.
struct Change {
  std::size_t place = 0;
  std::size_t earliest = 0;
  std::size_t latest = 0;
};

Change change_of(const std::vector<Timed>& gains, double width_m) {
  // Sums from the end: what is gained if the new place holds from here on.
  std::vector<double> sums(gains.size() + 1, 0.0);
  for (std::size_t k = gains.size(); k-- > 0;) sums[k] = sums[k + 1] + gains[k].gain;
  std::size_t best = 0;
  for (std::size_t k = 1; k < gains.size(); ++k)
    if (sums[k] > sums[best]) best = k;
  // 1.92 is half of chi square's 95 % point of one parameter; scans that follow each other err
  // alike, so that ten of them are taken to tell what one does.
  const double variance = width_m * width_m / 2.25;
  const double enough = sums[best] - 10.0 * 1.92 * variance;
  std::size_t first = best;
  std::size_t last = best;
  while (first > 0 && sums[first - 1] >= enough) --first;
  while (last + 1 < gains.size() && sums[last + 1] >= enough) ++last;
  return {gains[best].place, gains[first > 0 ? first - 1 : 0].place, gains[last].place};
}

void check(const MovedOptions& options) {
  if (!(options.level > 0.0 && options.level < 1.0))
    throw InvalidInput("a level of significance lies between 0 and 1");
  if (options.permutations < 19) throw InvalidInput("a permutation test needs 19 or more");
  if (options.slices < 6) throw InvalidInput("a change in time needs 6 slices or more");
}

}  // namespace

MovedCheck find_moved(const DetectionLog& log, const MovedOptions& options) {
  check(options);
  const std::vector<ScanPair> pairs = scan_pairs(log);
  const LogBlocks blocks = cut_in_blocks(log, pairs, options.slices);
  const std::vector<std::size_t> places = places_in_time(blocks);
  const Splitter splitter(pairs, blocks, places, log);
  Tried tried{log.names, given_labels(log), {}};
  std::vector<PairItem> items = items_of(pairs, tried, blocks);
  RobustMap map = robust_map(items, static_cast<int>(log.names.size()));
  map = unfolded_map(items, std::move(map), blocks.count);
  MovedCheck check{{}, log, map.loss_m, map.loss_m};
  while (std::ssize(check.moved) < options.most_findings) {
    const auto [landmark, rough, p] = least_p(items, map, blocks, tried, options);
    if (landmark < 0 || rough == 0 || p > options.level) break;
    const std::vector<int>& steps = blocks.step_orders.back();
    std::size_t place = 0;
    while (place < steps.size() &&
           blocks.slice[static_cast<std::size_t>(
               blocks.of_step[static_cast<std::size_t>(steps[place])])] < static_cast<int>(rough))
      ++place;
    RobustMap two = splitter.map_of(splitter.split(tried, landmark, place), map);
    const std::vector<Timed> gains = splitter.gains(tried, landmark, two);
    if (gains.empty()) break;
    const Change change = change_of(gains, map.width_m);
    Tried split = splitter.split(tried, landmark, change.place);
    two = splitter.map_of(split, map);
    const double distance = (two.positions_m.row(landmark) - two.positions_m.bottomRows(1)).norm();
    if (!(distance > options.least_move * std::sqrt(residual_variance(map)))) break;
    check.moved.push_back({landmark, steps[change.place], steps[change.earliest],
                           steps[change.latest], distance, p, map.loss_m, two.loss_m});
    tried = std::move(split);
    map = std::move(two);
    items = items_of(pairs, tried, blocks);
  }
  check.loss_after_m = map.loss_m;
  check.split.names = tried.names;
  for (std::size_t k = 0; k < tried.labels.size(); ++k)
    check.split.detections[k].landmark = tried.labels[k];
  sort_detections(check.split.detections);
  return check;
}

}  // namespace mapproof
