#include "core/association/shared_id.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/association/identified_scans.hpp"
#include "core/association/robust_map.hpp"
#include "core/association/scan_pose.hpp"
#include "core/base/median.hpp"
#include "core/pairs/pair_graph.hpp"
#include "core/pairs/pair_map.hpp"
#include "core/statistics/intervals.hpp"

namespace mapproof {
namespace {

constexpr int kFewestDetections = 20;  ///< With a determined position,
constexpr double kLeastShare = 0.06;   ///< of which the second position has at least this share.
constexpr double kMostStrays = 0.25;   ///< Share of detections at neither.
constexpr double kReach = 0.3;         ///< Of a position, of the usual distance of neighbours.
constexpr double kApart = 3.0;         ///< The positions are so many reaches apart.
constexpr double kFurthest = 4.0;      ///< A detection from the others, in their extents.
constexpr double kLeastFall = 0.25;    ///< Of the cost, to report an ID as shared.
constexpr std::size_t kTriedIds = 4;
constexpr int kBlocks = 40;

/// Where a detection stands.
struct Standing {
  std::size_t row;  ///< Among the log's detections.
  Eigen::RowVector2d position_m;
};

/// Where a scan's detection of an ID stands, as two others or more in it determine; empty if they
/// stand too close together.
std::optional<Eigen::RowVector2d> standing(std::span<const Detection> scan, const Detection& own,
                                           const Points& map) {
  std::vector<Eigen::RowVector2d> mapped;
  std::vector<Eigen::RowVector2d> seen;
  for (const Detection& other : scan)
    if (other.landmark != own.landmark && is_located(other) &&
        map.row(other.landmark).allFinite()) {
      mapped.push_back(map.row(other.landmark));
      seen.push_back(position_observed(other));
    }
  if (seen.size() < 2 || !is_located(own)) return std::nullopt;
  const ScanPose pose(mapped, seen);
  if ((position_observed(own) - pose.seen_mean_m()).norm() > kFurthest * pose.extent_m())
    return std::nullopt;
  return pose.to_map(position_observed(own));
}

std::vector<Standing> standings(const DetectionLog& log, int id, const Points& map) {
  std::vector<Standing> result;
  for (std::size_t begin = 0, end = 0; begin < log.detections.size(); begin = end) {
    while (end < log.detections.size() && log.detections[end].step == log.detections[begin].step)
      ++end;
    const std::span scan(log.detections.data() + begin, end - begin);
    const auto own = std::ranges::find(scan, id, &Detection::landmark);
    if (own == scan.end()) continue;
    if (const auto position_m = standing(scan, *own, map))
      result.push_back({begin + static_cast<std::size_t>(own - scan.begin()), *position_m});
  }
  return result;
}

/// The usual distance of a landmark from its nearest neighbour.
double neighbour_distance(const Points& map) {
  std::vector<double> nearest;
  for (Eigen::Index i = 0; i < map.rows(); ++i) {
    double least = HUGE_VAL;
    for (Eigen::Index j = 0; j < map.rows(); ++j)
      if (i != j && map.row(i).allFinite() && map.row(j).allFinite())
        least = std::min(least, (map.row(i) - map.row(j)).norm());
    if (std::isfinite(least)) nearest.push_back(least);
  }
  return nearest.empty() ? 0.0 : median(nearest);
}

/// The middle of the densest disk among some positions, and how many it holds.
std::pair<Eigen::RowVector2d, int> densest(const std::vector<Eigen::RowVector2d>& positions,
                                           double reach_m) {
  constexpr std::size_t kTried = 300;
  std::pair<Eigen::RowVector2d, int> best{Eigen::RowVector2d::Zero(), 0};
  const std::size_t stride = positions.size() / kTried + 1;
  for (std::size_t k = 0; k < positions.size(); k += stride) {
    Eigen::RowVector2d sum = Eigen::RowVector2d::Zero();
    int count = 0;
    for (const Eigen::RowVector2d& other : positions)
      if ((other - positions[k]).norm() <= reach_m) sum += other, ++count;
    if (count > best.second) best = {sum / count, count};
  }
  return best;
}

DetectionLog without(DetectionLog log, int id) {
  std::erase_if(log.detections, [&](const Detection& seen) { return seen.landmark == id; });
  return log;
}

/// The two positions of an ID, if it has two.
std::optional<SharedId> two_positions(const DetectionLog& log, int id) {
  const Points map = pair_map_of(without(log, id)).embedding.coordinates;
  const double reach_m = kReach * neighbour_distance(map);
  const std::vector<Standing> all = standings(log, id, map);
  if (std::ssize(all) < kFewestDetections || reach_m == 0.0) return std::nullopt;
  std::vector<Eigen::RowVector2d> positions;
  for (const Standing& one : all) positions.push_back(one.position_m);
  const auto [first_m, first] = densest(positions, reach_m);
  std::erase_if(positions, [&, at = first_m](const Eigen::RowVector2d& position) {
    return (position - at).norm() < kApart * reach_m;
  });
  const auto [second_m, second] = densest(positions, reach_m);
  const auto count = static_cast<double>(all.size());
  if (second < kLeastShare * count || second < kFewestDetections / 2 ||
      first + second < (1.0 - kMostStrays) * count)
    return std::nullopt;
  SharedId shared{.id = id, .apart_m = (first_m - second_m).norm()};
  shared.position.assign(log.detections.size(), 0);
  for (const Standing& one : all) {
    const double to_first = (one.position_m - first_m).norm();
    const double to_second = (one.position_m - second_m).norm();
    if (std::min(to_first, to_second) > 0.5 * shared.apart_m) continue;
    shared.position[one.row] = to_first <= to_second ? 1 : 2;
    ++(to_first <= to_second ? shared.first_detections : shared.second_detections);
  }
  for (std::size_t k = 0; k < log.detections.size(); ++k)
    if (log.detections[k].landmark == id && shared.position[k] == 0) ++shared.undetermined;
  return shared;
}

/// The pairs of a log, and the map that they are costed from.
struct MappedIds {
  explicit MappedIds(const DetectionLog& log) : start(pair_map_of(log).embedding.coordinates) {
    const IdentifiedScans scans = identified_scans(log, kBlocks);
    items = pair_items(scans.pairs, given_ids(log), scans.blocks);
  }

  std::vector<PairItem> items;
  Points start;
};

}  // namespace

DetectionLog split_id(const DetectionLog& log, const SharedId& shared, int second) {
  DetectionLog split = log;
  split.detections.clear();
  for (std::size_t k = 0; k < log.detections.size(); ++k) {
    Detection seen = log.detections[k];
    if (seen.landmark == shared.id && shared.position[k] == 0) continue;
    if (shared.position[k] == 2) seen.landmark = second;
    split.detections.push_back(seen);
  }
  sort_detections(split.detections);
  return split;
}

std::optional<SharedId> shared_id(const DetectionLog& log) {
  std::vector<SharedId> candidates;
  for (int id = 0; id < std::ssize(log.names); ++id)
    if (std::optional<SharedId> one = two_positions(log, id)) candidates.push_back(std::move(*one));
  std::ranges::stable_sort(candidates, std::ranges::greater(), &SharedId::second_detections);
  candidates.resize(std::min(candidates.size(), kTriedIds));
  // While one ID folds the map, others seem to be at two positions as well.
  std::optional<SharedId> best;
  std::optional<MappedIds> whole;
  for (SharedId& candidate : candidates) {
    DetectionLog split = split_id(log, candidate, static_cast<int>(log.names.size()));
    split.names.push_back(log.names[static_cast<std::size_t>(candidate.id)] + " (2)");
    const MappedIds parts(split);
    const RobustMap two =
        minimized_map(parts.items, parts.start, width_of(parts.items, parts.start));
    if (!whole) whole.emplace(log);
    candidate.loss_before_m = minimized_map(whole->items, whole->start, two.width_m).loss_m;
    candidate.loss_after_m = two.loss_m;
    if (std::pow(candidate.loss_after_m / candidate.loss_before_m, 2) > 1.0 - kLeastFall) continue;
    if (!best || candidate.loss_after_m < best->loss_after_m) best = std::move(candidate);
  }
  return best;
}

}  // namespace mapproof
