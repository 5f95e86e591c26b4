#include "core/association/identified_scans.hpp"

#include <algorithm>
#include <tuple>

#include "core/base/errors.hpp"

namespace mapproof {

IdentifiedScans identified_scans(const DetectionLog& log, int most_blocks) {
  if (most_blocks < 1) throw InvalidInput("a log needs one block or more");
  IdentifiedScans scans{log, scan_pairs(log), {}, {}};
  scans.blocks = cut_in_blocks(log, scans.pairs, 24);
  const int robots = std::max(1, scans.blocks.count / 24);
  scans.blocks = cut_in_blocks(log, scans.pairs, std::max(1, most_blocks / (robots + 1)));
  for (const std::vector<int>& order : scans.blocks.step_orders) {
    std::vector<std::size_t> positions(order.size());
    for (std::size_t k = 0; k < order.size(); ++k)
      positions[static_cast<std::size_t>(order[k])] = k;
    scans.positions.push_back(std::move(positions));
  }
  return scans;
}

StepStretch greatest_sum(std::size_t order, const Eigen::VectorXd& gains) {
  StepStretch best{order, 0, 0};
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

int other_id(const AssociationHypothesis& one, int id) {
  if (id == one.first) return one.second;
  return one.fault == AssociationFault::kSwapped && id == one.second ? one.first : id;
}

std::vector<int> corrected_ids(const IdentifiedScans& scans, std::vector<int> ids,
                               const AssociationHypothesis& one, const StepStretch& stretch) {
  const std::vector<std::size_t>& positions = scans.positions[stretch.order];
  const std::vector<Detection>& detections = scans.log.detections;
  for (std::size_t row = 0, end = 0; row < detections.size(); row = end) {
    bool taken = false;  // a landmark is seen at most once in a scan
    for (end = row; end < detections.size() && detections[end].step == detections[row].step; ++end)
      taken = taken || ids[end] == one.second;
    const std::size_t position = positions[static_cast<std::size_t>(detections[row].step)];
    if (position < stretch.begin || position >= stretch.end) continue;
    if (taken && one.fault == AssociationFault::kWrong) continue;
    for (std::size_t k = row; k < end; ++k) ids[k] = other_id(one, ids[k]);
  }
  return ids;
}

DetectionLog reassigned(const DetectionLog& log, const std::vector<int>& ids,
                        const std::vector<char>& left_out) {
  DetectionLog result = log;
  result.detections.clear();
  for (std::size_t k = 0; k < ids.size(); ++k) {
    if (!left_out.empty() && left_out[k] != 0) continue;
    result.detections.push_back(log.detections[k]);
    result.detections.back().landmark = ids[k];
  }
  const auto key = [](const Detection& one) { return std::tuple(one.step, one.landmark); };
  std::ranges::stable_sort(result.detections, {}, key);
  const auto repeated = std::ranges::unique(result.detections, {}, key);
  result.detections.erase(repeated.begin(), repeated.end());
  return result;
}

}  // namespace mapproof
