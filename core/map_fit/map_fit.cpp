#include "core/map_fit/map_fit.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/association/anchor_ids.hpp"
#include "core/association/log_blocks.hpp"
#include "core/association/move_contrast.hpp"
#include "core/association/robust_map.hpp"
#include "core/base/not_finite.hpp"
#include "core/map_fit/fit_maker.hpp"

namespace mapproof {
namespace {

void test_scatter(FitMaker& maker, const ScatterFit& scatter) {
  maker.number("fit_scatter_m", scatter.sigma_m);
  maker.number("fit_outliers_percent", 100.0 * scatter.gross);
  maker.test({.code = FitCode::kOutliers,
              .landmarks = maker.names(scatter.worst),
              .values = {{"share_percent", 100.0 * scatter.gross}},
              .statistic = scatter.gross,
              .bound = kMostGross});
  maker.test({.code = FitCode::kScatter,
              .values = {{"share_percent", 100.0 * scatter.relative}, {"ratio", scatter.tail}},
              .statistic = std::min(scatter.relative / kMostRelative, scatter.tail / kMostTail),
              .bound = 1.0,
              .is_small = scatter.pairs < kFewestForIds});
}

/// The robot that is most at odds with the others.
template <typename Odds>
const RobotFit* most_at_odds(const std::vector<RobotFit>& robots, const Odds& odds) {
  const auto most = std::ranges::max_element(robots, {}, odds);
  return most == robots.end() ? nullptr : &*most;
}

void test_robots(FitMaker& maker, const std::vector<RobotFit>& robots) {
  constexpr int kFewestTriples = 20;
  const auto length = [](const RobotFit& robot) { return std::abs(std::log(robot.ratio)); };
  const auto turned = [](const RobotFit& robot) {
    return robot.triples >= kFewestTriples ? robot.mirrored : 0.0;
  };
  if (const RobotFit* robot = most_at_odds(robots, length); robot != nullptr && robots.size() > 1)
    maker.test({.code = FitCode::kRobotRanges,
                .values = {{"robot", robot->robot + 1.0}, {"ratio", robot->ratio}},
                .statistic = length(*robot),
                .bound = kMostRatio});
  if (const RobotFit* robot = most_at_odds(robots, turned))
    maker.test(
        {.code = FitCode::kRobotBearings,
         .values = {{"robot", robot->robot + 1.0}, {"share_percent", 100.0 * robot->mirrored}},
         .statistic = turned(*robot),
         .bound = kMostMirrored});
}

/// Groups of landmarks that hang together weakly.
void test_parts(FitMaker& maker, const PairFit& found) {
  std::vector<int> single;
  int groups = 0;
  for (std::size_t p = 0; p < found.parts.size(); ++p) {
    const RigidPart& part = found.parts[p];
    if (p > 0 && part.landmarks.size() < 3)
      single.insert(single.end(), part.landmarks.begin(), part.landmarks.end());
    else
      ++groups;
  }
  for (std::size_t p = 0; p < found.parts.size() && groups > 1; ++p) {
    const RigidPart& part = found.parts[p];
    if (part.landmarks.size() < 3) continue;
    maker.part(part.landmarks);
    if (p == 0) continue;
    maker.test({.code = part.pairs > 0 ? FitCode::kWeakBridge : FitCode::kDisconnected,
                .landmarks = maker.names(part.landmarks),
                .values = {{"pairs", static_cast<double>(part.pairs)},
                           {"count", static_cast<double>(part.scans)}},
                .statistic = static_cast<double>(groups),
                .bound = 1.0});
  }
  if (!single.empty()) {
    std::ranges::sort(single);
    maker.test({.code = FitCode::kWeakBridge,
                .landmarks = maker.names(single),
                .statistic = 1.0 + static_cast<double>(single.size()),
                .bound = 1.0,
                .is_small = true});
  }
  if (groups > 1) return;
  const WeakMode& weakest = found.weakest;
  const double relative = std::min(1e3, weakest.sigma_m / std::max(1e-12, found.scatter.median_m));
  const bool is_open = relative > kOpen;
  if (is_open && single.empty()) maker.part(weakest.landmarks);
  maker.test({.code = FitCode::kWeakBridge,
              .landmarks = maker.names(weakest.landmarks),
              .values = {{"distance_m", weakest.sigma_m}},
              .statistic = relative,
              .bound = is_open ? kOpen : kWeak,
              .is_small = !is_open || !single.empty()});
}

void test_ids(FitMaker& maker, const AssociationCheck& check, bool is_small) {
  for (const AssociationFinding& finding : check.findings) {
    if (!(finding.loss_before_m > 0.0)) continue;
    const bool is_swap = finding.fault == AssociationFault::kSwapped;
    FitCause cause{.code = is_swap ? FitCode::kIdsExchanged : FitCode::kWrongIds,
                   .landmarks = maker.names({finding.first, finding.second}),
                   .values = {{"count", static_cast<double>(finding.detections)}},
                   .statistic = 1.0 - finding.loss_after_m / finding.loss_before_m,
                   .bound = kLeastLossFall,
                   .is_small = is_small};
    if (std::isfinite(finding.first_time_s) && !finding.scattered) {
      cause.values.push_back({"from_s", finding.first_time_s});
      cause.values.push_back({"to_s", finding.last_time_s});
    }
    maker.test(std::move(cause));
  }
  if (check.findings.empty())
    maker.test({.code = FitCode::kWrongIds, .statistic = 0.0, .bound = kLeastLossFall});
}

/// The first time of a slice; NaN for a log without times.
double beginning_of(const DetectionLog& log, const LogBlocks& blocks, int slice) {
  double first = kNaN;
  for (std::size_t step = 0; step < log.times_s.size(); ++step)
    if (blocks.slice[static_cast<std::size_t>(blocks.of_step[step])] == slice)
      first = std::isnan(first) ? log.times_s[step] : std::min(first, log.times_s[step]);
  return first;
}

/// The landmark that stands out most as one that moved. IDs that are exchanged look like moves.
void test_moved(FitMaker& maker, const DetectionLog& log, const Points& map) {
  constexpr int kSlices = 30;
  const std::vector<ScanPair> pairs = scan_pairs(log);
  const LogBlocks blocks = cut_in_blocks(log, pairs, kSlices);
  const std::vector<PairItem> items = pair_items(pairs, given_ids(log), blocks);
  const std::vector<MoveContrast> all =
      move_contrasts(items, {.positions_m = map, .width_m = width_of(items, map)}, blocks);
  FitCause cause{.code = FitCode::kLandmarkMoved, .bound = 1.0};
  for (const MoveContrast& one : all) {
    const double ratio = contrast_ratio(all, one.landmark);
    if (ratio <= cause.statistic) continue;
    cause.statistic = ratio;
    cause.is_small = one.clusters < kManyClusters;
    if (ratio <= cause.bound) continue;
    cause.landmarks = maker.names({one.landmark});
    cause.values = {{"distance_m", one.shift_m}};
    if (const double from_s = beginning_of(log, blocks, one.slice); std::isfinite(from_s))
      cause.values.push_back({"from_s", from_s});
  }
  maker.test(std::move(cause), !maker.has_cause(FitCode::kIdsExchanged, FitCode::kWrongIds));
}

/// The positions of the largest part alone: how the others lie to it may be open.
Points largest_part(const PairFit& found, const Points& positions_m) {
  if (found.parts.empty()) return positions_m;
  Points part_m = Points::Constant(positions_m.rows(), 2, kNaN);
  for (const int k : found.parts.front().landmarks) part_m.row(k) = positions_m.row(k);
  return part_m;
}

/// The cause of a misfit to known positions.
FitCause cause_of_misfit(const FitMaker& maker, const KnownFit& known, double bound_m) {
  FitCause cause{.code = FitCode::kKnownLandmarksAtOdds,
                 .values = {{"distance_m", known.misfit_m}},
                 .statistic = known.misfit_m / bound_m * kMostMisfits,
                 .bound = kMostMisfits};
  if (known.mirrored_m < bound_m && known.mirrored_m < 0.5 * known.misfit_m) {
    cause.code = FitCode::kKnownMirrored;
  } else if (known.without_worst_m < bound_m && known.worst >= 0 && known.positions >= 5 &&
             known.second_without_m > 1.5 * known.without_worst_m) {
    cause.code = FitCode::kKnownLandmarkOff;
    cause.landmarks = maker.names({known.worst});
    cause.values = {{"distance_m", known.worst_miss_m}};
  } else if (std::abs(std::log(known.scale)) > kMostScale &&
             known.scaled_m < 0.5 * known.misfit_m) {
    cause.code = FitCode::kKnownScale;
    cause.values.push_back({"ratio", known.scale});
  }
  return cause;
}

void test_known(FitMaker& maker, const DetectionLog& log, const Points& map, const PairFit& found,
                const Points& known_m) {
  const Points part_m = largest_part(found, known_m);
  const KnownFit known = known_fit(map, part_m);
  if (known.positions < 3) return;
  const double open_m = std::isfinite(found.weakest.sigma_m) ? found.weakest.sigma_m : 0.0;
  const double bound_m = kMostMisfits * std::hypot(found.scatter.sigma_m, open_m);
  maker.number("fit_known_misfit_m", known.misfit_m);
  std::vector<AnchorExchange> exchanges;
  if (known.misfit_m > bound_m) exchanges = check_anchor_ids(log, part_m).exchanges;
  for (const AnchorExchange& one : exchanges)
    maker.test({.code = FitCode::kKnownLandmarksExchanged,
                .landmarks = maker.names({one.first, one.second}),
                .values = {{"distance_m", one.misfit_before_m}},
                .statistic = one.misfit_before_m / std::max(1e-9, one.misfit_after_m),
                .bound = 1.0});
  maker.test(cause_of_misfit(maker, known, bound_m), exchanges.empty());
}

}  // namespace

Fit range_bearing_fit(const DetectionLog& log, const Points& map, const MapEvidence& evidence) {
  const PairFit found = pair_fit(log, map);
  if (found.landmarks < 3) return {.verdict = FitVerdict::kNotTestable, .why = {FitMissing::kMap}};
  if (found.redundancy < 1 || found.scatter.pairs < kFewestPairs)
    return {.verdict = FitVerdict::kNotTestable, .why = {FitMissing::kRedundancy}};
  FitMaker maker(log.names);
  test_scatter(maker, found.scatter);
  test_robots(maker, found.robots);
  test_parts(maker, found);
  if (evidence.association != nullptr)
    test_ids(maker, *evidence.association, found.scatter.pairs < kFewestForIds);
  test_moved(maker, log, map);
  if (evidence.known_m != nullptr) test_known(maker, log, map, found, *evidence.known_m);
  return std::move(maker).finished();
}

}  // namespace mapproof
