#include "core/range_slam/fit/log_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/stopwatch.hpp"
#include "core/range_slam/dead_reckoning.hpp"
#include "core/range_slam/factors/spread_rows.hpp"
#include "core/range_slam/fit/log_tester.hpp"
#include "core/range_slam/log_checks.hpp"
#include "core/range_slam/refinement/refine_starts.hpp"
#include "core/range_slam/trilateration.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

constexpr Index kLeastRedundancy = 20;  ///< Ranges beyond the unknowns of landmarks and scale.
constexpr double kManyOutliers = 0.04;  ///< A share that asks for other starts.
/// A range scale so near 1 confirms the scale of odometry.
constexpr double kAgreeingScale = 0.002;

}  // namespace

LogTester::LogTester(const RangeLog& log, const LogFitOptions& options)
    : log_(log), options_(options), odometry_(dead_reckoned(log)), gaps_(gaps_by_stamps(log)) {
  place_landmarks();
}

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

std::array<bool, 4> LogTester::given() const {
  const GivenNoise& noise = options_.noise;
  return {noise.way_m > 0.0, noise.heading_per_metre > 0.0, noise.heading_per_radian > 0.0,
          noise.range_m > 0.0};
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
  const Stopwatch stopwatch;
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
  const double before_tests_s = stopwatch.seconds();
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
                        {"fit_heading_sigma_rad", plain_.noise.heading_per_metre}};
  const Stopwatch after_tests;
  if (!options_.only_tests) finish(result);
  result.map_s = before_tests_s + after_tests.seconds();
  return result;
}

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
