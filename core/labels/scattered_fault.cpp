#include "core/labels/scattered_fault.hpp"

#include <algorithm>

#include "core/labels/place_costs.hpp"
#include "core/labels/scan_by_scan.hpp"
#include "core/labels/scan_costs.hpp"
#include "core/labels/two_places.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kSettledPairs = 4;  ///< Twos of labels that are settled.
constexpr double kLeastGain = 0.3;        ///< Of the first one's.
/// So rare, and so much rarer than the other label's, one label's changes are chance.
constexpr double kByChance = 0.1;
constexpr double kRarer = 0.25;
/// Scans against a stretch, as a share of those that it explains, and what it may cost more.
constexpr double kStrays = 0.05;
constexpr double kAsGood = 1.1;

/// Detections that a trial gives another label, of each of both.
struct Changes {
  double all = 0.0;
  double first_share = 0.0;  ///< Of those under the first label.
  double second_share = 0.0;

  bool one_sided() const {
    const auto [less, more] = std::minmax(first_share, second_share);
    return less < kByChance && less < kRarer * more;
  }
};

Changes changes_of(const std::vector<int>& labels, const FaultTrial& trial) {
  double first = 0.0;
  double second = 0.0;
  double of_first = 1.0;
  double of_second = 1.0;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const double changed = labels[k] != trial.labels[k] ? 1.0 : 0.0;
    if (labels[k] == trial.fault.first) {
      of_first += 1.0;
      first += changed;
    } else if (labels[k] == trial.fault.second) {
      of_second += 1.0;
      second += changed;
    }
  }
  return {first + second, first / of_first, second / of_second};
}

FaultTrial settled(const LabelledScans& scans, const std::vector<int>& labels,
                   const SharedPlaces& shared, const Points& start, LabelFault fault, bool turned,
                   double width_m) {
  FaultTrial trial;
  trial.fault.fault = fault;
  trial.fault.first = turned ? shared.second : shared.first;
  trial.fault.second = turned ? shared.first : shared.second;
  trial.stretch = {0, 0, scans.places.front().size()};
  trial.scattered = true;
  return settled_trial(scans, labels, labels, std::move(trial), start, shared.map.width_m, width_m);
}

/// Both ways of telling whose the places are; of them the simpler one.
FaultTrial simpler_trial(const LabelledScans& scans, const std::vector<int>& labels,
                         const SharedPlaces& shared, double width_m) {
  const Points& start = shared.map.positions_m;
  Points exchanged = start;
  exchanged.row(shared.first).swap(exchanged.row(shared.second));
  FaultTrial best = settled(scans, labels, shared, start, LabelFault::kSwapped, false, width_m);
  FaultTrial other =
      settled(scans, labels, shared, exchanged, LabelFault::kSwapped, false, width_m);
  Changes changes = changes_of(labels, best);
  const Changes of_other = changes_of(labels, other);
  if (changes.one_sided() != of_other.one_sided() ? of_other.one_sided()
                                                  : of_other.all < changes.all) {
    best = std::move(other);
    changes = of_other;
  }
  if (!changes.one_sided()) return best;
  const Points places = best.map.positions_m;
  return settled(scans, labels, shared, places, LabelFault::kInPart,
                 changes.second_share > changes.first_share, width_m);
}

/// For each place of an order: scans given another label, less those that tell and keep theirs.
Eigen::VectorXi balance(const LabelledScans& scans, const std::vector<int>& labels,
                        const FaultTrial& trial, std::size_t order) {
  Eigen::VectorXi result = Eigen::VectorXi::Zero(scans.log.steps);
  const bool both = trial.fault.fault == LabelFault::kSwapped;
  ScanCosts costs(scans, trial.map.positions_m, 1.0);
  for (std::size_t row = 0, end = 0; row < labels.size(); row = end) {
    end = costs.take(labels, row, trial.fault.first, trial.fault.second);
    if (!costs.tells()) continue;
    const auto step = static_cast<std::size_t>(scans.log.detections[row].step);
    int& sum = result(static_cast<Eigen::Index>(scans.places[order][step]));
    for (std::size_t k = row; k < end; ++k)
      if (labels[k] == trial.fault.first || (both && labels[k] == trial.fault.second))
        sum = labels[k] != trial.labels[k] ? 1 : -1;
  }
  return result;
}

/// The stretch that holds the fault, if there is one but for a few scans.
std::optional<StepStretch> stretch_of(const LabelledScans& scans, const std::vector<int>& labels,
                                      const FaultTrial& trial) {
  for (std::size_t order = 0; order < scans.places.size(); ++order) {
    const Eigen::VectorXi balances = balance(scans, labels, trial, order);
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

/// The same fault over a stretch, where detections that no scan tells of are corrected too.
FaultTrial over_stretch(const LabelledScans& scans, const std::vector<int>& labels,
                        FaultTrial trial, double width_m) {
  const std::optional<StepStretch> stretch = stretch_of(scans, labels, trial);
  if (!stretch) return trial;
  FaultTrial whole = trial;
  whole.scattered = false;
  whole.stretch = *stretch;
  if (whole.fault.fault == LabelFault::kInPart) whole.fault.fault = LabelFault::kWrong;
  whole.labels = corrected_labels(scans, labels, whole.fault, *stretch);
  whole = settled_trial(scans, labels, std::vector(whole.labels), whole, trial.map.positions_m,
                        width_m, width_m);
  return whole.map.cost < kAsGood * trial.map.cost ? whole : trial;
}

}  // namespace

FaultTrial simplified(const LabelledScans& scans, const std::vector<int>& labels,
                      FaultTrial trial) {
  if (trial.fault.fault != LabelFault::kSwapped) return trial;
  const Changes changes = changes_of(labels, trial);
  if (!changes.one_sided()) return trial;
  FaultTrial simple = trial;
  simple.fault.fault = LabelFault::kWrong;
  if (changes.second_share > changes.first_share) {
    std::swap(simple.fault.first, simple.fault.second);
    std::swap(simple.fault.first_m, simple.fault.second_m);
  }
  for (std::size_t k = 0; k < labels.size(); ++k)
    if (labels[k] != simple.fault.first) simple.labels[k] = labels[k];
  const double width_m = trial.map.width_m;
  simple = settled_trial(scans, labels, std::vector(simple.labels), simple, trial.map.positions_m,
                         width_m, width_m);
  return simple.map.cost < kAsGood * trial.map.cost ? simple : trial;
}

std::optional<FaultTrial> scattered_trial(const LabelledScans& scans,
                                          const std::vector<int>& labels, const RobustMap& map) {
  std::optional<FaultTrial> best;
  const std::vector<SharedPlaces> all = shared_places(scans, labels, map, kSettledPairs);
  for (const SharedPlaces& shared : all) {
    if (shared.gain < kLeastGain * all.front().gain) break;
    FaultTrial trial = simpler_trial(scans, labels, shared, map.width_m);
    if (!best || trial.map.cost < best->map.cost) best = std::move(trial);
  }
  return best ? std::optional(over_stretch(scans, labels, std::move(*best), map.width_m)) : best;
}

}  // namespace mapproof
