#include "core/range_slam/fit/log_tester.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/range_slam/fit/log_fit.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

/// An effect below this number of a range's sigmas hardly moves the map.
constexpr double kSmallEffect = 0.5;
/// A landmark that moved by less is only doubtful: residuals that hang together in time look alike
/// (on the logs of Plaza and Sapienza up to 1.7).
constexpr double kSmallMove = 3.0;

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

}  // namespace

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

}  // namespace mapproof
