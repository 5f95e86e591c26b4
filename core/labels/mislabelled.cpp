#include "core/labels/mislabelled.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/words.hpp"
#include "core/labels/place_costs.hpp"

namespace mapproof {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kWidths = 1.5;     ///< Standard deviations in RobustMap::width_m.
constexpr std::size_t kTried = 40;  ///< Hypotheses that a map is made for.
constexpr std::size_t kBegunAnew =
    4;  ///< The best of each kind, whose maps are made from nothing too.

/// Steps of one order that a fault holds in: [begin, end) places.
struct Stretch {
  std::size_t order = 0;
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The log in the form that the search needs.
struct Search {
  const SightingLog& log;
  std::vector<LookPair> pairs;
  LogBlocks blocks;
  std::vector<std::vector<std::size_t>> places;  ///< Of each step in each order.
};

Search prepared(const SightingLog& log, int most_blocks) {
  if (most_blocks < 1) throw InvalidInput("a log is cut into one block or more");
  Search search{log, look_pairs(log), {}, {}};
  search.blocks = cut_in_blocks(log, search.pairs, 24);
  const int robots = std::max(1, search.blocks.count / 24);
  search.blocks = cut_in_blocks(log, search.pairs, std::max(1, most_blocks / (robots + 1)));
  for (const std::vector<int>& order : search.blocks.step_orders) {
    std::vector<std::size_t> places(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) places[static_cast<std::size_t>(order[k])] = k;
    search.places.push_back(std::move(places));
  }
  return search;
}

/// The steps of a stretch of blocks: from the first step of any of them to the last.
Stretch steps_of(const Search& search, const LabelHypothesis& one) {
  const auto order = static_cast<std::size_t>(one.order);
  std::vector<char> inside(static_cast<std::size_t>(search.blocks.count), 0);
  for (int k = one.begin; k < one.end; ++k)
    inside[static_cast<std::size_t>(
        search.blocks.block_orders[order][static_cast<std::size_t>(k)])] = 1;
  const std::vector<int>& steps = search.blocks.step_orders[order];
  const auto is_inside = [&](int step) {
    return inside[static_cast<std::size_t>(
               search.blocks.of_step[static_cast<std::size_t>(step)])] != 0;
  };
  const auto first = std::ranges::find_if(steps, is_inside);
  const auto last = std::find_if(steps.rbegin(), steps.rend(), is_inside);
  return {order, static_cast<std::size_t>(first - steps.begin()),
          static_cast<std::size_t>(steps.rend() - last)};
}

int other_label(const LabelHypothesis& one, int label) {
  if (label == one.first) return one.second;
  return one.fault == LabelFault::kSwapped && label == one.second ? one.first : label;
}

/// The labels with the fault mended over the stretch.
std::vector<int> mended(const Search& search, std::vector<int> labels, const LabelHypothesis& one,
                        const Stretch& stretch) {
  const std::vector<std::size_t>& places = search.places[stretch.order];
  const std::vector<Sighting>& sightings = search.log.sightings;
  for (std::size_t row = 0, end = 0; row < sightings.size(); row = end) {
    bool taken = false;  // a landmark is seen once in a look
    for (end = row; end < sightings.size() && sightings[end].step == sightings[row].step; ++end)
      taken = taken || labels[end] == one.second;
    const std::size_t place = places[static_cast<std::size_t>(sightings[row].step)];
    if (place < stretch.begin || place >= stretch.end) continue;
    if (taken && one.fault == LabelFault::kWrong) continue;
    for (std::size_t k = row; k < end; ++k) labels[k] = other_label(one, labels[k]);
  }
  return labels;
}

/// The stretch of steps over which the fault explains the looks better, in a map that holds it.
Stretch sharpened(const Search& search, const std::vector<int>& labels, const LabelHypothesis& one,
                  const RobustMap& map) {
  const auto order = static_cast<std::size_t>(one.order);
  Eigen::VectorXd gains = Eigen::VectorXd::Zero(search.log.steps);
  const auto cost = [&](int a, int b, double distance) {
    const double between = (map.positions_m.row(a) - map.positions_m.row(b)).norm();
    return std::isnan(between) ? 0.0 : huber_cost(distance - between, map.width_m);
  };
  for (const LookPair& pair : search.pairs) {
    const int a = labels[pair.first];
    const int b = labels[pair.second];
    gains(static_cast<Eigen::Index>(search.places[order][static_cast<std::size_t>(pair.step)])) +=
        cost(a, b, pair.distance_m) -
        cost(other_label(one, a), other_label(one, b), pair.distance_m);
  }
  // The stretch of the greatest sum, in one pass.
  Stretch best{order, 0, 0};
  double greatest = 0.0;
  double sum = 0.0;
  std::size_t begin = 0;
  for (Eigen::Index k = 0; k < gains.size(); ++k) {
    if (sum <= 0.0) {
      sum = 0.0;
      begin = static_cast<std::size_t>(k);
    }
    sum += gains(k);
    if (sum > greatest) {
      greatest = sum;
      best = {order, begin, static_cast<std::size_t>(k) + 1};
    }
  }
  return best;
}

/// The items with the fault mended in whole blocks: what makes trying many cheap.
std::vector<PairItem> mended_items(const Search& search, const std::vector<PairItem>& items,
                                   const LabelHypothesis& one) {
  std::vector<char> inside(static_cast<std::size_t>(search.blocks.count), 0);
  const std::vector<int>& order = search.blocks.block_orders[static_cast<std::size_t>(one.order)];
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

/// The map under mended labels, from the one before with both landmarks put where the fault has
/// them.
RobustMap moved_map(const std::vector<PairItem>& items, const RobustMap& map,
                    const LabelHypothesis& one) {
  Points start = map.positions_m;
  start.row(one.first) = one.first_m;
  start.row(one.second) = one.second_m;
  return lowered_map(items, start, map.width_m);
}

/// The better one of that map and of one from nothing: wrong labels may have folded the map before.
RobustMap refolded_map(const Search& search, const std::vector<PairItem>& items,
                       const RobustMap& map, const LabelHypothesis& one) {
  RobustMap moved = moved_map(items, map, one);
  const auto landmarks = static_cast<int>(map.positions_m.rows());
  RobustMap anew = lowered_map(items, robust_map(items, landmarks).positions_m, map.width_m);
  return unfolded_map(items, anew.cost < moved.cost ? std::move(anew) : std::move(moved),
                      search.blocks.count);
}

/// A fault that was tried, and what came of it.
struct Trial {
  LabelHypothesis fault;
  Stretch stretch;
  std::vector<int> labels;
  RobustMap map;
};

/// The fault over the stretch of steps that its map makes of it.
Trial sharp_trial(const Search& search, const std::vector<int>& labels, LabelHypothesis one,
                  RobustMap map) {
  Trial trial{one, sharpened(search, labels, one, map), {}, std::move(map)};
  trial.labels = mended(search, labels, one, trial.stretch);
  trial.fault.first_m = trial.map.positions_m.row(one.first);
  trial.fault.second_m = trial.map.positions_m.row(one.second);
  trial.map =
      moved_map(pair_items(search.pairs, trial.labels, search.blocks), trial.map, trial.fault);
  return trial;
}

/// The first few of each kind of fault.
void choose(const std::vector<LabelHypothesis>& from, std::vector<LabelHypothesis>& chosen) {
  std::map<LabelFault, std::size_t> taken;
  for (const LabelHypothesis& one : from)
    if (taken[one.fault]++ < kBegunAnew) chosen.push_back(one);
}

/// The hypotheses that are promising enough to be tried from nothing.
std::vector<LabelHypothesis> worth_a_map(const Search& search, const std::vector<PairItem>& items,
                                         const RobustMap& map) {
  std::vector<LabelHypothesis> in_map = hypotheses_in_map(items, map, search.blocks, kTried);
  for (LabelHypothesis& one : in_map)
    one.gain = map.cost - moved_map(mended_items(search, items, one), map, one).cost;
  std::ranges::stable_sort(in_map, std::greater<>(), &LabelHypothesis::gain);
  std::vector<LabelHypothesis> chosen;
  choose(in_map, chosen);
  choose(hypotheses_of_distances(items, map, search.blocks, kTried), chosen);
  return chosen;
}

/// Whether a look holds a sighting of a landmark.
bool seen_in_look(const SightingLog& log, const std::vector<int>& labels, std::size_t row,
                  int landmark) {
  const int step = log.sightings[row].step;
  while (row > 0 && log.sightings[row - 1].step == step) --row;
  for (; row < labels.size() && log.sightings[row].step == step; ++row)
    if (labels[row] == landmark) return true;
  return false;
}

/// What each sighting costs in a map under each label in its place, its look's others keeping
/// theirs: sightings x landmarks, nothing
/// but of those that bear `label`.
Eigen::MatrixXd label_costs(const Search& search, const std::vector<int>& labels,
                            const RobustMap& map, int label) {
  const Eigen::Index M = map.positions_m.rows();
  Eigen::MatrixXd costs = Eigen::MatrixXd::Zero(std::ssize(labels), M);
  for (const LookPair& pair : search.pairs)
    for (const auto& [own, other] :
         {std::pair(pair.first, pair.second), std::pair(pair.second, pair.first)}) {
      if (labels[own] != label) continue;
      const Eigen::RowVector2d partner = map.positions_m.row(labels[other]);
      for (Eigen::Index k = 0; k < M; ++k)
        costs(static_cast<Eigen::Index>(own), k) +=
            huber_cost(pair.distance_m - (map.positions_m.row(k) - partner).norm(), map.width_m);
    }
  return costs;
}

/// Single sightings under one label that are another landmark's, whenever they were: those that
/// cost more than chance makes them and less than half under the other label.
std::optional<Trial> mixed_trial(const Search& search, const std::vector<int>& labels,
                                 const RobustMap& map) {
  const double much = 8.0 * map.width_m * map.width_m / (kWidths * kWidths);
  const auto M = static_cast<int>(map.positions_m.rows());
  Trial best;
  double greatest = 0.0;
  for (int a = 0; a < M && map.positions_m.row(a).allFinite(); ++a) {
    const Eigen::MatrixXd costs = label_costs(search, labels, map, a);
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
    best.fault = {.fault = LabelFault::kMixed, .first = a, .second = b};
    best.stretch = {0, 0, search.places.front().size()};
    best.labels = labels;
    for (std::size_t row = 0; row < labels.size(); ++row)
      if (labels[row] == a && mistaken(static_cast<Eigen::Index>(row), b) &&
          !seen_in_look(search.log, labels, row, b))
        best.labels[row] = b;
  }
  if (greatest == 0.0) return std::nullopt;
  best.map = lowered_map(pair_items(search.pairs, best.labels, search.blocks), map.positions_m,
                         map.width_m);
  return best;
}

/// The fault that lowers the cost the most; empty if none does. The best of each kind is sharpened
/// before they are compared: whole blocks favour now one, now the other.
std::optional<Trial> best_trial(const Search& search, const std::vector<int>& labels,
                                const RobustMap& map) {
  const std::vector<PairItem> items = pair_items(search.pairs, labels, search.blocks);
  std::map<LabelFault, std::pair<LabelHypothesis, RobustMap>> best;
  for (const LabelHypothesis& one : worth_a_map(search, items, map)) {
    RobustMap other = refolded_map(search, mended_items(search, items, one), map, one);
    const auto found = best.find(one.fault);
    if (other.cost < (found == best.end() ? map.cost : found->second.second.cost))
      best[one.fault] = {one, std::move(other)};
  }
  std::optional<Trial> lowest;
  for (const auto& [fault, found] : best) {
    Trial trial = sharp_trial(search, labels, found.first, found.second);
    if (trial.map.cost < (lowest ? lowest->map.cost : map.cost)) lowest = std::move(trial);
  }
  std::optional<Trial> mixed = mixed_trial(search, labels, map);
  if (mixed && mixed->map.cost < (lowest ? lowest->map.cost : map.cost)) lowest = std::move(mixed);
  return lowest;
}

/// How well the fall of the cost is explained by the labels tried.
struct Explanation {
  double share = 0.0;        ///< The fall, of what all pairs of both labels cost.
  double left = 0.0;         ///< What a relabelled pair costs on the average, in variances.
  std::size_t partners = 0;  ///< Landmarks that relabelled sightings are seen with.
};

Explanation explained(const Search& search, const std::vector<int>& labels, const RobustMap& before,
                      const Trial& trial) {
  double concerned = 0.0;
  for (const PairItem& item : pair_items(search.pairs, labels, search.blocks))
    for (const int label : {trial.fault.first, trial.fault.second})
      if (item.first == label || item.second == label) {
        concerned += map_cost({item}, before.positions_m, before.width_m);
        break;
      }
  std::vector<char> partners(search.log.names.size(), 0);
  double after = 0.0;
  int count = 0;
  for (const LookPair& pair : search.pairs) {
    const int a = trial.labels[pair.first];
    const int b = trial.labels[pair.second];
    const bool first_changed = a != labels[pair.first];
    const bool second_changed = b != labels[pair.second];
    if (!first_changed && !second_changed) continue;
    const double between = (trial.map.positions_m.row(a) - trial.map.positions_m.row(b)).norm();
    if (std::isnan(between)) continue;
    after += huber_cost(pair.distance_m - between, before.width_m);
    ++count;
    if (first_changed) partners[static_cast<std::size_t>(b)] = 1;
    if (second_changed) partners[static_cast<std::size_t>(a)] = 1;
  }
  const double variance = before.width_m * before.width_m / (kWidths * kWidths);
  return {concerned > 0.0 ? (before.cost - trial.map.cost) / concerned : 0.0,
          after / variance / std::max(count, 1),
          static_cast<std::size_t>(std::ranges::count(partners, 1))};
}

/// Where and when the sightings are that a trial relabelled.
LabelFinding found(const Search& search, const std::vector<int>& labels, const Trial& trial) {
  LabelFinding finding{.fault = trial.fault.fault,
                       .first = trial.fault.first,
                       .second = trial.fault.second,
                       .by_time = trial.stretch.order > 0};
  const std::vector<std::size_t>& places = search.places[trial.stretch.order];
  std::size_t first = places.size();
  std::size_t last = 0;
  std::size_t first_of_all = places.size();
  std::size_t last_of_all = 0;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    if (labels[k] != finding.first && labels[k] != finding.second) continue;
    const std::size_t place = places[static_cast<std::size_t>(search.log.sightings[k].step)];
    first_of_all = std::min(first_of_all, place);
    last_of_all = std::max(last_of_all, place);
    if (labels[k] == trial.labels[k]) continue;
    ++finding.sightings;
    first = std::min(first, place);
    last = std::max(last, place);
  }
  if (finding.sightings == 0) return finding;
  finding.from_the_start = first == first_of_all;
  finding.to_the_end = last == last_of_all;
  const std::vector<int>& steps = search.blocks.step_orders[trial.stretch.order];
  finding.first_step = steps[first];
  finding.last_step = steps[last];
  const std::vector<double>& times = search.log.times_s;
  const auto time = [&](int step) {
    return times.empty() ? kUnknown : times[static_cast<std::size_t>(step)];
  };
  finding.first_time_s = time(finding.first_step);
  finding.last_time_s = time(finding.last_step);
  return finding;
}

/// A swap that changes most sightings of both labels is its complement under other names.
void turn_to_minority(const Search& search, const std::vector<int>& labels, Trial& trial) {
  if (trial.fault.fault != LabelFault::kSwapped) return;
  std::size_t changed = 0;
  std::size_t all = 0;
  for (std::size_t k = 0; k < labels.size(); ++k)
    if (labels[k] == trial.fault.first || labels[k] == trial.fault.second) {
      ++all;
      changed += labels[k] != trial.labels[k] ? 1 : 0;
    }
  const LabelFinding finding = found(search, labels, trial);
  if (2 * changed <= all || finding.from_the_start == finding.to_the_end) return;
  const std::size_t steps = search.places.front().size();
  trial.stretch = finding.from_the_start ? Stretch{trial.stretch.order, trial.stretch.end, steps}
                                         : Stretch{trial.stretch.order, 0, trial.stretch.begin};
  trial.labels = mended(search, labels, trial.fault, trial.stretch);
  trial.map.positions_m.row(trial.fault.first).swap(trial.map.positions_m.row(trial.fault.second));
}

/// What gains little in many looks may be a sensor's error in one part of the hall.
bool convincing(const Explanation& explanation, const LabelCheckOptions& options) {
  return explanation.share >= options.least_share && explanation.left <= options.most_left &&
         explanation.partners >= static_cast<std::size_t>(options.fewest_partners);
}

SightingLog relabelled(const SightingLog& log, const std::vector<int>& labels) {
  SightingLog result = log;
  for (std::size_t k = 0; k < labels.size(); ++k) result.sightings[k].landmark = labels[k];
  const auto key = [](const Sighting& one) { return std::tuple(one.step, one.landmark); };
  std::ranges::stable_sort(result.sightings, {}, key);
  const auto repeated = std::ranges::unique(result.sightings, {}, key);
  result.sightings.erase(repeated.begin(), repeated.end());
  return result;
}

}  // namespace

LabelCheck check_labels(const SightingLog& log, const LabelCheckOptions& options) {
  const Search search = prepared(log, options.most_blocks);
  std::vector<int> labels = given_labels(log);
  std::vector<PairItem> items = pair_items(search.pairs, labels, search.blocks);
  RobustMap map = robust_map(items, static_cast<int>(log.names.size()));
  map = unfolded_map(items, std::move(map), search.blocks.count);
  LabelCheck check{
      .findings = {}, .loss_before_m = map.loss_m, .loss_after_m = map.loss_m, .repaired = log};
  for (int round = 0; round < options.most_findings; ++round) {
    std::optional<Trial> trial = best_trial(search, labels, map);
    if (!trial) break;
    const double fall = map.cost - trial->map.cost;
    const double evidence = fall / (map.width_m * map.width_m / (kWidths * kWidths));
    if (evidence < options.least_evidence ||
        !convincing(explained(search, labels, map, *trial), options))
      break;
    turn_to_minority(search, labels, *trial);
    LabelFinding finding = found(search, labels, *trial);
    if (finding.sightings < std::max(1, options.fewest_sightings)) break;
    finding.evidence = evidence;
    finding.loss_before_m = map.loss_m;
    finding.loss_after_m = trial->map.loss_m;
    check.findings.push_back(finding);
    labels = std::move(trial->labels);
    map = std::move(trial->map);
  }
  check.loss_after_m = map.loss_m;
  check.repaired = relabelled(log, labels);
  return check;
}

std::string described(const LabelFinding& finding, const SightingLog& log) {
  const auto label = [&](int k) { return printable(log.names[static_cast<std::size_t>(k)]); };
  const auto place = [&](int step, double time) {
    return finding.by_time ? fmt::format("{:.1f} s", time) : fmt::format("step {}", step + 1);
  };
  const std::string first = place(finding.first_step, finding.first_time_s);
  const std::string last = place(finding.last_step, finding.last_time_s);
  const std::string when = finding.to_the_end && finding.from_the_start ? "throughout"
                           : finding.to_the_end                         ? "from " + first + " on"
                           : finding.from_the_start                     ? "up to " + last
                                                    : "from " + first + " to " + last;
  const std::string what =
      finding.fault == LabelFault::kSwapped
          ? fmt::format("{} and {} look swapped", label(finding.first), label(finding.second))
      : finding.fault == LabelFault::kWrong
          ? fmt::format("{} looks like {}", label(finding.first), label(finding.second))
          : fmt::format("some of {} look like {}", label(finding.first), label(finding.second));
  return fmt::format("{} {} ({}): loss {:.3f} -> {:.3f} m", what, when,
                     counted(finding.sightings, "sighting"), finding.loss_before_m,
                     finding.loss_after_m);
}

}  // namespace mapproof
