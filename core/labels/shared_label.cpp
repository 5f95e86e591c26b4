#include "core/labels/shared_label.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/base/median.hpp"
#include "core/labels/labelled_scans.hpp"
#include "core/labels/robust_map.hpp"
#include "core/labels/scan_pose.hpp"
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
constexpr std::size_t kTriedLabels = 4;
constexpr int kBlocks = 40;

/// Where a detection stands.
struct Standing {
  std::size_t row;  ///< Among the log's detections.
  Eigen::RowVector2d place_m;
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
      seen.push_back(place_seen(other));
    }
  if (seen.size() < 2 || !is_located(own)) return std::nullopt;
  const ScanPose pose(mapped, seen);
  if ((place_seen(own) - pose.seen_mean_m()).norm() > kFurthest * pose.extent_m())
    return std::nullopt;
  return pose.to_map(place_seen(own));
}

std::vector<Standing> standings(const DetectionLog& log, int label, const Points& map) {
  std::vector<Standing> result;
  for (std::size_t begin = 0, end = 0; begin < log.detections.size(); begin = end) {
    while (end < log.detections.size() && log.detections[end].step == log.detections[begin].step)
      ++end;
    const std::span scan(log.detections.data() + begin, end - begin);
    const auto own = std::ranges::find(scan, label, &Detection::landmark);
    if (own == scan.end()) continue;
    if (const auto place_m = standing(scan, *own, map))
      result.push_back({begin + static_cast<std::size_t>(own - scan.begin()), *place_m});
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
std::pair<Eigen::RowVector2d, int> densest(const std::vector<Eigen::RowVector2d>& places,
                                           double reach_m) {
  constexpr std::size_t kTried = 300;
  std::pair<Eigen::RowVector2d, int> best{Eigen::RowVector2d::Zero(), 0};
  const std::size_t stride = places.size() / kTried + 1;
  for (std::size_t k = 0; k < places.size(); k += stride) {
    Eigen::RowVector2d sum = Eigen::RowVector2d::Zero();
    int count = 0;
    for (const Eigen::RowVector2d& other : places)
      if ((other - places[k]).norm() <= reach_m) sum += other, ++count;
    if (count > best.second) best = {sum / count, count};
  }
  return best;
}

DetectionLog without(DetectionLog log, int label) {
  std::erase_if(log.detections, [&](const Detection& seen) { return seen.landmark == label; });
  return log;
}

/// The two positions of an ID, if it has two.
std::optional<SharedLabel> two_places(const DetectionLog& log, int label) {
  const Points map = pair_map_of(without(log, label)).embedding.coordinates;
  const double reach_m = kReach * neighbour_distance(map);
  const std::vector<Standing> all = standings(log, label, map);
  if (std::ssize(all) < kFewestDetections || reach_m == 0.0) return std::nullopt;
  std::vector<Eigen::RowVector2d> places;
  for (const Standing& one : all) places.push_back(one.place_m);
  const auto [first_m, first] = densest(places, reach_m);
  std::erase_if(places, [&, at = first_m](const Eigen::RowVector2d& place) {
    return (place - at).norm() < kApart * reach_m;
  });
  const auto [second_m, second] = densest(places, reach_m);
  const auto count = static_cast<double>(all.size());
  if (second < kLeastShare * count || second < kFewestDetections / 2 ||
      first + second < (1.0 - kMostStrays) * count)
    return std::nullopt;
  SharedLabel shared{.label = label, .apart_m = (first_m - second_m).norm()};
  shared.place.assign(log.detections.size(), 0);
  for (const Standing& one : all) {
    const double to_first = (one.place_m - first_m).norm();
    const double to_second = (one.place_m - second_m).norm();
    if (std::min(to_first, to_second) > 0.5 * shared.apart_m) continue;
    shared.place[one.row] = to_first <= to_second ? 1 : 2;
    ++(to_first <= to_second ? shared.first_detections : shared.second_detections);
  }
  for (std::size_t k = 0; k < log.detections.size(); ++k)
    if (log.detections[k].landmark == label && shared.place[k] == 0) ++shared.untold;
  return shared;
}

/// The pairs of a log, and the map that they are costed from.
struct MappedLabels {
  explicit MappedLabels(const DetectionLog& log) : start(pair_map_of(log).embedding.coordinates) {
    const LabelledScans scans = labelled_scans(log, kBlocks);
    items = pair_items(scans.pairs, given_labels(log), scans.blocks);
  }

  std::vector<PairItem> items;
  Points start;
};

}  // namespace

DetectionLog split_label(const DetectionLog& log, const SharedLabel& shared, int second) {
  DetectionLog split = log;
  split.detections.clear();
  for (std::size_t k = 0; k < log.detections.size(); ++k) {
    Detection seen = log.detections[k];
    if (seen.landmark == shared.label && shared.place[k] == 0) continue;
    if (shared.place[k] == 2) seen.landmark = second;
    split.detections.push_back(seen);
  }
  sort_detections(split.detections);
  return split;
}

std::optional<SharedLabel> shared_label(const DetectionLog& log) {
  std::vector<SharedLabel> candidates;
  for (int label = 0; label < std::ssize(log.names); ++label)
    if (std::optional<SharedLabel> one = two_places(log, label))
      candidates.push_back(std::move(*one));
  std::ranges::stable_sort(candidates, std::ranges::greater(), &SharedLabel::second_detections);
  candidates.resize(std::min(candidates.size(), kTriedLabels));
  // While one ID folds the map, others seem to be at two positions as well.
  std::optional<SharedLabel> best;
  std::optional<MappedLabels> whole;
  for (SharedLabel& candidate : candidates) {
    DetectionLog split = split_label(log, candidate, static_cast<int>(log.names.size()));
    split.names.push_back(log.names[static_cast<std::size_t>(candidate.label)] + " (2)");
    const MappedLabels parts(split);
    const RobustMap two = lowered_map(parts.items, parts.start, width_of(parts.items, parts.start));
    if (!whole) whole.emplace(log);
    candidate.loss_before_m = lowered_map(whole->items, whole->start, two.width_m).loss_m;
    candidate.loss_after_m = two.loss_m;
    if (std::pow(candidate.loss_after_m / candidate.loss_before_m, 2) > 1.0 - kLeastFall) continue;
    if (!best || candidate.loss_after_m < best->loss_after_m) best = std::move(candidate);
  }
  return best;
}

}  // namespace mapproof
