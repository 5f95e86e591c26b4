#include "core/map_fit/history_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "core/align/affine.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/graph/components.hpp"
#include "core/linalg/planarity.hpp"
#include "core/map_fit/fit_maker.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {
namespace {

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
ObservationHistory thinned(const ObservationHistory& history, Index steps) {
  const double entries = static_cast<double>(history.landmarks()) * static_cast<double>(steps);
  const auto stride = std::max<Index>(1, static_cast<Index>(std::ceil(entries / kMostEntries)));
  const Index count = (steps + stride - 1) / stride;
  ObservationHistory result{.sensor = history.sensor, .names = history.names, .values = {}};
  result.values.resize(history.landmarks(), count);
  for (Index k = 0; k < count; ++k) result.values.col(k) = history.values.col(k * stride);
  return result;
}

/// Distances of the observation vectors over some steps; NaN where they are not determined.
Matrix distances_of(const ObservationHistory& history, Index begin, Index end) {
  const ObservationHistory part{.sensor = history.sensor,
                                .names = history.names,
                                .values = history.values.middleCols(begin, end - begin)};
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

void test_exchanges(FitMaker& maker, const ObservationHistory& history) {
  Exchange best;
  const Index steps = history.steps();
  for (Index k = 1; k <= kTimes; ++k) {
    const Index cut = k * steps / (kTimes + 1);
    try_exchanges(distances_of(history, 0, cut), distances_of(history, cut, steps), cut, best);
  }
  const double missing = static_cast<double>(history.values.array().isNaN().count()) /
                         static_cast<double>(history.values.size());
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

/// In how many steps two landmarks were observed, for each two.
Matrix common_steps(const ObservationHistory& history) {
  const Matrix seen =
      history.sensor == Sensor::kVisibility
          ? Matrix((history.values.array() == 1.0).cast<double>())
          : Matrix((history.values.array() == history.values.array()).cast<double>());
  return seen * seen.transpose();
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

void test_connections(FitMaker& maker, const ObservationHistory& history, const Points& map) {
  const Matrix common = common_steps(history);
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

Fit history_fit(const ObservationHistory& history, Eigen::Index steps, const Points& map,
                const Points& known_m, double most_known_share) {
  const Index mapped = (map.col(0).array() == map.col(0).array()).count();
  if (mapped < 3) return {.verdict = FitVerdict::kNotTestable, .why = {FitMissing::kMap}};
  if (mapped < 6 || steps < kFewestStepsToTest)
    return {.verdict = FitVerdict::kNotTestable,
            .why = {FitMissing::kRedundancy, FitMissing::kMetric}};
  FitMaker maker(history.names);
  const ObservationHistory some = thinned(history, steps);
  test_exchanges(maker, some);
  test_connections(maker, some, map);
  test_known(maker, map, known_m, most_known_share);
  return std::move(maker).finished();
}

}  // namespace mapproof
