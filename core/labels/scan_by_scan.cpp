#include "core/labels/scan_by_scan.hpp"

#include "core/base/not_finite.hpp"
#include "core/labels/place_costs.hpp"
#include "core/labels/scan_costs.hpp"

namespace mapproof {
namespace {

constexpr int kMostRounds = 12;
constexpr double kPrice = 2.0;       ///< Of another landmark ID, variances.
constexpr double kScanWidths = 1.5;  ///< Standard deviations in a width.

RobustMap freshly_mapped(const std::vector<PairItem>& items, int landmarks, double width_m) {
  return lowered_map(items, robust_map(items, landmarks).positions_m, width_m);
}

}  // namespace

std::vector<int> labels_scan_by_scan(const ScanLabels& of, const LabelHypothesis& fault,
                                     const Points& map, double width_m) {
  const auto& [scans, given, labels] = of;
  const double price = kPrice * width_m * width_m / (kScanWidths * kScanWidths);
  const bool both = fault.fault == LabelFault::kSwapped;
  // The ID that a detection gets if it does not keep its present one.
  const auto otherwise = [&](std::size_t row) {
    const int label = of.labels[row];
    if (!both && of.given[row] != fault.first) return label;
    return label == fault.first ? fault.second : label == fault.second ? fault.first : label;
  };
  std::vector<int> result = labels;
  ScanCosts costs(scans, map, width_m);
  for (std::size_t row = 0, end = 0; row < labels.size(); row = end) {
    end = costs.take(labels, row, fault.first, fault.second);
    if (!costs.tells()) continue;
    bool taken = false;
    double gain = 0.0;
    for (std::size_t k = row; k < end; ++k) {
      taken = taken || given[k] == fault.second;
      if (otherwise(k) != labels[k]) gain += costs(k, labels[k]) - costs(k, otherwise(k));
    }
    if (gain <= price || (taken && !both)) continue;
    for (std::size_t k = row; k < end; ++k) result[k] = otherwise(k);
  }
  return result;
}

FaultTrial settled_trial(const ScanLabels& of, FaultTrial trial, const Points& start, double told_m,
                         double width_m) {
  const LabelledScans& scans = of.scans;
  trial.map.positions_m = turned_as_seen(scans, of.labels, start);
  trial.labels = of.labels;
  FaultTrial best;
  best.map.cost = kInfinity;
  bool unfolded = false;
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<int> next = labels_scan_by_scan(of, trial.fault, trial.map.positions_m, told_m);
    const bool settled = round > 0 && next == trial.labels;
    if (settled && unfolded) break;
    trial.labels = std::move(next);
    const std::vector<PairItem> items = pair_items(scans.pairs, trial.labels, scans.blocks);
    trial.map = lowered_map(items, trial.map.positions_m, width_m);
    if (!settled) {
      if (trial.map.cost < best.map.cost) best = trial;
      continue;
    }
    // Wrong IDs may have folded the map of the others.
    unfolded = true;
    RobustMap anew = freshly_mapped(items, static_cast<int>(start.rows()), width_m);
    if (anew.cost < trial.map.cost) trial.map = std::move(anew);
    trial.map = unfolded_map(items, std::move(trial.map), scans.blocks.count);
    trial.map.positions_m = turned_as_seen(scans, trial.labels, trial.map.positions_m);
    if (trial.map.cost < best.map.cost) best = trial;
  }
  return best;
}

}  // namespace mapproof
