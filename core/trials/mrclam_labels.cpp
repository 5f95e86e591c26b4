#include "core/trials/mrclam_labels.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "core/base/random.hpp"
#include "core/labels/anchor_labels.hpp"
#include "core/labels/mislabelled.hpp"
#include "core/labels/shared_label.hpp"

namespace mapproof {
namespace {

/// Landmarks, those of most detections first.
std::vector<int> by_detections(const DetectionLog& log) {
  std::vector<int> count(log.names.size(), 0);
  for (const Detection& seen : log.detections) ++count[static_cast<std::size_t>(seen.landmark)];
  std::vector<int> order(log.names.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater(),
                           [&](int k) { return count[static_cast<std::size_t>(k)]; });
  return order;
}

DetectionLog swapped_in_half(DetectionLog log, int a, int b, std::uint64_t seed) {
  Random random(seed);
  std::vector<bool> is_wrong;
  for (int scan = 0; scan < log.steps; ++scan) is_wrong.push_back(random.uniform() < 0.5);
  for (Detection& seen : log.detections)
    if (is_wrong[static_cast<std::size_t>(seen.step)] && (seen.landmark == a || seen.landmark == b))
      seen.landmark = seen.landmark == a ? b : a;
  sort_detections(log.detections);
  return log;
}

/// @param log  Where both are in a scan, the misnamed detection is left out: a label is there once.
DetectionLog misnamed(DetectionLog log, int a, int b) {
  std::set<int> of_b;
  for (const Detection& seen : log.detections)
    if (seen.landmark == b) of_b.insert(seen.step);
  std::erase_if(log.detections, [&](const Detection& seen) {
    return seen.landmark == a && of_b.contains(seen.step);
  });
  for (Detection& seen : log.detections)
    if (seen.landmark == a) seen.landmark = b;
  sort_detections(log.detections);
  return log;
}

}  // namespace

std::vector<SpoiltLabels> spoilt_labels(const DetectionLog& log, std::uint64_t seed) {
  const std::vector<int> order = by_detections(log);
  if (order.size() < 6) return {};
  return {{"swapped", swapped_in_half(log, order[1], order[4], seed)},
          {"misnamed", misnamed(log, order[5], order[2])}};
}

CorrectedLabels corrected_log(const DetectionLog& log, const std::optional<Points>& known_m) {
  CorrectedLabels corrected{.faults = 0, .log = log};
  const std::vector<Eigen::Index> unseen = unseen_in(log);
  if (unseen.size() == 1)
    if (const auto shared = shared_label(log)) {
      ++corrected.faults;
      corrected.log = split_label(log, *shared, static_cast<int>(unseen.front()));
    }
  LabelCheck check = check_labels(corrected.log);
  corrected.faults += static_cast<int>(check.findings.size());
  corrected.log = std::move(check.repaired);
  if (!known_m) return corrected;
  AnchorCheck places = check_anchor_labels(corrected.log, *known_m);
  corrected.faults += static_cast<int>(places.exchanges.size());
  corrected.log = std::move(places.repaired);
  return corrected;
}

}  // namespace mapproof
