#include "core/range_slam/fit/log_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "core/range_slam/dead_reckoning.hpp"
#include "core/range_slam/factors/spread_rows.hpp"
#include "core/range_slam/factors/windowed_ranges.hpp"
#include "core/range_slam/fit/log_evidence.hpp"
#include "core/range_slam/log_checks.hpp"
#include "core/range_slam/refinement/refine_starts.hpp"
#include "core/range_slam/trilateration.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

constexpr Index kLeastRanges = 3;       ///< Of a landmark with a position.
constexpr Index kLeastRedundancy = 20;  ///< Ranges beyond the unknowns of landmarks and scale.
constexpr int kJumpTimes = 20;          ///< Times at which a jump of the clock is tried.
constexpr int kMoveTimes = 9;           ///< Likewise of a move, among a landmark's ranges.
constexpr std::size_t kMostTried = 3;   ///< Hypotheses of one code that are fitted.
constexpr int kMostTimeRounds = 4;      ///< Estimates of a hypothesis's time, in turn with its fit.
/// An effect below this number of a range's sigmas hardly moves the map.
constexpr double kSmallEffect = 0.5;
/// A landmark that moved by less is only doubtful: residuals that hang together in time look alike
/// (on the logs of Plaza and Sapienza up to 1.7).
constexpr double kSmallMove = 3.0;
/// A clock jumped only if so many ranges are before and after, and if a clock that is late
/// throughout explains less than this share of it.
constexpr double kLeastSide = 0.08;
constexpr double kLateShare = 0.85;
constexpr double kManyOutliers = 0.04;  ///< A share that asks for other starts.
/// A range scale so near 1 confirms the scale of odometry.
constexpr double kAgreeingScale = 0.002;

/// Bounds of the drops, and what naming a hypothesis costs: those with a free time have more ways
/// to fit noise.
struct TestRule {
  FitCode code;
  double bound;
  double price;
};
constexpr std::array kTestRules = {
    TestRule{FitCode::kCommonOffset, 20.0, 0.0},   TestRule{FitCode::kLandmarkOffset, 13.0, 2.0},
    TestRule{FitCode::kTimeOffset, 20.0, 0.0},     TestRule{FitCode::kClockJump, 22.0, 4.0},
    TestRule{FitCode::kLandmarkMoved, 40.0, 10.0}, TestRule{FitCode::kIdsExchanged, 22.0, 4.0},
    TestRule{FitCode::kOdometryFrozen, 22.0, 0.0}};

const TestRule& rule_of(FitCode code) {
  return *std::ranges::find(kTestRules, code, &TestRule::code);
}

/// A hypothesis that was fitted.
struct TriedHypothesis {
  LogHypothesis hypothesis;
  LogProblem::Fit fit;
  double statistic = 0.0;

  double ratio() const { return statistic / rule_of(hypothesis.code).bound; }
};

std::vector<double> breaks_of(const std::vector<OdometryGap>& gaps) {
  std::vector<double> breaks_s;
  for (const OdometryGap& gap : gaps) {
    breaks_s.push_back(gap.from_s);
    breaks_s.push_back(gap.to_s);
  }
  std::ranges::sort(breaks_s);
  return breaks_s;
}

constexpr Index kHeldOutBlocks = 20;  ///< Of the ranges, in their order.

Index half_of(std::size_t row, std::size_t rows) {
  return static_cast<Index>(row) * kHeldOutBlocks / static_cast<Index>(rows) % 2;
}

/// A log without the effect of a cause, as Repair has it.
RangeLog corrected(RangeLog log, const LogHypothesis& cause, const LogState& state) {
  const auto is_of = [&](const RangeMeasurement& range, std::size_t k) {
    return cause.landmarks.size() > k && range.landmark == cause.landmarks[k];
  };
  for (RangeMeasurement& range : log.ranges) {
    const bool applies = range.time_s >= cause.from_s && range.time_s < cause.to_s;
    switch (cause.code) {
      case FitCode::kCommonOffset:
        range.range_m -= state.offset_m;
        break;
      case FitCode::kLandmarkOffset:
        if (is_of(range, 0)) range.range_m -= state.offset_m;
        break;
      case FitCode::kTimeOffset:
      case FitCode::kClockJump:
        if (applies) range.time_s -= state.shift_s;
        break;
      case FitCode::kLandmarkMoved:
        if (applies && is_of(range, 0)) range.landmark = std::ssize(log.landmarks);
        break;
      case FitCode::kIdsExchanged:
        if (applies && (is_of(range, 0) || is_of(range, 1)))
          range.landmark = cause.landmarks[is_of(range, 0) ? 1 : 0];
        break;
      default:
        break;
    }
  }
  if (cause.code == FitCode::kLandmarkMoved)
    log.landmarks.push_back(log.landmarks[static_cast<std::size_t>(cause.landmarks[0])] +
                            ", moved");
  std::erase_if(log.ranges, [](const RangeMeasurement& range) { return range.range_m < 0.0; });
  std::ranges::stable_sort(log.ranges, {}, &RangeMeasurement::time_s);
  return log;
}

bool has_time(FitCode code) {
  return code == FitCode::kClockJump || code == FitCode::kLandmarkMoved ||
         code == FitCode::kIdsExchanged;
}

/// Where values have their lowest local minima, the ends apart: lowest first, at most kMostTried.
std::vector<std::size_t> lowest_minima(const std::vector<double>& values) {
  std::vector<std::size_t> lowest;
  for (std::size_t i = 1; i + 1 < values.size(); ++i)
    if (values[i] <= values[i - 1] && values[i] <= values[i + 1]) lowest.push_back(i);
  std::ranges::stable_sort(lowest, {}, [&](std::size_t i) { return values[i]; });
  if (lowest.size() > kMostTried) lowest.resize(kMostTried);
  return lowest;
}

/// Takes the positions that were found; a landmark without one stays where it is.
void take_positions(const Points& found, LogState& state) {
  for (std::size_t n = 0; n < state.landmarks.size(); ++n)
    if (found.row(static_cast<Index>(n)).allFinite())
      state.landmarks[n] = found.row(static_cast<Index>(n)).transpose();
}

/// The plain fit, the hypotheses compared with it, and the verdict.
class LogTester {
 public:
  LogTester(const RangeLog& log, const LogFitOptions& options)
      : log_(log), options_(options), odometry_(dead_reckoned(log)), gaps_(gaps_by_stamps(log)) {
    place_landmarks();
  }

  LogFit run(const std::vector<SlamEstimate>& starts);

 private:
  std::optional<HeldOutRanges> held_out(const TriedHypothesis& cause) const;
  void place_landmarks();
  bool is_redundant() const;
  LogProblem make_problem(Index keys, const std::vector<OdometryGap>& gaps) const;
  LogState state_of(const LogProblem& problem, const SlamEstimate& start) const;
  LogNoise first_noise(const LogProblem& problem, const LogState& start) const;
  LogProblem::Fit fit_plain(const LogProblem& problem,
                            const std::vector<SlamEstimate>& starts) const;
  void improve_plain();
  TriedHypothesis tried(LogHypothesis hypothesis, LogState start, LogNoise noise) const;
  double statistic_of(const LogProblem& problem, double plain_cost,
                      const LogProblem::Fit& fit) const;
  TriedHypothesis best_shift(const LogHypothesis& hypothesis,
                             const std::vector<LogState>& starts) const;
  std::vector<LogProblem::Fit> fits_of_parts(double before_s, double after_s) const;
  LogState joined(const LogProblem& problem, const std::vector<LogProblem::Fit>& parts,
                  double time_s) const;
  void update_times(LogHypothesis& hypothesis, const LogProblem::Fit& fit) const;
  /// The shifts of a clock at which the ranges cost least, the path held: lowest first, at most
  /// kMostTried, among multiples of `step_s` that grow apart.
  std::vector<double> likely_shifts(const LogHypothesis& hypothesis, LogProblem::Fit fit,
                                    double step_s) const;
  /// States with time offsets of up to a quarter of the log, at which a quarter of the ranges
  /// agrees best with the dead-reckoned path. Slopes do not lead to them.
  std::vector<LogState> starts_by_offset() const;
  void try_offsets();
  void try_times();
  void try_moves();
  void try_exchanges();
  /// Adds a fit to those that were tried, unless one of the same code and landmarks costs less.
  void keep_better(TriedHypothesis one);
  void try_frozen();
  void add_limits(const LogProblem::Scores& scores, std::vector<FitTest>& tests) const;
  FitCause cause_of(const TriedHypothesis& tried) const;
  double effect_of(const TriedHypothesis& tried) const;
  void judge(LogFit& result);
  void judge_gaps(Fit& fit) const;
  void judge_known(Fit& fit) const;
  void take_best(LogFit& result) const;
  void find_open_parts(Fit& fit) const;
  void finish(LogFit& result) const;
  SlamEstimate estimate_of(const LogProblem& problem, const LogProblem::Fit& fit) const;
  std::array<bool, 4> given() const {
    const GivenNoise& noise = options_.noise;
    return {noise.way_m > 0.0, noise.heading_per_metre > 0.0, noise.heading_per_radian > 0.0,
            noise.range_m > 0.0};
  }
  std::string named(Index landmark) const {
    return log_.landmarks[static_cast<std::size_t>(landmark)];
  }

  const RangeLog& log_;
  const LogFitOptions& options_;
  Trajectory odometry_;
  std::vector<OdometryGap> gaps_;
  std::vector<bool> is_placed_;
  std::optional<LogProblem> problem_;
  LogProblem::Fit plain_;
  double inflation_ = 1.0;
  double speed_ = 0.0;                   ///< m/s, of the odometry.
  std::vector<LogProblem::Fit> halves_;  ///< Of the ranges of each half of the log alone; or none.
  std::vector<TriedHypothesis> tried_;
};

void LogTester::place_landmarks() {
  std::vector<Index> counts(log_.landmarks.size(), 0);
  const Eigen::VectorXd& times = odometry_.time_s;
  for (const RangeMeasurement& range : log_.ranges) {
    const bool in_gap = std::ranges::any_of(gaps_, [&](const OdometryGap& gap) {
      return range.time_s > gap.from_s && range.time_s < gap.to_s;
    });
    if (!in_gap && range.time_s >= times(0) && range.time_s <= times(times.size() - 1))
      ++counts[static_cast<std::size_t>(range.landmark)];
  }
  for (const Index count : counts) is_placed_.push_back(count >= kLeastRanges);
  double way_m = 0.0;
  for (const Motion& motion : log_.odometry)
    way_m += std::hypot(motion.distance_m, motion.sideways_m);
  speed_ = way_m / (times(times.size() - 1) - times(0));
}

bool LogTester::is_redundant() const {
  Index ranges = 0, unknowns = 1;
  for (const bool is_placed : is_placed_) unknowns += is_placed ? 2 : 0;
  for (const LogProblem::Range& range : problem_->ranges()) ranges += range.in_gap ? 0 : 1;
  return unknowns > 1 && ranges >= unknowns + kLeastRedundancy;
}

LogProblem LogTester::make_problem(Index keys, const std::vector<OdometryGap>& gaps) const {
  return {log_,
          odometry_,
          is_placed_,
          gaps,
          {.most_keys = keys, .breaks_s = breaks_of(gaps), .given = given()}};
}

LogState LogTester::state_of(const LogProblem& problem, const SlamEstimate& start) const {
  LogState state{.poses = problem.poses_of(start.path), .scale = start.range_scale};
  std::optional<Points> found;
  for (Index n = 0; n < problem.landmarks(); ++n) {
    const bool has = start.landmarks_m.rows() > n && start.landmarks_m.row(n).allFinite();
    if (!has && !found) found = trilaterated(log_, start.path, start.range_scale);
    Eigen::Vector2d position = (has ? start.landmarks_m : *found).row(n).transpose();
    if (!position.allFinite()) position.setZero();
    state.landmarks.push_back(position);
  }
  return state;
}

LogNoise LogTester::first_noise(const LogProblem& problem, const LogState& start) const {
  LogNoise noise = problem.first_noise(start);
  const GivenNoise& given = options_.noise;
  if (given.range_m > 0.0) noise.range_m = given.range_m;
  if (given.way_m > 0.0) noise.way_m = given.way_m;
  if (given.heading_per_metre > 0.0) noise.heading_per_metre = given.heading_per_metre;
  if (given.heading_per_radian > 0.0) noise.heading_per_radian = given.heading_per_radian;
  return noise;
}

LogProblem::Fit LogTester::fit_plain(const LogProblem& problem,
                                     const std::vector<SlamEstimate>& starts) const {
  std::vector<SlamEstimate> all = starts;
  if (all.empty()) {
    SlamEstimate reckoned;
    reckoned.path = odometry_;
    all.push_back(std::move(reckoned));
  }
  LogProblem::Fit best;
  for (SlamEstimate& start : all) {
    if (start.path.size() != odometry_.size() || start.path.heading_rad.size() == 0)
      start.path = carried_along(start.path, odometry_);
    const LogState state = state_of(problem, start);
    LogProblem::Fit fit = problem.fit({}, state, first_noise(problem, state), {});
    if (fit.is_usable && fit.cost < best.cost) best = std::move(fit);
  }
  return best;
}

/// Where much does not fit, or a gap parts the path: the plain fit from each side alone, and from
/// both sides joined.
void LogTester::improve_plain() {
  if (gaps_.empty() && plain_.noise.outlier_share < kManyOutliers) return;
  const double middle_s = 0.5 * (odometry_.time_s(0) + odometry_.time_s(odometry_.size() - 1));
  const double before_s = gaps_.empty() ? middle_s : gaps_.front().from_s;
  const double after_s = gaps_.empty() ? middle_s : gaps_.front().to_s;
  const std::vector<LogProblem::Fit> parts = fits_of_parts(before_s, after_s);
  if (parts.empty()) return;
  const std::array starts = {joined(*problem_, parts, after_s), parts[0].state, parts[1].state};
  for (std::size_t i = 0; i < starts.size(); ++i) {
    LogProblem::Fit fit =
        problem_->fit({}, starts[i], parts[i < 2 ? 0 : 1].noise, LogProblem::Effort{});
    if (fit.is_usable && fit.cost < plain_.cost) plain_ = std::move(fit);
  }
}

void LogTester::update_times(LogHypothesis& hypothesis, const LogProblem::Fit& fit) const {
  LogHypothesis always = hypothesis, never = hypothesis;
  always.from_s = -kInfinity;
  always.to_s = kInfinity;
  never.from_s = kInfinity;
  const Eigen::VectorXd gain =
      problem_->range_costs(never, fit) - problem_->range_costs(always, fit);
  const auto& ranges = problem_->ranges();
  // The interval, or the time from which on, the hypothesis gains most.
  double sum = 0.0, best = 0.0;
  std::size_t first = 0;
  const bool to_end = hypothesis.code != FitCode::kIdsExchanged;
  if (to_end) {
    best = -kInfinity;
    for (std::size_t i = ranges.size(); i-- > 0;) {
      sum += gain(static_cast<Index>(i));
      if (sum > best) {
        best = sum;
        hypothesis.from_s = ranges[i].time_s;
      }
    }
    return;
  }
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (sum <= 0.0) {
      sum = 0.0;
      first = i;
    }
    sum += gain(static_cast<Index>(i));
    if (sum > best) {
      best = sum;
      hypothesis.from_s = ranges[first].time_s;
      hypothesis.to_s = i + 1 < ranges.size() ? ranges[i + 1].time_s : kInfinity;
    }
  }
}

TriedHypothesis LogTester::tried(LogHypothesis hypothesis, LogState start, LogNoise noise) const {
  TriedHypothesis best{.hypothesis = hypothesis, .fit = {}};
  for (int round = 0; round < (has_time(hypothesis.code) ? kMostTimeRounds : 1); ++round) {
    LogProblem::Fit fit =
        problem_->fit(hypothesis, start, noise, {.rounds = 10, .steps = 3, .tolerance = 0.2});
    if (!fit.is_usable) break;
    start = fit.state;
    noise = fit.noise;
    const LogHypothesis before = hypothesis;
    if (has_time(hypothesis.code)) update_times(hypothesis, fit);
    if (fit.cost < best.fit.cost) {
      best.hypothesis = before;
      best.fit = std::move(fit);
    }
    if (before.from_s == hypothesis.from_s && before.to_s == hypothesis.to_s) break;
  }
  best.statistic = statistic_of(*problem_, plain_.cost, best.fit);
  return best;
}

double LogTester::statistic_of(const LogProblem& problem, double plain_cost,
                               const LogProblem::Fit& fit) const {
  if (!fit.is_usable) return 0.0;
  // What a fault leaves in the residuals of the plain fit hangs together in time, too; under the
  // right hypothesis it is gone.
  return std::max(0.0, (plain_cost - fit.cost) / inflation_of(problem, fit));
}

void LogTester::try_offsets() {
  tried_.push_back(tried({.code = FitCode::kCommonOffset}, plain_.state, plain_.noise));
  const LogProblem::Scores scores = problem_->scores(plain_, {});
  std::vector<Index> order;
  for (Index n = 0; n < problem_->landmarks(); ++n)
    if (is_placed_[static_cast<std::size_t>(n)]) order.push_back(n);
  std::ranges::stable_sort(order, std::greater<>(), [&](Index n) { return scores.landmark(n); });
  if (order.size() > 2 * kMostTried) order.resize(2 * kMostTried);
  for (const Index n : order)
    tried_.push_back(
        tried({.code = FitCode::kLandmarkOffset, .landmarks = {n}}, plain_.state, plain_.noise));
}

TriedHypothesis LogTester::best_shift(const LogHypothesis& hypothesis,
                                      const std::vector<LogState>& starts) const {
  TriedHypothesis best{.hypothesis = hypothesis, .fit = {}};
  for (const LogState& start : starts) {
    TriedHypothesis one = tried(hypothesis, start, plain_.noise);
    if (one.fit.cost < best.fit.cost) best = std::move(one);
  }
  return best;
}

/// Fits of the ranges before one time alone, and of those after another: what happened in the other
/// part has not bent them. Empty, unless each part hears all landmarks.
std::vector<LogProblem::Fit> LogTester::fits_of_parts(double before_s, double after_s) const {
  std::vector<LogProblem::Fit> fits;
  for (const bool is_first : {true, false}) {
    RangeLog part = log_;
    std::erase_if(part.ranges, [&](const RangeMeasurement& range) {
      return is_first ? range.time_s >= before_s : range.time_s < after_s;
    });
    std::vector<Index> counts(log_.landmarks.size(), 0);
    for (const RangeMeasurement& range : part.ranges)
      ++counts[static_cast<std::size_t>(range.landmark)];
    if (std::ranges::any_of(counts, [](Index count) { return count < 6; })) return {};
    const LogProblem problem(
        part, odometry_, is_placed_, gaps_,
        {.most_keys = options_.test_keys, .breaks_s = breaks_of(gaps_), .given = given()});
    LogState start = plain_.state;
    start.poses = problem.poses_of(odometry_);
    take_positions(trilaterated(part, odometry_, plain_.state.scale), start);
    fits.push_back(
        problem.fit({}, start, first_noise(problem, start), {.rounds = 12, .tolerance = 0.5}));
    if (!fits.back().is_usable) return {};
  }
  return fits;
}

/// The first part's path up to a time, and the second one's from there on, moved to where its
/// landmarks lie best on those of the first.
LogState LogTester::joined(const LogProblem& problem, const std::vector<LogProblem::Fit>& parts,
                           double time_s) const {
  const LogState& first = parts[0].state;
  const LogState& second = parts[1].state;
  const double count = static_cast<double>(log_.landmarks.size());
  Eigen::Vector2d from = Eigen::Vector2d::Zero(), to = Eigen::Vector2d::Zero();
  for (std::size_t n = 0; n < log_.landmarks.size(); ++n) {
    from += second.landmarks[n] / count;
    to += first.landmarks[n] / count;
  }
  double c = 0.0, d = 0.0;
  for (std::size_t n = 0; n < log_.landmarks.size(); ++n) {
    const Eigen::Vector2d a = second.landmarks[n] - from, b = first.landmarks[n] - to;
    c += a.dot(b);
    d += a(0) * b(1) - a(1) * b(0);
  }
  const double angle = std::atan2(d, c);
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(angle).toRotationMatrix();
  Trajectory path = problem_->path_of(first.poses);
  const Trajectory after = problem_->path_of(second.poses);
  for (Index row = 0; row < path.size(); ++row) {
    if (path.time_s(row) < time_s) continue;
    const Eigen::Vector2d position = after.positions_m.row(row).transpose();
    path.positions_m.row(row) = (to + R * (position - from)).transpose();
    path.heading_rad(row) = after.heading_rad(row) + angle;
  }
  LogState state = first;
  state.poses = problem.poses_of(path);
  return state;
}

std::vector<double> LogTester::likely_shifts(const LogHypothesis& hypothesis, LogProblem::Fit fit,
                                             double step_s) const {
  std::vector<double> shifts_s, costs;
  for (int k = -25; k <= 25; ++k) {
    fit.state.shift_s = step_s * k * (1.0 + 0.08 * std::abs(k));
    shifts_s.push_back(fit.state.shift_s);
    costs.push_back(problem_->range_costs(hypothesis, fit).sum());
  }
  std::vector<double> likely_s;
  for (const std::size_t i : lowest_minima(costs)) likely_s.push_back(shifts_s[i]);
  return likely_s;
}

std::vector<LogState> LogTester::starts_by_offset() const {
  const Eigen::VectorXd& times = odometry_.time_s;
  const double length_s = times(times.size() - 1) - times(0);
  const Index most = problem_->keys().size() / 4;
  LogState reckoned = plain_.state;
  reckoned.poses = problem_->poses_of(odometry_);
  std::vector<LogState> states;
  std::vector<double> misfits;
  for (Index k = -most; k <= most; ++k) {
    LogState state = reckoned;
    state.shift_s = length_s * static_cast<double>(k) / static_cast<double>(4 * most);
    RangeLog part = log_;
    std::erase_if(part.ranges, [&](RangeMeasurement& range) {
      range.time_s -= state.shift_s;
      return std::abs(range.time_s - times(0) - 0.5 * length_s) > 0.125 * length_s;
    });
    take_positions(trilaterated(part, odometry_, state.scale), state);
    std::vector<double> errors_m;
    const std::vector<LandmarkRanges> heard =
        ranges_by_landmark(part.ranges, std::ssize(log_.landmarks), odometry_);
    for (std::size_t n = 0; n < heard.size(); ++n)
      for (Index i = 0; i < heard[n].range_m.size(); ++i)
        errors_m.push_back(std::abs(
            state.scale * (heard[n].positions_m.row(i).transpose() - state.landmarks[n]).norm() -
            heard[n].range_m(i)));
    states.push_back(std::move(state));
    misfits.push_back(errors_m.empty() ? kInfinity : median(errors_m));
  }
  std::vector<LogState> likely;
  for (const std::size_t i : lowest_minima(misfits)) likely.push_back(std::move(states[i]));
  return likely;
}

void LogTester::try_times() {
  const double length_s = odometry_.time_s(odometry_.size() - 1) - odometry_.time_s(0);
  // From no shift, and from some that are so large that slopes do not lead there.
  const double reach_s = std::min(0.02 * length_s, 30.0 * plain_.noise.range_m / speed_);
  std::vector<LogState> starts(3, plain_.state);
  starts[1].shift_s = -reach_s;
  starts[2].shift_s = reach_s;
  TriedHypothesis late = best_shift({.code = FitCode::kTimeOffset}, starts);
  if (problem_->estimates_way() &&
      odometry_error_percent(*problem_, plain_.state) > kOdometryErrorBound_percent)
    for (const LogState& start : starts_by_offset()) {
      TriedHypothesis one =
          tried({.code = FitCode::kTimeOffset}, start, first_noise(*problem_, start));
      if (one.fit.cost < late.fit.cost) late = std::move(one);
    }
  tried_.push_back(late);
  std::vector<double> times;
  for (int k = 1; k < kJumpTimes; ++k)
    times.push_back(odometry_.time_s(0) + length_s * k / kJumpTimes);
  const LogProblem::Scores scores = problem_->scores(plain_, times);
  Index best = 0;
  scores.jump.maxCoeff(&best);
  TriedHypothesis jump = best_shift(
      {.code = FitCode::kClockJump, .from_s = times[static_cast<std::size_t>(best)]}, starts);
  // A clock that is right in one half shows how far it is off in the other.
  const double middle_s = odometry_.time_s(0) + 0.5 * length_s;
  const LogHypothesis half_way{.code = FitCode::kClockJump, .from_s = middle_s};
  for (LogProblem::Fit guess : halves_)
    for (const double shift_s : likely_shifts(half_way, guess, 0.25 * reach_s)) {
      guess.state.shift_s = shift_s;
      TriedHypothesis one = tried(half_way, guess.state, guess.noise);
      if (one.fit.cost < jump.fit.cost) jump = std::move(one);
    }
  // A jump near one end is a late clock.
  double after = 0.0, count = 0.0;
  for (const LogProblem::Range& range : problem_->ranges()) {
    after += range.time_s >= jump.hypothesis.from_s ? 1.0 : 0.0;
    count += 1.0;
  }
  const bool is_at_end = after < kLeastSide * count || after > (1.0 - kLeastSide) * count;
  if (is_at_end || late.statistic > kLateShare * jump.statistic)
    jump.statistic = std::min(jump.statistic, late.statistic);
  tried_.push_back(std::move(jump));
}

void LogTester::try_moves() {
  struct Candidate {
    double gain = 0.0;
    LogHypothesis hypothesis;
    Eigen::Vector2d before, after;
  };
  std::vector<Candidate> candidates;
  const auto& ranges = problem_->ranges();
  const Points positions = range_positions(*problem_, plain_.state);
  const Eigen::VectorXd costs = problem_->range_costs({}, plain_);
  for (Index n = 0; n < problem_->landmarks(); ++n) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < ranges.size(); ++i)
      if (ranges[i].landmark == n && !ranges[i].in_gap) rows.push_back(i);
    if (rows.size() < 12) continue;
    Candidate best;
    const Eigen::Vector2d& own = plain_.state.landmarks[static_cast<std::size_t>(n)];
    for (int k = 1; k <= kMoveTimes; ++k) {
      const std::size_t middle = rows.size() * static_cast<std::size_t>(k) / (kMoveTimes + 1);
      const std::vector<std::size_t> first(rows.begin(), rows.begin() + std::ptrdiff_t(middle));
      const std::vector<std::size_t> last(rows.begin() + std::ptrdiff_t(middle), rows.end());
      if (first.size() < 5 || last.size() < 5) continue;
      LogProblem::Fit moved = plain_;
      moved.state.landmarks.push_back(located(*problem_, positions, last, plain_, own));
      moved.state.landmarks[static_cast<std::size_t>(n)] =
          located(*problem_, positions, first, plain_, own);
      const LogHypothesis hypothesis{
          .code = FitCode::kLandmarkMoved, .landmarks = {n}, .from_s = ranges[rows[middle]].time_s};
      const Eigen::VectorXd after = problem_->range_costs(hypothesis, moved);
      double gain = 0.0;
      for (const std::size_t i : rows)
        gain += costs(static_cast<Index>(i)) - after(static_cast<Index>(i));
      if (gain > best.gain)
        best = {gain, hypothesis, moved.state.landmarks[static_cast<std::size_t>(n)],
                moved.state.landmarks.back()};
    }
    if (best.gain > 10.0 * inflation_) candidates.push_back(std::move(best));
  }
  std::ranges::stable_sort(candidates, std::greater<>(), &Candidate::gain);
  if (candidates.size() > kMostTried) candidates.resize(kMostTried);
  for (const Candidate& candidate : candidates) {
    LogState start = plain_.state;
    start.landmarks[static_cast<std::size_t>(candidate.hypothesis.landmarks[0])] = candidate.before;
    start.landmarks.push_back(candidate.after);
    tried_.push_back(tried(candidate.hypothesis, start, plain_.noise));
  }
}

void LogTester::try_exchanges() {
  struct Candidate {
    double gain = 0.0;
    LogHypothesis hypothesis;
  };
  // Exchanged IDs bend the plain fit; that of the half without them is not bent.
  std::vector<const LogProblem::Fit*> starts = {&plain_};
  for (const LogProblem::Fit& half : halves_) starts.push_back(&half);
  for (const LogProblem::Fit* start : starts) {
    std::vector<Candidate> candidates;
    const double cost = problem_->range_costs({}, *start).sum();
    for (Index a = 0; a < problem_->landmarks(); ++a)
      for (Index b = a + 1; b < problem_->landmarks(); ++b) {
        if (!is_placed_[static_cast<std::size_t>(a)] || !is_placed_[static_cast<std::size_t>(b)])
          continue;
        LogHypothesis hypothesis{.code = FitCode::kIdsExchanged, .landmarks = {a, b}};
        update_times(hypothesis, *start);
        if (hypothesis.from_s == -kInfinity) continue;
        const double gain = cost - problem_->range_costs(hypothesis, *start).sum();
        if (gain > 8.0) candidates.push_back({gain, hypothesis});
      }
    std::ranges::stable_sort(candidates, std::greater<>(), &Candidate::gain);
    if (candidates.size() > kMostTried) candidates.resize(kMostTried);
    for (const Candidate& candidate : candidates) {
      LogHypothesis hypothesis = candidate.hypothesis;
      LogState state = start->state;
      // IDs exchanged up to a time are those exchanged from it on, with the landmarks exchanged.
      const auto before = std::ranges::count_if(
          problem_->ranges(), [&](const auto& range) { return range.time_s < hypothesis.from_s; });
      if (std::isfinite(hypothesis.to_s) &&
          static_cast<double>(before) <
              kLeastSide * static_cast<double>(problem_->ranges().size())) {
        hypothesis.from_s = std::exchange(hypothesis.to_s, kInfinity);
        std::swap(state.landmarks[static_cast<std::size_t>(hypothesis.landmarks[0])],
                  state.landmarks[static_cast<std::size_t>(hypothesis.landmarks[1])]);
      }
      keep_better(tried(hypothesis, std::move(state), start->noise));
    }
  }
}

void LogTester::keep_better(TriedHypothesis one) {
  const auto same = std::ranges::find_if(tried_, [&](const TriedHypothesis& other) {
    return other.hypothesis.code == one.hypothesis.code &&
           other.hypothesis.landmarks == one.hypothesis.landmarks;
  });
  if (same == tried_.end())
    tried_.push_back(std::move(one));
  else if (one.fit.cost < same->fit.cost)
    *same = std::move(one);
}

void LogTester::try_frozen() {
  for (const OdometryGap& run : frozen_stretches(log_, kMostTried)) {
    Index heard = 0;
    for (const LogProblem::Range& range : problem_->ranges())
      heard += range.time_s > run.from_s && range.time_s < run.to_s ? 1 : 0;
    if (heard < kLeastRanges) continue;
    std::vector<OdometryGap> gaps = gaps_;
    gaps.push_back(run);
    // The same keys with and without, so that the costs can be compared; ranges within the stretch
    // count in neither: how the robot went there is open.
    OdometryGap trusted = run;
    trusted.way_sigma_m = 0.0;
    trusted.heading_change_sigma_rad = 0.0;
    std::vector<OdometryGap> before = gaps_;
    before.push_back(trusted);
    const LogProblem with = make_problem(options_.test_keys, gaps);
    const LogProblem without = make_problem(options_.test_keys, before);
    const auto start_of = [&](const LogProblem& problem) {
      LogState state = plain_.state;
      state.poses = problem.poses_of(problem_->path_of(plain_.state.poses));
      return state;
    };
    const LogProblem::Effort effort{.rounds = 15, .tolerance = 0.1};
    LogProblem::Fit plain = without.fit({}, start_of(without), plain_.noise, effort);
    LogProblem::Fit free = with.fit({}, start_of(with), plain_.noise, effort);
    const std::vector<LogProblem::Fit> parts = fits_of_parts(run.from_s, run.to_s);
    if (!parts.empty()) {
      LogProblem::Fit other = with.fit({}, joined(with, parts, run.to_s), parts[0].noise, effort);
      if (other.is_usable && other.cost < free.cost) free = std::move(other);
    }
    if (!plain.is_usable || !free.is_usable) continue;
    TriedHypothesis one{
        .hypothesis = {.code = FitCode::kOdometryFrozen, .from_s = run.from_s, .to_s = run.to_s},
        .fit = std::move(free),
        .statistic = 0.0};
    one.statistic = statistic_of(with, plain.cost, one.fit);
    tried_.push_back(std::move(one));
  }
}

double LogTester::effect_of(const TriedHypothesis& tried) const {
  const double sigma = tried.fit.noise.range_m;
  switch (tried.hypothesis.code) {
    case FitCode::kCommonOffset:
    case FitCode::kLandmarkOffset:
      return std::abs(tried.fit.state.offset_m) / sigma;
    case FitCode::kTimeOffset:
    case FitCode::kClockJump:
      return std::abs(tried.fit.state.shift_s) * speed_ / sigma;
    case FitCode::kLandmarkMoved:
      return (tried.fit.state.landmarks.back() -
              tried.fit.state
                  .landmarks[static_cast<std::size_t>(tried.hypothesis.landmarks.front())])
                 .norm() /
             sigma;
    default:
      return kInfinity;
  }
}

FitCause LogTester::cause_of(const TriedHypothesis& tried) const {
  const LogState& state = tried.fit.state;
  FitCause cause{
      .code = tried.hypothesis.code,
      .statistic = tried.statistic,
      .bound = rule_of(tried.hypothesis.code).bound,
      .is_small = effect_of(tried) <
                  (tried.hypothesis.code == FitCode::kLandmarkMoved ? kSmallMove : kSmallEffect)};
  for (const Index n : tried.hypothesis.landmarks) cause.landmarks.push_back(named(n));
  switch (cause.code) {
    case FitCode::kCommonOffset:
    case FitCode::kLandmarkOffset:
      cause.values.push_back({.id = "offset_m", .value = state.offset_m});
      break;
    case FitCode::kTimeOffset:
    case FitCode::kClockJump:
      cause.values.push_back({.id = "offset_s", .value = state.shift_s});
      break;
    case FitCode::kLandmarkMoved:
      cause.values.push_back(
          {.id = "distance_m",
           .value = (state.landmarks.back() -
                     state.landmarks[static_cast<std::size_t>(tried.hypothesis.landmarks[0])])
                        .norm()});
      break;
    default:
      break;
  }
  if (std::isfinite(tried.hypothesis.from_s))
    cause.values.push_back({.id = "from_s", .value = tried.hypothesis.from_s});
  if (std::isfinite(tried.hypothesis.to_s))
    cause.values.push_back({.id = "to_s", .value = tried.hypothesis.to_s});
  return cause;
}

void LogTester::add_limits(const LogProblem::Scores& scores, std::vector<FitTest>& tests) const {
  // Seen with a chance of 90 %: the bound plus 1.3 standard deviations.
  const auto seen = [&](FitCode code, double sigma) {
    return (std::sqrt(rule_of(code).bound) + 1.3) * std::sqrt(inflation_) * sigma;
  };
  for (FitTest& test : tests) {
    if (test.code == FitCode::kCommonOffset && std::isfinite(scores.common_sigma_m))
      test.limit = {.id = "offset_m", .value = seen(test.code, scores.common_sigma_m)};
    if (test.code == FitCode::kTimeOffset && std::isfinite(scores.shift_sigma_s))
      test.limit = {.id = "offset_s", .value = seen(test.code, scores.shift_sigma_s)};
    if (test.code != FitCode::kLandmarkOffset) continue;
    const auto found = std::ranges::find(log_.landmarks, test.landmarks.front());
    const double sigma = scores.landmark_sigma_m(found - log_.landmarks.begin());
    if (std::isfinite(sigma)) test.limit = {.id = "offset_m", .value = seen(test.code, sigma)};
  }
}

void LogTester::judge_gaps(Fit& fit) const {
  for (const OdometryGap& gap : gaps_) {
    const bool matters = gap.way_sigma_m > 2.0 * plain_.noise.range_m;
    // Landmarks heard on both sides join them; with three of them nothing else is needed.
    std::vector<int> sides(log_.landmarks.size(), 0);
    for (const LogProblem::Range& range : problem_->ranges())
      if (!range.in_gap)
        sides[static_cast<std::size_t>(range.landmark)] |= range.time_s <= gap.from_s ? 1 : 2;
    const bool is_joined = std::ranges::count(sides, 3) >= 3;
    const double statistic = gap.way_sigma_m / plain_.noise.range_m;
    fit.tests.push_back({.code = FitCode::kOdometryGap, .statistic = statistic, .bound = 2.0});
    if (matters)
      fit.causes.push_back({.code = FitCode::kOdometryGap,
                            .values = {{.id = "from_s", .value = gap.from_s},
                                       {.id = "to_s", .value = gap.to_s},
                                       {.id = "distance_m", .value = gap.way_sigma_m}},
                            .statistic = statistic,
                            .bound = 2.0,
                            .is_small = is_joined});
  }
}

void LogTester::judge_known(Fit& fit) const {
  if (!options_.known || options_.known->rows.size() < 2) return;
  const LogProblem::Covariances map = problem_->covariances(plain_);
  if (!map.is_determined) return;
  const KnownLandmarksTest test =
      known_landmarks_test(*options_.known, plain_.state.landmarks,
                           {.covariance = inflation_ * map.all,
                            .survey_sigma_m = 0.2 * plain_.noise.range_m,
                            .scale_sigma = options_.odometry_scale_sigma});
  fit.tests.push_back(
      {.code = FitCode::kKnownLandmarksAtOdds, .statistic = test.statistic, .bound = test.bound});
  if (test.scale_statistic > 0.0)
    fit.tests.push_back({.code = FitCode::kKnownScale,
                         .statistic = test.scale_statistic,
                         .bound = test.scale_bound});
  for (std::size_t k = 0; k < test.causes.size(); ++k) {
    FitCause cause = test.causes[k];
    for (const Index n : test.rows[k]) cause.landmarks.push_back(named(n));
    fit.causes.push_back(std::move(cause));
  }
}

void LogTester::take_best(LogFit& result) const {
  // The hypothesis that explains most is the cause; what else it explains is not named again.
  const TriedHypothesis* best = nullptr;
  const auto gain = [](const TriedHypothesis& one) {
    return one.statistic - rule_of(one.hypothesis.code).price;
  };
  for (const TriedHypothesis& one : tried_)
    if (one.ratio() > 1.0 && (best == nullptr || gain(one) > gain(*best))) best = &one;
  if (best == nullptr) return;
  result.fit.causes.push_back(cause_of(*best));
  result.cause = best->hypothesis;
  result.repaired_cost = best->fit.cost;
  if (best->hypothesis.code == FitCode::kOdometryFrozen) return;
  if (options_.holds_out) result.held_out = held_out(*best);
  LogProblem::Fit fit_of_cause = best->fit;
  fit_of_cause.state.landmarks.resize(log_.landmarks.size());
  fit_of_cause.state.offsets_m.resize(0);
  Repair repair{.log = corrected(log_, best->hypothesis, best->fit.state),
                .estimate = estimate_of(*problem_, fit_of_cause),
                .noise = best->fit.noise};
  repair.estimate.landmark_cov_m2.clear();
  repair.estimate.position_cov_m2.clear();
  repair.estimate.position_cov_rows.clear();
  result.repaired = std::move(repair);
}

/// Each half of the blocks is predicted by the fits to the other one. Empty if a fit fails.
std::optional<HeldOutRanges> LogTester::held_out(const TriedHypothesis& cause) const {
  HeldOutRanges sums;
  for (const Index half : {0, 1}) {
    RangeLog others = log_;
    others.ranges.clear();
    for (std::size_t row = 0; row < log_.ranges.size(); ++row)
      if (half_of(row, log_.ranges.size()) != half) others.ranges.push_back(log_.ranges[row]);
    const LogProblem problem(
        others, odometry_, is_placed_, gaps_,
        {.most_keys = options_.test_keys, .breaks_s = breaks_of(gaps_), .given = given()});
    const LogProblem::Effort effort{.rounds = 10, .steps = 3, .tolerance = 0.2};
    const LogProblem::Fit plain = problem.fit({}, plain_.state, plain_.noise, effort);
    const LogProblem::Fit repaired =
        problem.fit(cause.hypothesis, cause.fit.state, cause.fit.noise, effort);
    if (!plain.is_usable || !repaired.is_usable) return std::nullopt;
    const Eigen::VectorXd of_plain = problem_->range_costs({}, plain);
    const Eigen::VectorXd of_repaired = problem_->range_costs(cause.hypothesis, repaired);
    for (std::size_t i = 0; i < problem_->ranges().size(); ++i) {
      const LogProblem::Range& range = problem_->ranges()[i];
      if (range.in_gap || half_of(range.row, log_.ranges.size()) != half) continue;
      sums.plain -= 0.5 * of_plain(static_cast<Index>(i));
      sums.repaired -= 0.5 * of_repaired(static_cast<Index>(i));
      ++sums.ranges;
    }
  }
  if (sums.ranges == 0) return std::nullopt;
  sums.plain /= static_cast<double>(sums.ranges);
  sums.repaired /= static_cast<double>(sums.ranges);
  return sums;
}

void LogTester::find_open_parts(Fit& fit) const {
  const std::vector<Index> mirrored = mirrored_landmarks(*problem_, plain_, inflation_);
  if (mirrored.empty()) return;
  std::vector<std::string> rest;
  for (Index n = 0; n < problem_->landmarks(); ++n) {
    if (std::ranges::find(mirrored, n) != mirrored.end())
      fit.parts.push_back({named(n)});
    else if (is_placed_[static_cast<std::size_t>(n)])
      rest.push_back(named(n));
  }
  if (!rest.empty()) fit.parts.push_back(std::move(rest));
}

void LogTester::judge(LogFit& result) {
  Fit& fit = result.fit;
  const double middle_s = 0.5 * (odometry_.time_s(0) + odometry_.time_s(odometry_.size() - 1));
  halves_ = fits_of_parts(middle_s, middle_s);
  try_offsets();
  try_times();
  try_moves();
  try_exchanges();
  try_frozen();
  for (const TriedHypothesis& one : tried_) {
    FitTest test{.code = one.hypothesis.code,
                 .statistic = one.statistic,
                 .bound = rule_of(one.hypothesis.code).bound};
    for (const Index n : one.hypothesis.landmarks) test.landmarks.push_back(named(n));
    fit.tests.push_back(std::move(test));
  }
  add_limits(problem_->scores(plain_, {}), fit.tests);
  take_best(result);
  judge_gaps(fit);
  judge_known(fit);
  for (FitTest& test : residual_tests(log_, *problem_, plain_, inflation_)) {
    if (test.exceeds() && fit.causes.empty())
      fit.causes.push_back(
          {.code = test.code,
           .landmarks = test.landmarks,
           .values = test.code == FitCode::kOdometryResiduals
                         ? std::vector<FitValue>{{.id = "share_percent", .value = test.statistic}}
                         : std::vector<FitValue>{},
           .statistic = test.statistic,
           .bound = test.bound,
           .is_small = test.statistic < 3.0 * test.bound});
    fit.tests.push_back(std::move(test));
  }
  std::ranges::stable_sort(fit.tests, {}, &FitTest::code);
  find_open_parts(fit);
  const bool is_large =
      std::ranges::any_of(fit.causes, [](const FitCause& cause) { return !cause.is_small; });
  fit.verdict = is_large              ? FitVerdict::kDoesNotFit
                : !fit.parts.empty()  ? FitVerdict::kUndetermined
                : !fit.causes.empty() ? FitVerdict::kDoubtful
                                      : FitVerdict::kFits;
}

SlamEstimate LogTester::estimate_of(const LogProblem& problem, const LogProblem::Fit& fit) const {
  SlamEstimate estimate;
  estimate.path = problem.path_of(fit.state.poses);
  estimate.landmarks_m = Points::Constant(problem.landmarks(), 2, kNaN);
  for (Index n = 0; n < problem.landmarks(); ++n)
    if (is_placed_[static_cast<std::size_t>(n)])
      estimate.landmarks_m.row(n) = fit.state.landmarks[static_cast<std::size_t>(n)].transpose();
  estimate.range_scale = fit.state.scale;
  estimate.iterations = fit.iterations;
  estimate.cost = 0.5 * fit.cost;
  estimate.range_offsets_m = fit.state.offsets_m;
  report_unplaced(log_, is_placed_, estimate.statuses);
  if (!fit.has_converged)
    estimate.statuses.push_back(status_of<StatusReason::kLeastSquaresNotConverged>(fit.iterations));
  const LogProblem::Covariances map = problem.covariances(fit);
  if (!map.is_determined) {
    estimate.statuses.push_back(status_of<StatusReason::kNoCovariances>());
    return estimate;
  }
  if (map.are_of_first_pose)
    estimate.statuses.push_back(status_of<StatusReason::kCovariancesOfFirstPose>());
  // Where ranges and odometry do not agree on the scale, that of odometry is uncertain.
  const bool agrees =
      std::abs(fit.state.scale - 1.0) < std::max(kAgreeingScale, 3.0 * map.scale_sigma);
  const double scale = agrees ? 0.0 : options_.odometry_scale_sigma;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double count = 0.0;
  for (Index n = 0; n < problem.landmarks(); ++n)
    if (is_placed_[static_cast<std::size_t>(n)]) {
      middle += fit.state.landmarks[static_cast<std::size_t>(n)];
      count += 1.0;
    }
  middle /= std::max(count, 1.0);
  const auto with_scale = [&](const Eigen::Matrix2d& C, const Eigen::Vector2d& position) {
    const Eigen::Vector2d way = scale * (position - middle);
    return Eigen::Matrix2d(C + way * way.transpose());
  };
  for (Index n = 0; n < problem.landmarks(); ++n) {
    const auto at = static_cast<std::size_t>(n);
    estimate.landmark_cov_m2.push_back(with_scale(map.landmarks[at], fit.state.landmarks[at]));
  }
  const std::vector<Index>& rows = problem.keys().rows();
  for (const Index key : spread_rows(std::ssize(rows), options_.covariances)) {
    const auto at = static_cast<std::size_t>(key);
    estimate.position_cov_rows.push_back(rows[at]);
    estimate.position_cov_m2.push_back(
        with_scale(map.positions[at], fit.state.poses[at].head<2>()));
  }
  return estimate;
}

/// The map with all of its noise: offsets of landmarks, and ranges that hang together in time.
void LogTester::finish(LogFit& result) const {
  const LogProblem problem = make_problem(options_.final_keys, gaps_);
  LogState state = plain_.state;
  state.poses = problem.poses_of(problem_->path_of(plain_.state.poses));
  LogNoise noise = plain_.noise;
  noise.range_information = 1.0 / inflation_;
  noise.offset_m = 0.2 * noise.range_m;
  const LogProblem::Fit fit = problem.fit({}, state, noise, {.rounds = 8, .tolerance = 0.05});
  result.estimate = estimate_of(problem, fit.is_usable ? fit : plain_);
  result.noise = fit.is_usable ? fit.noise : plain_.noise;
}

LogFit LogTester::run(const std::vector<SlamEstimate>& starts) {
  LogFit result;
  result.fit.verdict = FitVerdict::kNotTestable;
  problem_.emplace(make_problem(options_.test_keys, gaps_));
  plain_ = fit_plain(*problem_, starts);
  if (!plain_.is_usable) {
    result.fit.why.push_back(FitMissing::kMap);
    return result;
  }
  improve_plain();
  result.noise = plain_.noise;
  result.cost = plain_.cost;
  inflation_ = inflation_of(*problem_, plain_);
  result.inflation = inflation_;
  double squares = 0.0, count = 0.0;
  for (std::size_t i = 0; i < problem_->ranges().size(); ++i) {
    const LogProblem::Range& range = problem_->ranges()[i];
    if (range.in_gap) continue;
    const auto row = static_cast<Index>(i);
    result.ranges.push_back({.time_s = range.time_s,
                             .landmark = range.landmark,
                             .range_m = range.range_m,
                             .normalised = plain_.normalised(row),
                             .inlier = plain_.inlier(row)});
    squares += plain_.inlier(row) * plain_.normalised(row) * plain_.normalised(row);
    count += plain_.inlier(row);
  }
  if (!is_redundant()) {
    result.fit.why.push_back(FitMissing::kRedundancy);
  } else {
    judge(result);
  }
  result.fit.numbers = {{"fit_chi2_ratio", count > 0.0 ? squares / count : kNaN},
                        {"fit_outliers_percent", 100.0 * plain_.noise.outlier_share},
                        {"fit_range_sigma_m", plain_.noise.range_m},
                        {"fit_forward_sigma_m", plain_.noise.way_m},
                        {"fit_heading_change_sigma_rad", plain_.noise.heading_per_metre}};
  if (!options_.only_tests) finish(result);
  return result;
}

}  // namespace

LogFit fit_log(const RangeLog& log, const std::vector<SlamEstimate>& starts,
               const LogFitOptions& options) {
  check_ranges(log.ranges, std::ssize(log.landmarks));
  if (log.odometry.size() < 2 || log.ranges.empty()) {
    LogFit none;
    none.fit.why.push_back(log.odometry.size() < 2 ? FitMissing::kOdometry
                                                   : FitMissing::kRedundancy);
    return none;
  }
  return LogTester(log, options).run(starts);
}

}  // namespace mapproof
