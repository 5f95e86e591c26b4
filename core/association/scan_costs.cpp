#include "core/association/scan_costs.hpp"

#include <cmath>

#include "core/association/position_costs.hpp"
#include "core/base/not_finite.hpp"
#include "core/pairs/pair_graph.hpp"

namespace mapproof {

namespace {

constexpr int kMostRounds = 12;
constexpr double kPrice = 2.0;       ///< Of another landmark ID, variances.
constexpr double kScanWidths = 1.5;  ///< Standard deviations in a width.

RobustMap freshly_mapped(const std::vector<PairItem>& items, int landmarks, double width_m) {
  return minimized_map(items, robust_map(items, landmarks).positions_m, width_m);
}

/// Others that stand closer together determine the robot's heading, and so a bearing, too badly: of
/// the distance of the detection from their mean.
constexpr double kLeastExtent = 0.15;

}  // namespace

std::vector<int> ids_scan_by_scan(const ScanIds& of, const AssociationHypothesis& fault,
                                  const Points& map, double width_m) {
  const auto& [scans, given, ids] = of;
  const double price = kPrice * width_m * width_m / (kScanWidths * kScanWidths);
  const bool both = fault.fault == AssociationFault::kSwapped;
  // The ID that a detection gets if it does not keep its present one.
  const auto otherwise = [&](std::size_t row) {
    const int id = of.ids[row];
    if (!both && of.given[row] != fault.first) return id;
    return id == fault.first ? fault.second : id == fault.second ? fault.first : id;
  };
  std::vector<int> result = ids;
  ScanCosts costs(scans, map, width_m);
  for (std::size_t row = 0, end = 0; row < ids.size(); row = end) {
    end = costs.take(ids, row, fault.first, fault.second);
    if (!costs.determines()) continue;
    bool taken = false;
    double gain = 0.0;
    for (std::size_t k = row; k < end; ++k) {
      taken = taken || given[k] == fault.second;
      if (otherwise(k) != ids[k]) gain += costs(k, ids[k]) - costs(k, otherwise(k));
    }
    if (gain <= price || (taken && !both)) continue;
    for (std::size_t k = row; k < end; ++k) result[k] = otherwise(k);
  }
  return result;
}

HypothesisFit converged_fit(const ScanIds& of, HypothesisFit fit, const Points& start,
                            double predicted_m, double width_m) {
  const IdentifiedScans& scans = of.scans;
  fit.map.positions_m = oriented_as_seen(scans, of.ids, start);
  fit.ids = of.ids;
  HypothesisFit best;
  best.map.cost = kInfinity;
  bool unfolded = false;
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<int> next = ids_scan_by_scan(of, fit.fault, fit.map.positions_m, predicted_m);
    const bool converged = round > 0 && next == fit.ids;
    if (converged && unfolded) break;
    fit.ids = std::move(next);
    const std::vector<PairItem> items = pair_items(scans.pairs, fit.ids, scans.blocks);
    fit.map = minimized_map(items, fit.map.positions_m, width_m);
    if (!converged) {
      if (fit.map.cost < best.map.cost) best = fit;
      continue;
    }
    // Wrong IDs may have folded the map of the others.
    unfolded = true;
    RobustMap resampled = freshly_mapped(items, static_cast<int>(start.rows()), width_m);
    if (resampled.cost < fit.map.cost) fit.map = std::move(resampled);
    fit.map = unfolded_map(items, std::move(fit.map), scans.blocks.count);
    fit.map.positions_m = oriented_as_seen(scans, fit.ids, fit.map.positions_m);
    if (fit.map.cost < best.map.cost) best = fit;
  }
  return best;
}

Points oriented_as_seen(const IdentifiedScans& scans, const std::vector<int>& ids, Points map) {
  const std::vector<Detection>& rows = scans.log.detections;
  double agreement = 0.0;
  for (std::size_t k = 2; k < rows.size(); ++k) {
    if (rows[k - 2].step != rows[k].step) continue;
    if (!is_located(rows[k]) || !is_located(rows[k - 1]) || !is_located(rows[k - 2])) continue;
    const Eigen::RowVector2d seen = position_observed(rows[k - 2]);
    const Eigen::RowVector2d mapped = map.row(ids[k - 2]);
    const double turn =
        cross(position_observed(rows[k - 1]) - seen, position_observed(rows[k]) - seen) *
        cross(map.row(ids[k - 1]) - mapped, map.row(ids[k]) - mapped);
    if (std::isfinite(turn)) agreement += std::copysign(std::sqrt(std::abs(turn)), turn);
  }
  if (agreement < 0.0) map.col(0) *= -1.0;
  return map;
}

ScanCosts::ScanCosts(const IdentifiedScans& scans, const Points& map, double width_m)
    : scans_(scans), map_(map), width_m_(width_m) {}

std::size_t ScanCosts::take(const std::vector<int>& ids, std::size_t row, int first, int second) {
  const std::vector<Detection>& rows = scans_.log.detections;
  others_.clear();
  std::size_t end = row;
  for (; end < rows.size() && rows[end].step == rows[row].step; ++end)
    if (ids[end] != first && ids[end] != second && is_located(rows[end]) &&
        map_.row(ids[end]).allFinite())
      others_.emplace_back(end, ids[end]);
  if (has_pose()) set_pose();
  return end;
}

void ScanCosts::set_pose() {
  std::vector<Eigen::RowVector2d> mapped;
  std::vector<Eigen::RowVector2d> seen;
  for (const auto& [row, id] : others_) {
    mapped.push_back(map_.row(id));
    seen.push_back(position_observed(scans_.log.detections[row]));
  }
  pose_ = ScanPose(mapped, seen);
}

double ScanCosts::operator()(std::size_t row, int landmark) const {
  const Detection& detection = scans_.log.detections[row];
  if (others_.empty() || !is_located(detection) || !map_.row(landmark).allFinite()) return 0.0;
  const Eigen::RowVector2d seen = position_observed(detection);
  if (has_pose() && pose_.extent_m() >= kLeastExtent * (seen - pose_.seen_mean_m()).norm()) {
    const Eigen::RowVector2d expected = pose_.to_robot(map_.row(landmark));
    const Eigen::RowVector2d ahead(std::cos(detection.bearing_rad),
                                   std::sin(detection.bearing_rad));
    return huber_cost((seen - expected).dot(ahead), width_m_) +
           huber_cost(cross(ahead, seen - expected), width_m_);
  }
  double sum = 0.0;
  for (const auto& [other, id] : others_) {
    const double measured = (seen - position_observed(scans_.log.detections[other])).norm();
    sum += huber_cost(measured - (map_.row(landmark) - map_.row(id)).norm(), width_m_);
  }
  return sum / static_cast<double>(others_.size());
}

}  // namespace mapproof
