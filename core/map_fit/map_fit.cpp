#include "core/map_fit/map_fit.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/align/affine.hpp"
#include "core/association/anchor_ids.hpp"
#include "core/association/log_blocks.hpp"
#include "core/association/move_contrast.hpp"
#include "core/association/robust_map.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/graph/components.hpp"
#include "core/linalg/planarity.hpp"
#include "core/model/fit.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {
namespace {

/// Gathers the tests of a fit, and the causes among them.
class FitMaker {
 public:
  /// @param names  Of the landmarks; must outlive the object.
  explicit FitMaker(const std::vector<std::string>& names) : names_(names) {}

  std::vector<std::string> names(const std::vector<int>& landmarks) const;

  /// A test, and a cause if it exceeds its bound.
  /// @param may_be_cause  False: another test names the cause.
  void test(FitCause cause, bool may_be_cause = true);

  /// Whether one of those codes is a cause already.
  bool has_cause(FitCode one, FitCode other) const;

  void number(const char* quantity, double value) { fit_.numbers.push_back({quantity, value}); }

  /// A group of landmarks whose position relative to the others is open.
  void part(const std::vector<int>& landmarks) { fit_.parts.push_back(names(landmarks)); }

  /// The gravest causes first, and the verdict: kDoesNotFit by a cause that is not small,
  /// kUndetermined by a connection that is not, kDoubtful by others, kFits without a cause.
  Fit finished() &&;

 private:
  const std::vector<std::string>& names_;
  Fit fit_;
};

bool is_open(const FitCause& cause) {
  return cause.code == FitCode::kWeakBridge || cause.code == FitCode::kDisconnected;
}

/// 2 for a cause that has a name, 1 for a symptom of the data, 0 for known positions that are
/// missed for a reason that is not known.
double naming(const FitCause& cause) {
  if (cause.code == FitCode::kKnownLandmarksAtOdds) return 0.0;
  return cause.code == FitCode::kOutliers || cause.code == FitCode::kScatter ? 1.0 : 2.0;
}

/// Contradictions before connections that are open, named causes before symptoms, small causes
/// last.
double gravity(const FitCause& cause) {
  const double most = 1e5;
  return (cause.is_small ? 0.0 : 16.0 * most) + (is_open(cause) ? 0.0 : 8.0 * most) +
         2.0 * most * naming(cause) + std::min(most, cause.statistic / cause.bound);
}

FitVerdict verdict_of(const std::vector<FitCause>& causes) {
  const auto any = [&](bool open) {
    return std::ranges::any_of(
        causes, [&](const FitCause& cause) { return !cause.is_small && is_open(cause) == open; });
  };
  if (any(false)) return FitVerdict::kDoesNotFit;
  if (any(true)) return FitVerdict::kUndetermined;
  return causes.empty() ? FitVerdict::kFits : FitVerdict::kDoubtful;
}

std::vector<std::string> FitMaker::names(const std::vector<int>& landmarks) const {
  std::vector<std::string> result;
  for (const int k : landmarks) result.push_back(names_[static_cast<std::size_t>(k)]);
  return result;
}

void FitMaker::test(FitCause cause, bool may_be_cause) {
  fit_.tests.push_back({cause.code, cause.landmarks, cause.statistic, cause.bound});
  if (may_be_cause && cause.statistic > cause.bound) fit_.causes.push_back(std::move(cause));
}

bool FitMaker::has_cause(FitCode one, FitCode other) const {
  return std::ranges::any_of(
      fit_.causes, [&](const FitCause& cause) { return cause.code == one || cause.code == other; });
}

Fit sorted_out(Fit fit) {
  std::ranges::stable_sort(fit.causes, std::ranges::greater(), gravity);
  std::ranges::stable_sort(fit.tests, {}, &FitTest::code);
  fit.verdict = verdict_of(fit.causes);
  return fit;
}

Fit FitMaker::finished() && { return sorted_out(std::move(fit_)); }

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

using Eigen::Index;
using Matrix = Eigen::MatrixXd;

constexpr int kTimes = 5;
constexpr double kMostEntries = 4e6;
constexpr Index kFewestCommon = 3;        ///< Steps of two landmarks, for their distance to count.
constexpr std::size_t kMostChanged = 20;  ///< Landmarks whose exchanges are tried.
constexpr double kSureGain = 1.25;        ///< Times the bound: more than doubtful.
constexpr double kMuchMissing = 0.3;      ///< Share of the entries.
constexpr double kWorstOfSecond = 2.5;    ///< Of the second greatest miss, and
constexpr double kWorstOfKnown = 8.0;     ///< Median misses, for a position to be off alone,
constexpr double kOffShare = 0.25;        ///< and at least this share of their spread.

/// The first steps of a history, thinned to what the tests may cost.
HistoryBlocks thinned(const HistoryBlocks& history, Index steps) {
  const double entries = static_cast<double>(history.landmarks()) * static_cast<double>(steps);
  const auto stride = std::max<Index>(1, static_cast<Index>(std::ceil(entries / kMostEntries)));
  return history.between(0, steps).every(stride);
}

/// Distances of the observation vectors over some steps; NaN where they are not determined.
Matrix distances_of(const HistoryBlocks& part) {
  Matrix D = proximities(part, part.steps()).squared_distances.cwiseMax(0.0).cwiseSqrt();
  for (const Index row : unseen_landmarks(part, part.steps())) {
    D.row(row).setConstant(kNaN);
    D.col(row).setConstant(kNaN);
  }
  return D.unaryExpr([](double d) { return std::isfinite(d) ? d : kNaN; });
}

/// Two landmarks whose observations agree better over all time if their IDs are exchanged at some
/// time.
struct Exchange {
  Index first = 0;
  Index second = 0;
  Index step = 0;  ///< Of the thinned history.
  double gain = 0.0;
};

/// Mean squared difference of two landmarks' distances to the others, before and after.
double difference(const Matrix& before, Index i, const Matrix& after, Index j,
                  const Eigen::Array<bool, Eigen::Dynamic, 1>& counted) {
  const Eigen::ArrayXd d = (before.col(i) - after.col(j)).array();
  return counted.select(d.square(), 0.0).sum() / static_cast<double>(counted.count());
}

/// The exchange at one time that explains most.
void try_exchanges(const Matrix& before, Matrix after, Index step, Exchange& best) {
  const auto both = (before.array() == before.array()) && (after.array() == after.array());
  const Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> is_known = both;
  const double total = is_known.select(after.array(), 0.0).sum();
  if (!(total > 0.0)) return;
  after *= is_known.select(before.array(), 0.0).sum() / total;
  std::vector<std::pair<double, Index>> changes;
  std::vector<double> values;
  for (Index i = 0; i < before.rows(); ++i) {
    const Eigen::Array<bool, Eigen::Dynamic, 1> counted = is_known.col(i);
    if (counted.count() < 5) continue;
    changes.emplace_back(difference(before, i, after, i, counted), i);
    values.push_back(changes.back().first);
  }
  if (changes.size() < 5) return;
  const double usual = median(values);
  if (!(usual > 0.0)) return;
  std::ranges::sort(changes, std::ranges::greater());
  if (changes.size() > kMostChanged) changes.resize(kMostChanged);
  for (std::size_t a = 0; a < changes.size(); ++a)
    for (std::size_t b = a + 1; b < changes.size(); ++b) {
      const auto [i, j] = std::minmax(changes[a].second, changes[b].second);
      Eigen::Array<bool, Eigen::Dynamic, 1> counted = is_known.col(i) && is_known.col(j);
      counted(i) = counted(j) = false;
      if (counted.count() < 3) continue;
      const double own =
          difference(before, i, after, i, counted) + difference(before, j, after, j, counted);
      const double other =
          difference(before, i, after, j, counted) + difference(before, j, after, i, counted);
      if (const double gain = (own - other) / (2.0 * usual); gain > best.gain)
        best = {i, j, step, gain};
    }
}

void test_exchanges(FitMaker& maker, const HistoryBlocks& history) {
  Exchange best;
  const Index steps = history.steps();
  for (Index k = 1; k <= kTimes; ++k) {
    const Index cut = k * steps / (kTimes + 1);
    try_exchanges(distances_of(history.between(0, cut)), distances_of(history.between(cut, steps)),
                  cut, best);
  }
  double missing = 0.0;
  for_blocks(history, steps, [&](Index, const Matrix& values) {
    missing += static_cast<double>(values.array().isNaN().count());
  });
  missing /= static_cast<double>(history.landmarks()) * static_cast<double>(steps);
  const double bound = missing > kMuchMissing ? kMostGainIfMissing : kMostExchangeGain;
  FitCause cause{.code = FitCode::kIdsExchanged,
                 .statistic = best.gain,
                 .bound = bound,
                 .is_small = best.gain < kSureGain * bound};
  if (best.gain > bound) {
    cause.landmarks = maker.names({static_cast<int>(best.first), static_cast<int>(best.second)});
    cause.values = {{"share_percent",
                     100.0 * static_cast<double>(steps - best.step) / static_cast<double>(steps)}};
  }
  maker.test(std::move(cause));
}

/// The landmarks of the map in groups that landmarks observed at the same steps form.
std::vector<std::vector<int>> groups_of(const Matrix& common, Index fewest, const Points& map) {
  Graph graph(static_cast<std::size_t>(map.rows()));
  for (Index i = 0; i < map.rows(); ++i)
    for (Index j = 0; j < map.rows(); ++j)
      if (i != j && common(i, j) >= static_cast<double>(fewest))
        graph[static_cast<std::size_t>(i)].push_back({j, 1.0});
  const std::vector<int> piece = components(graph);
  std::vector<std::vector<int>> groups(graph.size());
  for (Index i = 0; i < map.rows(); ++i)
    if (map.row(i).allFinite())
      groups[static_cast<std::size_t>(piece[static_cast<std::size_t>(i)])].push_back(
          static_cast<int>(i));
  std::erase_if(groups, [](const auto& group) { return group.empty(); });
  std::ranges::stable_sort(groups, std::ranges::greater(), &std::vector<int>::size);
  return groups;
}

void test_connections(FitMaker& maker, const HistoryBlocks& history, const Points& map) {
  const Matrix common = steps_seen_together(history, history.steps());
  const auto groups = groups_of(common, kFewestCommon, map);
  const auto connected = groups_of(common, 1, map);
  const bool is_apart = connected.size() > 1;
  std::vector<int> others;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    if (k > 0) others.insert(others.end(), groups[k].begin(), groups[k].end());
    if (groups.size() > 1) maker.part(groups[k]);
  }
  maker.test({.code = is_apart ? FitCode::kDisconnected : FitCode::kWeakBridge,
              .landmarks = maker.names(others),
              .statistic = static_cast<double>(groups.size()),
              .bound = 1.0,
              .is_small = !is_apart && std::ranges::all_of(groups, [&](const auto& group) {
                return &group == &groups.front() || group.size() < 3;
              })});
}

/// Misses of the known positions by an affine map of least squares; empty if the map is flat.
std::optional<Eigen::VectorXd> misses(const Points& from, const Points& to) {
  if (planarity(from) <= kFlatPlanarity) return std::nullopt;
  return Eigen::VectorXd(
      (fit_affine(from, to, AffineFit::kLeastSquares)(from) - to).rowwise().norm());
}

double root_mean_square(const Eigen::VectorXd& values) {
  return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

/// The exchange of two known positions that leaves the smallest misfit.
std::pair<double, std::pair<Index, Index>> best_exchange(const Points& from, Points to) {
  std::pair<double, std::pair<Index, Index>> best{kInfinity, {0, 0}};
  constexpr Index kMostKnown = 60;
  const Index n = std::min(kMostKnown, to.rows());
  for (Index a = 0; a < n; ++a)
    for (Index b = a + 1; b < n; ++b) {
      to.row(a).swap(to.row(b));
      if (const auto left = misses(from, to); left && root_mean_square(*left) < best.first)
        best = {root_mean_square(*left), {a, b}};
      to.row(a).swap(to.row(b));
    }
  return best;
}

void test_known(FitMaker& maker, const Points& map, const Points& known_m,
                double most_known_share) {
  std::vector<Index> rows;
  for (Index k = 0; k < map.rows(); ++k)
    if (map.row(k).allFinite() && known_m.row(k).allFinite()) rows.push_back(k);
  if (rows.size() < 5) return;
  const Points from = map(rows, Eigen::all);
  const Points to = known_m(rows, Eigen::all);
  const std::optional<Eigen::VectorXd> missed = misses(from, to);
  if (!missed) return;
  const Points offsets = to.rowwise() - to.colwise().mean();
  const double spread = std::sqrt(offsets.squaredNorm() / static_cast<double>(rows.size()));
  const double misfit = root_mean_square(*missed);
  maker.number("fit_known_misfit_m", misfit);
  FitCause cause{.code = FitCode::kKnownLandmarksAtOdds,
                 .values = {{"distance_m", misfit}},
                 .statistic = misfit / spread,
                 .bound = most_known_share,
                 .is_small = true};
  Index worst = 0;
  const double largest = missed->maxCoeff(&worst);
  Eigen::VectorXd others = *missed;
  others(worst) = 0.0;
  const double second = others.maxCoeff();
  const double usual = median({missed->data(), static_cast<std::size_t>(missed->size())});
  const auto name = [&](Index k) { return static_cast<int>(rows[static_cast<std::size_t>(k)]); };
  constexpr std::size_t kFewestForOne = 7;
  const bool is_odd = rows.size() >= kFewestForOne && largest > kWorstOfKnown / 2.0 * usual &&
                      largest > kOffShare * spread;
  if (is_odd) {
    const auto [left, two] = best_exchange(from, to);
    if (left < 0.5 * misfit) {
      maker.test({.code = FitCode::kKnownLandmarksExchanged,
                  .landmarks = maker.names({name(two.first), name(two.second)}),
                  .values = {{"distance_m", misfit}},
                  .statistic = misfit / std::max(left, 1e-12),
                  .bound = 2.0});
    } else if (largest > kWorstOfKnown * usual && largest > kWorstOfSecond * second) {
      maker.test({.code = FitCode::kKnownLandmarkOff,
                  .landmarks = maker.names({name(worst)}),
                  .values = {{"distance_m", largest}},
                  .statistic = largest / std::max(usual, 1e-12),
                  .bound = kWorstOfKnown});
    }
  }
  maker.test(std::move(cause));
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

Fit with_tests(Fit fit, std::vector<FitCause> tests) {
  for (FitCause& test : tests) {
    fit.tests.push_back({test.code, test.landmarks, test.statistic, test.bound});
    if (!(test.statistic > test.bound)) continue;
    const auto same = std::ranges::find_if(fit.causes, [&](const FitCause& cause) {
      return cause.code == test.code && cause.landmarks == test.landmarks;
    });
    if (same == fit.causes.end())
      fit.causes.push_back(std::move(test));
    else if (same->is_small)
      *same = std::move(test);
  }
  if (fit.verdict == FitVerdict::kNotTestable && fit.causes.empty()) return fit;
  fit.why.clear();
  return sorted_out(std::move(fit));
}

Fit history_fit(const HistoryBlocks& history, Eigen::Index steps, const Points& map,
                const Points& known_m, double most_known_share) {
  const Index mapped = (map.col(0).array() == map.col(0).array()).count();
  if (mapped < 3) return {.verdict = FitVerdict::kNotTestable, .why = {FitMissing::kMap}};
  if (mapped < 6 || steps < kFewestStepsToTest)
    return {.verdict = FitVerdict::kNotTestable,
            .why = {FitMissing::kRedundancy, FitMissing::kMetric}};
  FitMaker maker(history.names());
  const HistoryBlocks some = thinned(history, steps);
  test_exchanges(maker, some);
  test_connections(maker, some, map);
  test_known(maker, map, known_m, most_known_share);
  return std::move(maker).finished();
}

}  // namespace mapproof
