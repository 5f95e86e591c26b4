#include "core/association/moved.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "core/association/move_contrast.hpp"
#include "core/association/position_costs.hpp"
#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/random.hpp"
#include "core/statistics/intervals.hpp"

namespace mapproof {
namespace {

constexpr int kPlainlyLarge =
    100;  ///< Permutations that gain as much, after which no more are drawn.
constexpr std::size_t kFewestSlices = 6;
constexpr int kDirections = 12;

/// A distance of the landmark from a known position, in a slice of time.
struct Pull {
  std::size_t slice;
  Eigen::RowVector2d from_m;
  double distance_m;
  double weight;
};

std::vector<Pull> pulls_of(const std::vector<PairItem>& items, const RobustMap& map,
                           const LogBlocks& blocks, int landmark) {
  std::vector<Pull> pulls;
  for (const PairItem& item : items) {
    if (item.first != landmark && item.second != landmark) continue;
    const Eigen::RowVector2d from =
        map.positions_m.row(item.first == landmark ? item.second : item.first);
    if (from.allFinite())
      pulls.push_back({static_cast<std::size_t>(blocks.slice[static_cast<std::size_t>(item.block)]),
                       from, item.distance_m, item.weight});
  }
  return pulls;
}

/// The candidate positions, the map's first.
std::vector<Eigen::RowVector2d> tried_positions(const RobustMap& map, int landmark) {
  double reach = 0.0;
  for (Eigen::Index k = 0; k < map.positions_m.rows(); ++k)
    if (map.positions_m.row(k).allFinite())
      reach = std::max(reach, (map.positions_m.row(k) - map.positions_m.row(landmark)).norm());
  std::vector<Eigen::RowVector2d> positions = {map.positions_m.row(landmark)};
  // Without noise the width is nearly zero: twenty circles reach a millionth of the map.
  for (double radius = std::max(map.width_m / 8.0, 1e-6 * reach);
       radius < 2.0 * reach && radius > 0.0; radius *= 2.0)
    for (int k = 0; k < kDirections; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kDirections;
      positions.emplace_back(positions.front() +
                             radius * Eigen::RowVector2d(std::cos(angle), std::sin(angle)));
    }
  return positions;
}

/// What the pulls of each slice cost at each position.
Eigen::MatrixXd costs_of(const std::vector<Pull>& pulls,
                         const std::vector<Eigen::RowVector2d>& positions, double width_m,
                         std::size_t slices) {
  Eigen::MatrixXd costs =
      Eigen::MatrixXd::Zero(std::ssize(positions), static_cast<Eigen::Index>(slices));
  for (const Pull& pull : pulls)
    for (std::size_t i = 0; i < positions.size(); ++i)
      costs(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(pull.slice)) +=
          pull.weight * huber_cost(pull.distance_m - (positions[i] - pull.from_m).norm(), width_m);
  return costs;
}

/// The shift from a position that a pull asks for.
ShiftSlice asked(const Pull& pull, const Eigen::RowVector2d& position, double width_m) {
  const Eigen::RowVector2d away = position - pull.from_m;
  const double distance = away.norm();
  if (!(distance > 0.0)) return {};
  const Eigen::Vector2d direction = away.transpose() / distance;
  const double residual = pull.distance_m - distance;
  const double weight = pull.weight * std::min(1.0, width_m / std::max(std::abs(residual), 1e-300));
  return {weight * direction * direction.transpose(), weight * residual * direction};
}

/// H^-1 g, and zero in a direction that no pair measures.
Eigen::Vector2d shift_by(const ShiftSlice& sum) {
  const double ridge = 1e-9 * sum.H.trace();
  const double a = sum.H(0, 0) + ridge;
  const double b = sum.H(0, 1);
  const double c = sum.H(1, 1) + ridge;
  const double determinant = a * c - b * b;
  if (!(determinant > 0.0)) return {0.0, 0.0};
  return {(c * sum.g(0) - b * sum.g(1)) / determinant, (a * sum.g(1) - b * sum.g(0)) / determinant};
}

double fall(const ShiftSlice& sum) { return 0.5 * sum.g.dot(shift_by(sum)); }

/// The position near `start` where the pulls of the slices [first, last) cost least.
Eigen::RowVector2d converged(const std::vector<Pull>& pulls, Eigen::RowVector2d position,
                             std::size_t first, std::size_t last, double width_m) {
  constexpr int kRounds = 20;
  for (int round = 0; round < kRounds; ++round) {
    ShiftSlice sum;
    for (const Pull& pull : pulls) {
      if (pull.slice < first || pull.slice >= last) continue;
      const ShiftSlice one = asked(pull, position, width_m);
      sum.H += one.H;
      sum.g += one.g;
    }
    position += shift_by(sum).transpose();
  }
  return position;
}

struct Split {
  double cost = 0.0;
  std::size_t first = 0;  ///< Slice of the second position; 0: none.
  Eigen::Index old = 0;
  Eigen::Index fresh = 0;  ///< Rows of the positions.
};

Split best_split(const Eigen::MatrixXd& costs) {
  std::vector<Eigen::Index> shown;
  for (Eigen::Index k = 0; k < costs.cols(); ++k)
    if (costs.col(k).maxCoeff() > 0.0) shown.push_back(k);
  Eigen::VectorXd after = costs.rowwise().sum();
  Eigen::VectorXd before = Eigen::VectorXd::Zero(costs.rows());
  Split best{after.minCoeff(), 0, 0, 0};
  for (std::size_t k = 0; k + 2 < shown.size(); ++k) {
    before += costs.col(shown[k]);
    after -= costs.col(shown[k]);
    if (k == 0) continue;
    Eigen::Index old = 0;
    Eigen::Index fresh = 0;
    const double cost = before.minCoeff(&old) + after.minCoeff(&fresh);
    if (cost < best.cost) best = {cost, static_cast<std::size_t>(shown[k + 1]), old, fresh};
  }
  return best;
}

template <typename Value>
void shuffle(std::vector<Value>& values, Random& random) {
  for (std::size_t k = values.size(); k-- > 1;)
    std::swap(values[k],
              values[static_cast<std::size_t>(random.uniform() * static_cast<double>(k + 1))]);
}

/// The share of permutations whose gain, inflated, is as large; the change itself among them.
double share_of(std::vector<ShiftSlice> slices, double gain, double inflation, int count,
                Random& random) {
  int as_much = 1;
  int drawn = 1;
  while (drawn <= count && as_much < kPlainlyLarge) {
    shuffle(slices, random);
    as_much += inflation * best_gain(slices) >= gain ? 1 : 0;
    ++drawn;
  }
  return static_cast<double>(as_much) / drawn;
}

/// The log under test, some landmarks already split.
struct Tried {
  std::vector<std::string> names;
  std::vector<int> ids;
  std::vector<int> splits;  ///< Landmarks that were split, and their later halves.
};

std::vector<PairItem> items_of(const std::vector<ScanPair>& pairs, const Tried& tried,
                               const LogBlocks& blocks) {
  return pair_items(pairs, tried.ids, blocks);
}

/// Index in time of each step.
std::vector<std::size_t> indices_in_time(const LogBlocks& blocks) {
  const std::vector<int>& order = blocks.step_orders.back();
  std::vector<std::size_t> positions(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) positions[static_cast<std::size_t>(order[k])] = k;
  return positions;
}

/// A landmark that may have moved.
struct Suspect {
  int landmark = -1;
  std::size_t slice = 0;  ///< With which its second position begins.
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
  std::vector<PositionChange> changes;
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

/// Pairs of one landmark in order of time, with what they cost at its old and its new position.
struct Timed {
  std::size_t position;
  double gain;  ///< Of the new position.
};

/// Splits a landmark at the index in time that reduces the cost the most.
class Splitter {
 public:
  Splitter(const std::vector<ScanPair>& pairs, const LogBlocks& blocks,
           const std::vector<std::size_t>& positions, const DetectionLog& log)
      : pairs_(pairs), blocks_(blocks), positions_(positions), log_(log) {}

  /// @param place  The first that is of the new landmark.
  Tried split(const Tried& tried, int landmark, std::size_t position) const {
    Tried result = tried;
    const auto fresh = static_cast<int>(tried.names.size());
    result.names.push_back(tried.names[static_cast<std::size_t>(landmark)] + " (moved)");
    result.splits.push_back(landmark);
    result.splits.push_back(fresh);
    for (std::size_t k = 0; k < result.ids.size(); ++k)
      if (result.ids[k] == landmark &&
          positions_[static_cast<std::size_t>(log_.detections[k].step)] >= position)
        result.ids[k] = fresh;
    return result;
  }

  /// The map of split IDs: both positions where their own pairs ask for them.
  RobustMap map_of(const Tried& split, const RobustMap& before) const {
    const std::vector<PairItem> items = items_of(pairs_, split, blocks_);
    Points start(before.positions_m.rows() + 1, 2);
    start.topRows(before.positions_m.rows()) = before.positions_m;
    start.bottomRows(1) = before.positions_m.row(split.splits[split.splits.size() - 2]);
    return unfolded_map(items, minimized_map(items, start, before.width_m), blocks_.count);
  }

  /// Gains of the new position over the old one, in order of time.
  std::vector<Timed> gains(const Tried& tried, int landmark, const RobustMap& map) const {
    std::vector<Timed> result;
    const Eigen::RowVector2d old_m = map.positions_m.row(landmark);
    const Eigen::RowVector2d new_m = map.positions_m.bottomRows(1);
    for (const ScanPair& pair : pairs_) {
      const int a = tried.ids[pair.first];
      const int b = tried.ids[pair.second];
      if (a != landmark && b != landmark) continue;
      const Eigen::RowVector2d partner = map.positions_m.row(a == landmark ? b : a);
      if (!partner.allFinite()) continue;
      result.push_back({positions_[static_cast<std::size_t>(pair.step)],
                        huber_cost(pair.distance_m - (partner - old_m).norm(), map.width_m) -
                            huber_cost(pair.distance_m - (partner - new_m).norm(), map.width_m)});
    }
    std::ranges::stable_sort(result, {}, &Timed::position);
    return result;
  }

 private:
  const std::vector<ScanPair>& pairs_;
  const LogBlocks& blocks_;
  const std::vector<std::size_t>& positions_;
  const DetectionLog& log_;
};

/// The split that explains the scans best, and between which scans it lies.
struct Change {
  std::size_t position = 0;
  std::size_t earliest = 0;
  std::size_t latest = 0;
};

Change change_of(const std::vector<Timed>& gains, double width_m) {
  // Sums from the end: the gain if the new position holds from here on.
  std::vector<double> sums(gains.size() + 1, 0.0);
  for (std::size_t k = gains.size(); k-- > 0;) sums[k] = sums[k + 1] + gains[k].gain;
  std::size_t best = 0;
  for (std::size_t k = 1; k < gains.size(); ++k)
    if (sums[k] > sums[best]) best = k;
  // 1.92 is half of chi square's 95 % point of one parameter; consecutive scans have correlated
  // errors, so that ten of them are taken as one independent scan.
  const double variance = width_m * width_m / 2.25;
  const double enough = sums[best] - 10.0 * 1.92 * variance;
  std::size_t first = best;
  std::size_t last = best;
  while (first > 0 && sums[first - 1] >= enough) --first;
  while (last + 1 < gains.size() && sums[last + 1] >= enough) ++last;
  return {gains[best].position, gains[first > 0 ? first - 1 : 0].position, gains[last].position};
}

void check(const MovedOptions& options) {
  if (!(options.level > 0.0 && options.level < 1.0))
    throw InvalidInput("the level of significance must lie between 0 and 1");
  if (options.permutations < 19)
    throw InvalidInput("a permutation test needs 19 permutations or more");
  if (options.slices < 6) throw InvalidInput("a change in time needs 6 slices or more");
}

}  // namespace

double best_gain(const std::vector<ShiftSlice>& slices) {
  ShiftSlice all;
  for (const ShiftSlice& slice : slices) {
    all.H += slice.H;
    all.g += slice.g;
  }
  double best = 0.0;
  ShiftSlice before;
  for (std::size_t k = 0; k + 2 < slices.size(); ++k) {
    before.H += slices[k].H;
    before.g += slices[k].g;
    if (k > 0) best = std::max(best, fall(before) + fall({all.H - before.H, all.g - before.g}));
  }
  return best - fall(all);
}

PositionChange best_change(const std::vector<PairItem>& items, const RobustMap& map,
                           const LogBlocks& blocks, int landmark) {
  PositionChange change;
  const std::vector<Pull> pulls = pulls_of(items, map, blocks, landmark);
  if (pulls.empty()) return change;
  const std::size_t slices = static_cast<std::size_t>(*std::ranges::max_element(blocks.slice)) + 1;
  const std::vector<Eigen::RowVector2d> positions = tried_positions(map, landmark);
  const Split split = best_split(costs_of(pulls, positions, map.width_m, slices));
  if (split.first == 0) return change;
  change.first = split.first;
  const Eigen::RowVector2d old_m =
      converged(pulls, positions[static_cast<std::size_t>(split.old)], 0, split.first, map.width_m);
  const Eigen::RowVector2d new_m = converged(
      pulls, positions[static_cast<std::size_t>(split.fresh)], split.first, slices, map.width_m);
  std::vector<ShiftSlice> residual(slices);
  for (const Pull& pull : pulls) {
    const ShiftSlice one = asked(pull, pull.slice < split.first ? old_m : new_m, map.width_m);
    residual[pull.slice].H += one.H;
    residual[pull.slice].g += one.g;
  }
  const Eigen::Vector2d apart = (new_m - old_m).transpose();
  for (std::size_t k = 0; k < slices; ++k) {
    if (residual[k].H.trace() == 0.0) continue;
    change.residual.push_back(residual[k]);
    change.asked.push_back(residual[k]);
    if (k >= split.first) change.asked.back().g += residual[k].H * apart;
  }
  return change;
}

double chance_of(const PositionChange& change, const PermutationOptions& options) {
  if (change.residual.size() < kFewestSlices) return 1.0;
  Random random(options.seed);
  const double gain = best_gain(change.asked);
  const double alone = share_of(change.asked, gain, 1.0, options.count, random);
  return std::max(alone, share_of(change.residual, gain, options.inflation, options.count, random));
}

double inflation(const std::vector<PositionChange>& landmarks, std::uint64_t seed) {
  constexpr int kShuffles = 39;
  Random random(seed);
  std::vector<double> ratios;
  for (const PositionChange& change : landmarks) {
    if (change.residual.size() < kFewestSlices) continue;
    std::vector<ShiftSlice> shuffled = change.residual;
    std::vector<double> gains;
    for (int k = 0; k < kShuffles; ++k) {
      shuffle(shuffled, random);
      gains.push_back(best_gain(shuffled));
    }
    const double by_chance = median(gains);
    if (by_chance > 0.0) ratios.push_back(best_gain(change.asked) / by_chance);
  }
  return ratios.empty() ? 1.0 : std::max(1.0, median(ratios));
}

MovedCheck find_moved(const DetectionLog& log, const MovedOptions& options) {
  check(options);
  const std::vector<ScanPair> pairs = scan_pairs(log);
  const LogBlocks blocks = cut_in_blocks(log, pairs, options.slices);
  const std::vector<std::size_t> positions = indices_in_time(blocks);
  const Splitter splitter(pairs, blocks, positions, log);
  Tried tried{log.names, given_ids(log), {}};
  std::vector<PairItem> items = items_of(pairs, tried, blocks);
  RobustMap map = robust_map(items, static_cast<int>(log.names.size()));
  map = unfolded_map(items, std::move(map), blocks.count);
  MovedCheck check{{}, log, map.loss_m, map.loss_m};
  while (std::ssize(check.moved) < options.most_findings) {
    const auto [landmark, rough, p] = least_p(items, map, blocks, tried, options);
    if (landmark < 0 || rough == 0 || p > options.level) break;
    if (options.is_contrasted &&
        contrast_ratio(move_contrasts(items, map, blocks), landmark) <= 1.0)
      break;
    const std::vector<int>& steps = blocks.step_orders.back();
    std::size_t position = 0;
    while (position < steps.size() &&
           blocks.slice[static_cast<std::size_t>(
               blocks.of_step[static_cast<std::size_t>(steps[position])])] <
               static_cast<int>(rough))
      ++position;
    RobustMap two = splitter.map_of(splitter.split(tried, landmark, position), map);
    const std::vector<Timed> gains = splitter.gains(tried, landmark, two);
    if (gains.empty()) break;
    const Change change = change_of(gains, map.width_m);
    Tried split = splitter.split(tried, landmark, change.position);
    two = splitter.map_of(split, map);
    const double distance = (two.positions_m.row(landmark) - two.positions_m.bottomRows(1)).norm();
    if (!(distance > options.least_move * std::sqrt(residual_variance(map)))) break;
    check.moved.push_back({landmark, steps[change.position], steps[change.earliest],
                           steps[change.latest], distance, p, map.loss_m, two.loss_m});
    tried = std::move(split);
    map = std::move(two);
    items = items_of(pairs, tried, blocks);
  }
  check.loss_after_m = map.loss_m;
  check.split.names = tried.names;
  for (std::size_t k = 0; k < tried.ids.size(); ++k)
    check.split.detections[k].landmark = tried.ids[k];
  sort_detections(check.split.detections);
  return check;
}

}  // namespace mapproof
