#include "core/range_slam/fit/log_tester.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "core/range_slam/factors/windowed_ranges.hpp"
#include "core/range_slam/fit/log_fit.hpp"
#include "core/range_slam/trilateration.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

constexpr int kJumpTimes = 20;         ///< Times at which a jump of the clock is tried.
constexpr int kMoveTimes = 9;          ///< Likewise of a move, among a landmark's ranges.
constexpr std::size_t kMostTried = 3;  ///< Hypotheses of one code that are fitted.
constexpr int kMostTimeRounds = 4;     ///< Estimates of a hypothesis's time, in turn with its fit.
/// A clock jumped only if so many ranges are before and after, and if a clock that is late
/// throughout explains less than this share of it.
constexpr double kLeastSide = 0.08;
constexpr double kLateShare = 0.85;

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

}  // namespace

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
        .hypothesis =
            LogHypothesis{.code = FitCode::kOdometryFrozen, .from_s = run.from_s, .to_s = run.to_s},
        .fit = std::move(free),
        .statistic = 0.0};
    one.statistic = statistic_of(with, plain.cost, one.fit);
    tried_.push_back(std::move(one));
  }
}

}  // namespace mapproof
