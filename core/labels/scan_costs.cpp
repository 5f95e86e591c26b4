#include "core/labels/scan_costs.hpp"

#include <cmath>

#include "core/pairs/pair_graph.hpp"

namespace mapproof {
namespace {

/// Others that stand closer together determine the robot's heading, and so a bearing, too badly: of
/// the distance of the detection from their mean.
constexpr double kLeastExtent = 0.15;

}  // namespace

Points turned_as_seen(const LabelledScans& scans, const std::vector<int>& labels, Points map) {
  const std::vector<Detection>& rows = scans.log.detections;
  double agreement = 0.0;
  for (std::size_t k = 2; k < rows.size(); ++k) {
    if (rows[k - 2].step != rows[k].step) continue;
    if (!is_located(rows[k]) || !is_located(rows[k - 1]) || !is_located(rows[k - 2])) continue;
    const Eigen::RowVector2d seen = place_seen(rows[k - 2]);
    const Eigen::RowVector2d mapped = map.row(labels[k - 2]);
    const double turn = cross(place_seen(rows[k - 1]) - seen, place_seen(rows[k]) - seen) *
                        cross(map.row(labels[k - 1]) - mapped, map.row(labels[k]) - mapped);
    if (std::isfinite(turn)) agreement += std::copysign(std::sqrt(std::abs(turn)), turn);
  }
  if (agreement < 0.0) map.col(0) *= -1.0;
  return map;
}

ScanCosts::ScanCosts(const LabelledScans& scans, const Points& map, double width_m)
    : scans_(scans), map_(map), width_m_(width_m) {}

std::size_t ScanCosts::take(const std::vector<int>& labels, std::size_t row, int first,
                            int second) {
  const std::vector<Detection>& rows = scans_.log.detections;
  others_.clear();
  std::size_t end = row;
  for (; end < rows.size() && rows[end].step == rows[row].step; ++end)
    if (labels[end] != first && labels[end] != second && is_located(rows[end]) &&
        map_.row(labels[end]).allFinite())
      others_.emplace_back(end, labels[end]);
  if (has_pose()) set_pose();
  return end;
}

void ScanCosts::set_pose() {
  std::vector<Eigen::RowVector2d> mapped;
  std::vector<Eigen::RowVector2d> seen;
  for (const auto& [row, label] : others_) {
    mapped.push_back(map_.row(label));
    seen.push_back(place_seen(scans_.log.detections[row]));
  }
  pose_ = ScanPose(mapped, seen);
}

double ScanCosts::operator()(std::size_t row, int landmark) const {
  const Detection& detection = scans_.log.detections[row];
  if (others_.empty() || !is_located(detection) || !map_.row(landmark).allFinite()) return 0.0;
  const Eigen::RowVector2d seen = place_seen(detection);
  if (has_pose() && pose_.extent_m() >= kLeastExtent * (seen - pose_.seen_mean_m()).norm()) {
    const Eigen::RowVector2d expected = pose_.to_robot(map_.row(landmark));
    const Eigen::RowVector2d ahead(std::cos(detection.bearing_rad),
                                   std::sin(detection.bearing_rad));
    return huber_cost((seen - expected).dot(ahead), width_m_) +
           huber_cost(cross(ahead, seen - expected), width_m_);
  }
  double sum = 0.0;
  for (const auto& [other, label] : others_) {
    const double measured = (seen - place_seen(scans_.log.detections[other])).norm();
    sum += huber_cost(measured - (map_.row(landmark) - map_.row(label)).norm(), width_m_);
  }
  return sum / static_cast<double>(others_.size());
}

}  // namespace mapproof
