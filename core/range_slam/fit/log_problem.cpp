#include "core/range_slam/fit/log_problem.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/range_slam/refinement/free_of_frame.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

/// Errors of a motion between key poses are at least these shares of the mean way between them, and
/// of a radian: a robot that stands still is not known better.
constexpr double kLeastWayShare = 1e-3;
constexpr double kLeastTurn = 1e-4;
/// Bounds of what one estimate may change of a standard deviation, as a factor of the variance.
constexpr double kMostGrowth = 8.0;
constexpr double kLeastShare = 1e-4;  ///< Of outliers.
constexpr double kMostShare = 0.6;
/// Errors of odometry that a fit begins with: of its end, as a share of the way, and of its
/// heading.
constexpr double kFirstWayError = 0.005;
constexpr double kFirstTurnError = 0.3;
/// What is known of the offsets of landmarks before the log is: their standard deviation as a share
/// of a range's, and the number of landmarks for which it counts. From a few landmarks alone the
/// estimate is often 0. Over 100 simulated drives each (docs/methods/measurements.md), 95 %
/// ellipses hold 95.7, 94.5 and 91.4 % with offsets of 0, 0.1 and 0.2 m; without this 93.2, 90.8
/// and 84.7 %.
constexpr double kOffsetPrior = 0.5;
constexpr double kOffsetPriorWeight = 1.0;
constexpr double kNoDirection = 1e-9;
constexpr double kTwoPi = 6.283185307179586;

Eigen::Vector3d row_of(const Trajectory& path, Index row) {
  return {path.positions_m(row, 0), path.positions_m(row, 1), path.heading_rad(row)};
}

Eigen::Vector2d across(const Eigen::Vector2d& v) { return {-v(1), v(0)}; }

/// Keys at about equal ways, and at the breaks.
double spacing_for(const Trajectory& path, Index most_keys) {
  double way_m = 0.0;
  for (Index row = 1; row < path.size(); ++row)
    way_m += (path.positions_m.row(row) - path.positions_m.row(row - 1)).norm();
  return path.size() <= most_keys ? 0.0 : way_m / static_cast<double>(most_keys);
}

/// -2 ln of the density of a range, and the probability that it is not an outlier.
struct Mixture {
  double cost;
  double inlier;
};

Mixture mixture_of(double residual_m, double sigma_m, double share, double width_m) {
  const double z = residual_m / sigma_m;
  const double ratio = share / (1.0 - share) * std::sqrt(kTwoPi) * sigma_m / width_m;
  const double gauss = std::exp(-0.5 * z * z);
  const double whole = gauss + ratio;
  return {
      .cost = -2.0 * (std::log(whole) + std::log1p(-share) - std::log(sigma_m)) + std::log(kTwoPi),
      .inlier = gauss / whole};
}

bool is_between(double time_s, const LogHypothesis& h) {
  return time_s >= h.from_s && time_s < h.to_s;
}

/// The motion from one pose to the next less the measured one, and its slopes.
struct MotionError {
  Eigen::Vector3d error;
  Eigen::Matrix3d first, second;
};

MotionError error_of(const Eigen::Vector3d& step, const Eigen::Vector3d& first,
                     const Eigen::Vector3d& second) {
  MotionError m;
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(-first(2)).toRotationMatrix();
  const Eigen::Vector2d seen = R * (second.head<2>() - first.head<2>());
  m.error.head<2>() = seen - step.head<2>();
  m.error(2) = second(2) - first(2) - step(2);
  m.first.setZero();
  m.first.topLeftCorner<2, 2>() = -R;
  m.first.topRightCorner<2, 1>() = -across(seen);
  m.first(2, 2) = -1.0;
  m.second.setIdentity();
  m.second.topLeftCorner<2, 2>() = R;
  return m;
}

/// Of the way, and of the heading per metre and per radian.
Eigen::Array3d variances_of(const LogNoise& noise) {
  return {noise.way_m * noise.way_m, noise.heading_per_metre * noise.heading_per_metre,
          noise.heading_per_radian * noise.heading_per_radian};
}

}  // namespace

/// Where the shared numbers stand; -1: held.
struct LogProblem::Columns {
  std::vector<Index> landmarks;
  Index scale = -1, offset = -1, shift = -1, offsets = -1;
  Index count = 0;
};

/// A range under a hypothesis: its residual (prediction less range) and slopes.
struct LogProblem::Term {
  Index before = 0;
  Index landmark = 0;
  double residual_m = 0.0;
  Eigen::RowVector3d first, second;
  Eigen::RowVector2d position;  ///< Of the landmark.
  double distance_m = 0.0;
  bool has_offset = false, has_shift = false;
};

LogProblem::LogProblem(const RangeLog& log, const Trajectory& odometry,
                       const std::vector<bool>& is_placed, const std::vector<OdometryGap>& gaps,
                       const LogProblemOptions& options)
    : log_(&log),
      keys_(odometry, OdometryNoise{}, spacing_for(odometry, options.most_keys), options.breaks_s),
      landmarks_(std::ssize(log.landmarks)),
      is_placed_(is_placed),
      outlier_width_m_(options.outlier_width_m),
      given_(options.given) {
  const std::vector<Index>& rows = keys_.rows();
  for (std::size_t i = 1; i < rows.size(); ++i)
    motions_.push_back(motion_between(rows[i - 1], rows[i], gaps));
  double way_m = 0.0;
  for (const Motion& motion : motions_) way_m += motion.step.head<2>().norm();
  const double least = kLeastWayShare * std::max(way_m / double(motions_.size()), 1e-300);
  floor_ = Eigen::Vector3d(least * least, least * least, kLeastTurn * kLeastTurn).asDiagonal();
  const Eigen::VectorXd& times = odometry.time_s;
  step_s_ = (times(times.size() - 1) - times(0)) / static_cast<double>(times.size() - 1);
  double longest_m = 0.0;
  for (std::size_t i = 0; i < log.ranges.size(); ++i) {
    const RangeMeasurement& measured = log.ranges[i];
    longest_m = std::max(longest_m, measured.range_m);
    if (!is_placed_[static_cast<std::size_t>(measured.landmark)] || measured.time_s < times(0) ||
        measured.time_s > times(times.size() - 1))
      continue;
    ranges_.push_back({.time_s = measured.time_s,
                       .range_m = measured.range_m,
                       .sigma_m = measured.sigma_m,
                       .landmark = measured.landmark,
                       .row = i,
                       .in_gap = std::ranges::any_of(gaps,
                                                     [&](const OdometryGap& gap) {
                                                       return measured.time_s > gap.from_s &&
                                                              measured.time_s < gap.to_s;
                                                     }),
                       .at = keys_.at(measured.time_s)});
  }
  if (!(outlier_width_m_ > 0.0)) outlier_width_m_ = std::max(longest_m, 1e-300);
}

LogProblem::Motion LogProblem::motion_between(Index first, Index last,
                                              const std::vector<OdometryGap>& gaps) const {
  const Trajectory& path = keys_.path();
  Motion motion{.step = Eigen::Vector3d::Zero(),
                .way = Eigen::Matrix3d::Zero(),
                .per_metre = Eigen::Matrix3d::Zero(),
                .per_radian = Eigen::Matrix3d::Zero(),
                .given = Eigen::Matrix3d::Zero(),
                .from_s = path.time_s(first),
                .to_s = path.time_s(last)};
  const Eigen::Vector3d origin = row_of(path, first);
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(-origin(2)).toRotationMatrix();
  for (Index row = first + 1; row <= last; ++row) {
    const Motion before = motion;
    motion.step.head<2>() = R * (row_of(path, row) - origin).head<2>();
    motion.step(2) = path.heading_rad(row) - origin(2);
    const Eigen::Vector2d way = (motion.step - before.step).head<2>();
    Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
    F.topRightCorner<2, 1>() = across(way);
    for (Eigen::Matrix3d* P : {&motion.way, &motion.per_metre, &motion.per_radian, &motion.given})
      *P = (F * *P * F.transpose()).eval();
    const double distance = way.norm();
    const auto& own = log_->odometry[static_cast<std::size_t>(row - 1)].sigmas;
    if (own) {
      const Eigen::Matrix2d G = Eigen::Rotation2Dd(before.step(2)).toRotationMatrix();
      motion.given.topLeftCorner<2, 2>() +=
          G * own->head<2>().array().square().matrix().asDiagonal() * G.transpose();
      motion.given(2, 2) += (*own)(2) * (*own)(2);
    } else {
      motion.way(0, 0) += distance;
      motion.way(1, 1) += distance;
      motion.per_metre(2, 2) += distance;
      motion.per_radian(2, 2) += std::abs(motion.step(2) - before.step(2));
    }
    for (const OdometryGap& gap : gaps) {
      // The share of the gap within this motion.
      const double share =
          (std::min(gap.to_s, path.time_s(row)) - std::max(gap.from_s, path.time_s(row - 1))) /
          (gap.to_s - gap.from_s);
      if (!(share > 0.0)) continue;
      motion.given(0, 0) += share * gap.way_sigma_m * gap.way_sigma_m;
      motion.given(1, 1) += share * gap.way_sigma_m * gap.way_sigma_m;
      motion.given(2, 2) += share * gap.heading_change_sigma_rad * gap.heading_change_sigma_rad;
    }
  }
  return motion;
}

Eigen::Matrix3d LogProblem::motion_covariance(const Motion& motion, const LogNoise& noise) const {
  return noise.way_m * noise.way_m * motion.way +
         noise.heading_per_metre * noise.heading_per_metre * motion.per_metre +
         noise.heading_per_radian * noise.heading_per_radian * motion.per_radian + motion.given +
         floor_;
}

std::vector<Eigen::Vector3d> LogProblem::poses_of(const Trajectory& path) const {
  std::vector<Eigen::Vector3d> poses;
  for (const Index row : keys_.rows()) poses.push_back(row_of(path, row));
  return poses;
}

Trajectory LogProblem::path_of(const std::vector<Eigen::Vector3d>& poses) const {
  Trajectory path = keys_.path();
  for (Index row = 0; row < path.size(); ++row) {
    const BetweenPoses at = keys_.at(path.time_s(row));
    const auto before = static_cast<std::size_t>(at.before);
    const Eigen::Vector3d pose = at.pose(poses[before], poses[before + 1]);
    path.positions_m.row(row) = pose.head<2>().transpose();
    path.heading_rad(row) = pose(2);
  }
  return path;
}

LogProblem::Columns LogProblem::columns_of(const LogHypothesis& hypothesis,
                                           const LogNoise& noise) const {
  Columns columns;
  for (Index n = 0; n < landmarks_; ++n) {
    const bool is_free = is_placed_[static_cast<std::size_t>(n)];
    columns.landmarks.push_back(is_free ? columns.count : -1);
    if (is_free) columns.count += 2;
  }
  if (hypothesis.code == FitCode::kLandmarkMoved) {
    columns.landmarks.push_back(columns.count);
    columns.count += 2;
  }
  columns.scale = columns.count++;
  if (hypothesis.code == FitCode::kCommonOffset || hypothesis.code == FitCode::kLandmarkOffset)
    columns.offset = columns.count++;
  if (hypothesis.code == FitCode::kTimeOffset || hypothesis.code == FitCode::kClockJump)
    columns.shift = columns.count++;
  if (noise.offset_m > 0.0) {
    columns.offsets = columns.count;
    columns.count += landmarks_;
  }
  return columns;
}

double LogProblem::sigma_of(const Range& range, const LogNoise& noise) const {
  return range.sigma_m > 0.0 ? range.sigma_m : noise.range_m;
}

/// A state with the rotations of its poses, of which each serves many ranges.
struct LogProblem::Turned {
  explicit Turned(const LogState& of) : state(of) {
    rotations.reserve(of.poses.size());
    for (const Eigen::Vector3d& pose : of.poses)
      rotations.push_back(Eigen::Rotation2Dd(pose(2)).toRotationMatrix());
  }

  /// As the pose before, and as the pose after give it, relative to their own positions.
  std::pair<Eigen::Vector2d, Eigen::Vector2d> ways_to(const BetweenPoses& at) const {
    const auto before = static_cast<std::size_t>(at.before);
    return {rotations[before] * at.ahead.head<2>(), rotations[before + 1] * at.behind.head<2>()};
  }
  Eigen::Vector2d position(const BetweenPoses& at) const { return position(at, ways_to(at)); }
  /// @param ways  From ways_to().
  Eigen::Vector2d position(const BetweenPoses& at,
                           const std::pair<Eigen::Vector2d, Eigen::Vector2d>& ways) const {
    const auto before = static_cast<std::size_t>(at.before);
    const auto& [from_first, from_second] = ways;
    return (1.0 - at.share) * (state.poses[before].head<2>() + from_first) +
           at.share * (state.poses[before + 1].head<2>() + from_second);
  }

  const LogState& state;
  std::vector<Eigen::Matrix2d> rotations;
};

LogProblem::Term LogProblem::term_of(const Range& range, const LogHypothesis& hypothesis,
                                     const Turned& turned) const {
  const LogState& state = turned.state;
  Term term;
  term.landmark = range.landmark;
  const bool applies = is_between(range.time_s, hypothesis);
  const bool has_landmark =
      !hypothesis.landmarks.empty() &&
      (range.landmark == hypothesis.landmarks[0] ||
       (hypothesis.landmarks.size() > 1 && range.landmark == hypothesis.landmarks[1]));
  if (applies && has_landmark && hypothesis.code == FitCode::kIdsExchanged)
    term.landmark = range.landmark == hypothesis.landmarks[0] ? hypothesis.landmarks[1]
                                                              : hypothesis.landmarks[0];
  if (applies && has_landmark && hypothesis.code == FitCode::kLandmarkMoved)
    term.landmark = landmarks_;
  term.has_offset = hypothesis.code == FitCode::kCommonOffset ||
                    (hypothesis.code == FitCode::kLandmarkOffset && has_landmark);
  term.has_shift = applies && (hypothesis.code == FitCode::kTimeOffset ||
                               hypothesis.code == FitCode::kClockJump);
  const BetweenPoses moved =
      term.has_shift ? keys_.at(range.time_s - state.shift_s) : BetweenPoses{};
  const BetweenPoses& at = term.has_shift ? moved : range.at;
  const auto ways = turned.ways_to(at);
  const auto& [from_first, from_second] = ways;
  const Eigen::Vector2d position = turned.position(at, ways);
  const Eigen::Vector2d gap = position - state.landmarks[static_cast<std::size_t>(term.landmark)];
  term.before = at.before;
  term.distance_m = gap.norm();
  const Eigen::Vector2d slope = term.distance_m > kNoDirection
                                    ? Eigen::Vector2d(state.scale / term.distance_m * gap)
                                    : Eigen::Vector2d::Zero();
  term.residual_m =
      state.scale * term.distance_m + (term.has_offset ? state.offset_m : 0.0) - range.range_m;
  if (state.offsets_m.size() > 0) term.residual_m += state.offsets_m(range.landmark);
  term.first << (1.0 - at.share) * slope.transpose(),
      (1.0 - at.share) * slope.dot(across(from_first));
  term.second << at.share * slope.transpose(), at.share * slope.dot(across(from_second));
  term.position = -slope.transpose();
  return term;
}

double LogProblem::slope_in_time(const Range& range, const Term& term, const Turned& turned) const {
  const double time_s = range.time_s - (term.has_shift ? turned.state.shift_s : 0.0);
  const Eigen::VectorXd& times = keys_.path().time_s;
  const double low = std::max(time_s - step_s_, times(0));
  const double high = std::min(time_s + step_s_, times(times.size() - 1));
  if (!(high > low)) return 0.0;
  const Eigen::Vector2d speed =
      (turned.position(keys_.at(high)) - turned.position(keys_.at(low))) / (high - low);
  return term.position.dot(speed);  // The slope in the position is that in the landmark, negated.
}

double LogProblem::cost_of(const LogHypothesis& hypothesis, const LogState& state,
                           const LogNoise& noise) const {
  double cost = 0.0;
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const MotionError m = error_of(motions_[i].step, state.poses[i], state.poses[i + 1]);
    const Eigen::LLT<Eigen::Matrix3d> llt(motion_covariance(motions_[i], noise));
    cost += llt.matrixL().solve(m.error).squaredNorm();
    cost += 2.0 * Eigen::Matrix3d(llt.matrixL()).diagonal().array().log().sum();
  }
  const Turned turned(state);
  for (const Range& range : ranges_) {
    if (range.in_gap) continue;
    const Term term = term_of(range, hypothesis, turned);
    cost += noise.range_information * mixture_of(term.residual_m, sigma_of(range, noise),
                                                 noise.outlier_share, outlier_width_m_)
                                          .cost;
  }
  if (noise.offset_m > 0.0)
    cost += state.offsets_m.squaredNorm() / (noise.offset_m * noise.offset_m) +
            2.0 * static_cast<double>(landmarks_) * std::log(noise.offset_m);
  return cost;
}

void LogProblem::assemble(const LogHypothesis& hypothesis, const Columns& columns,
                          const LogState& state, const LogNoise& noise, ChainSystem& system) const {
  system.clear();
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const MotionError m = error_of(motions_[i].step, state.poses[i], state.poses[i + 1]);
    const Eigen::LLT<Eigen::Matrix3d> llt(motion_covariance(motions_[i], noise));
    const Eigen::Matrix3d W = llt.matrixL().solve(Eigen::Matrix3d::Identity());
    system.add_motion(static_cast<Index>(i) - 1, W * m.first, W * m.second, W * m.error);
  }
  std::vector<ChainSystem::Slope> slopes;
  const Turned turned(state);
  for (const Range& range : ranges_) {
    if (range.in_gap) continue;
    const Term term = term_of(range, hypothesis, turned);
    const double sigma = sigma_of(range, noise);
    const Mixture mixture =
        mixture_of(term.residual_m, sigma, noise.outlier_share, outlier_width_m_);
    const double weight = std::sqrt(mixture.inlier * noise.range_information) / sigma;
    slopes.clear();
    const Index column = columns.landmarks[static_cast<std::size_t>(term.landmark)];
    slopes.push_back({column, weight * term.position(0)});
    slopes.push_back({column + 1, weight * term.position(1)});
    slopes.push_back({columns.scale, weight * term.distance_m});
    if (columns.offset >= 0 && term.has_offset) slopes.push_back({columns.offset, weight});
    if (columns.shift >= 0 && term.has_shift)
      slopes.push_back({columns.shift, weight * slope_in_time(range, term, turned)});
    if (columns.offsets >= 0) slopes.push_back({columns.offsets + range.landmark, weight});
    system.add_range(term.before - 1, weight * term.first, weight * term.second, slopes,
                     weight * term.residual_m);
  }
  if (columns.offsets >= 0)
    for (Index n = 0; n < landmarks_; ++n)
      system.add_prior(columns.offsets + n, 1.0 / noise.offset_m,
                       state.offsets_m(n) / noise.offset_m);
}

LogState LogProblem::moved(const LogState& state, const Columns& columns,
                           const ChainSystem::Solution& step) const {
  LogState next = state;
  for (std::size_t i = 1; i < next.poses.size(); ++i)
    next.poses[i] += step.poses.col(static_cast<Index>(i) - 1);
  for (std::size_t n = 0; n < columns.landmarks.size(); ++n)
    if (const Index column = columns.landmarks[n]; column >= 0)
      next.landmarks[n] += step.shared.segment<2>(column);
  next.scale += step.shared(columns.scale);
  if (columns.offset >= 0) next.offset_m += step.shared(columns.offset);
  if (columns.shift >= 0) next.shift_s += step.shared(columns.shift);
  if (columns.offsets >= 0) next.offsets_m += step.shared.segment(columns.offsets, landmarks_);
  return next;
}

/// A state with the covariance of its solution.
struct LogProblem::Solved {
  const LogHypothesis& hypothesis;
  const Columns& columns;
  const Turned& turned;
  const LogNoise& noise;
  const ChainSystem::Covariance& covariance;
};

/// Of each part of the noise: its share in the squared errors, and in what they should be.
struct LogProblem::ErrorSums {
  Eigen::Array3d seen = Eigen::Array3d::Zero(), due = Eigen::Array3d::Zero();  ///< Of motions.
  double squares = 0.0, freedom = 0.0;                                         ///< Of ranges.
  double outliers = 0.5, count = 1.0;
};

void LogProblem::add_motion_errors(const Solved& solved, ErrorSums& sums) const {
  const auto pose_at = [&](Index i) -> Eigen::Matrix3d {
    return i < 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Zero())
                 : solved.covariance.poses[static_cast<std::size_t>(i)];
  };
  const Eigen::Array3d weight = variances_of(solved.noise);
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const Motion& motion = motions_[i];
    const MotionError m =
        error_of(motion.step, solved.turned.state.poses[i], solved.turned.state.poses[i + 1]);
    const Index first = static_cast<Index>(i) - 1;
    Eigen::Matrix3d error = m.second * pose_at(first + 1) * m.second.transpose();
    if (first >= 0) {
      const Eigen::Matrix3d cross =
          m.first * solved.covariance.next[static_cast<std::size_t>(first)] * m.second.transpose();
      error += m.first * pose_at(first) * m.first.transpose() + cross + cross.transpose();
    }
    const Eigen::Matrix3d W = motion_covariance(motion, solved.noise).inverse();
    const Eigen::Vector3d We = W * m.error;
    const Eigen::Matrix3d* parts[] = {&motion.way, &motion.per_metre, &motion.per_radian};
    for (int k = 0; k < 3; ++k) {
      const Eigen::Matrix3d WP = W * *parts[k];
      sums.seen(k) += weight(k) * We.dot(*parts[k] * We);
      sums.due(k) += weight(k) * (WP.trace() - (WP * W * error).trace());
    }
  }
}

double LogProblem::prediction_variance(const Solved& solved, const Range& range,
                                       const Term& term) const {
  const Columns& columns = solved.columns;
  const ChainSystem::Covariance& covariance = solved.covariance;
  const Index first = term.before - 1;
  Eigen::VectorXd shared = Eigen::VectorXd::Zero(columns.count);
  const Index column = columns.landmarks[static_cast<std::size_t>(term.landmark)];
  shared.segment<2>(column) = term.position.transpose();
  shared(columns.scale) = term.distance_m;
  if (columns.offset >= 0 && term.has_offset) shared(columns.offset) = 1.0;
  if (columns.shift >= 0 && term.has_shift)
    shared(columns.shift) = slope_in_time(range, term, solved.turned);
  if (columns.offsets >= 0) shared(columns.offsets + range.landmark) = 1.0;
  double variance = shared.dot(covariance.shared * shared);
  const auto second = static_cast<std::size_t>(first + 1);
  variance += term.second * covariance.poses[second] * term.second.transpose();
  variance += 2.0 * shared.dot(covariance.shared_pose[second] * term.second.transpose());
  if (first >= 0) {
    const auto at = static_cast<std::size_t>(first);
    variance += term.first * covariance.poses[at] * term.first.transpose();
    variance += 2.0 * term.first.dot(covariance.next[at] * term.second.transpose());
    variance += 2.0 * shared.dot(covariance.shared_pose[at] * term.first.transpose());
  }
  return variance;
}

void LogProblem::add_range_errors(const Solved& solved, ErrorSums& sums) const {
  const LogNoise& noise = solved.noise;
  for (const Range& range : ranges_) {
    if (range.in_gap) continue;
    const Term term = term_of(range, solved.hypothesis, solved.turned);
    const double sigma = sigma_of(range, noise);
    const Mixture mixture =
        mixture_of(term.residual_m, sigma, noise.outlier_share, outlier_width_m_);
    sums.outliers += 1.0 - mixture.inlier;
    sums.count += 1.0;
    if (range.sigma_m > 0.0) continue;
    const double variance = prediction_variance(solved, range, term);
    const double leverage = mixture.inlier * noise.range_information * variance / (sigma * sigma);
    sums.squares += mixture.inlier * term.residual_m * term.residual_m;
    sums.freedom += mixture.inlier * std::max(1e-3, 1.0 - leverage);
  }
}

bool LogProblem::update_noise(const LogHypothesis& hypothesis, const Columns& columns,
                              const LogState& state, const ChainSystem& system,
                              LogNoise& noise) const {
  const auto covariance = system.covariance();
  if (!covariance) return false;
  ErrorSums sums;
  const Turned turned(state);
  const Solved solved{hypothesis, columns, turned, noise, *covariance};
  add_motion_errors(solved, sums);
  add_range_errors(solved, sums);
  const auto grown = [](double sigma, double factor) {
    return sigma * std::sqrt(std::clamp(factor, 1.0 / kMostGrowth, kMostGrowth));
  };
  const Eigen::Array3d weight = variances_of(noise);
  double* sigmas[] = {&noise.way_m, &noise.heading_per_metre, &noise.heading_per_radian};
  for (int k = 0; k < 3; ++k)
    if (sums.due(k) > 0.0 && weight(k) > 0.0 && !given_[static_cast<std::size_t>(k)])
      *sigmas[k] = grown(*sigmas[k], sums.seen(k) / sums.due(k));
  if (sums.freedom > 1.0 && !given_[3])
    noise.range_m =
        grown(noise.range_m, sums.squares / sums.freedom / (noise.range_m * noise.range_m));
  noise.outlier_share = std::clamp(sums.outliers / sums.count, kLeastShare, kMostShare);
  if (columns.offsets >= 0) {
    const double trace = covariance->shared.diagonal().segment(columns.offsets, landmarks_).sum();
    const double free = static_cast<double>(landmarks_) - trace / (noise.offset_m * noise.offset_m);
    const double prior_m = kOffsetPrior * noise.range_m;
    const double variance =
        (state.offsets_m.squaredNorm() + kOffsetPriorWeight * prior_m * prior_m) /
        (std::max(free, 0.0) + kOffsetPriorWeight);
    noise.offset_m = grown(noise.offset_m, variance / (noise.offset_m * noise.offset_m));
  }
  return true;
}

double LogProblem::descend(const LogHypothesis& hypothesis, const Effort& effort,
                           ChainSystem& system, Fit& fit, double& damping) const {
  const Columns columns = columns_of(hypothesis, fit.noise);
  double cost = cost_of(hypothesis, fit.state, fit.noise);
  for (int step = 0; step < effort.steps; ++step) {
    assemble(hypothesis, columns, fit.state, fit.noise, system);
    ++fit.iterations;
    const double old = cost;
    // Damped until the cost falls.
    const auto takes_step = [&] {
      const auto solution = system.solve(damping);
      if (!solution) return false;
      LogState next = moved(fit.state, columns, *solution);
      const double reached = next.scale > 0.0 ? cost_of(hypothesis, next, fit.noise) : kInfinity;
      if (!(reached <= cost + 1e-9 * std::abs(cost))) return false;
      fit.state = std::move(next);
      cost = reached;
      damping = std::max(1e-9, 0.2 * damping);
      return true;
    };
    for (int attempt = 0; attempt < 8 && !takes_step(); ++attempt)
      damping = std::min(1e6, 6.0 * damping);
    if (!(old - cost > 0.1 * effort.tolerance)) break;
  }
  return cost;
}

void LogProblem::take_residuals(const LogHypothesis& hypothesis, Fit& fit) const {
  const Index count = std::ssize(ranges_);
  fit.normalised = Eigen::VectorXd::Zero(count);
  fit.inlier = Eigen::VectorXd::Zero(count);
  const Turned turned(fit.state);
  for (Index i = 0; i < count; ++i) {
    const Range& range = ranges_[static_cast<std::size_t>(i)];
    if (range.in_gap) continue;
    const Term term = term_of(range, hypothesis, turned);
    const double sigma = sigma_of(range, fit.noise);
    fit.normalised(i) = term.residual_m / sigma;
    fit.inlier(i) =
        mixture_of(term.residual_m, sigma, fit.noise.outlier_share, outlier_width_m_).inlier;
  }
}

LogProblem::Fit LogProblem::fit(const LogHypothesis& hypothesis, LogState start, LogNoise noise,
                                const Effort& effort) const {
  if (noise.offset_m > 0.0 && start.offsets_m.size() == 0)
    start.offsets_m = Eigen::VectorXd::Zero(landmarks_);
  const Columns columns = columns_of(hypothesis, noise);
  ChainSystem system(std::ssize(keys_.rows()) - 1, columns.count);
  Fit fit{.state = std::move(start), .noise = noise};
  double damping = 1e-4;
  double before = kInfinity;
  for (int round = 0; round < effort.rounds; ++round) {
    const double cost = descend(hypothesis, effort, system, fit, damping);
    assemble(hypothesis, columns, fit.state, fit.noise, system);
    const auto solution = system.solve();
    if (!solution) break;
    fit.is_usable = true;
    fit.cost = cost + solution->log_determinant;
    fit.has_converged = std::abs(before - fit.cost) < effort.tolerance;
    if (!effort.estimates_noise || fit.has_converged) break;
    before = fit.cost;
    if (!update_noise(hypothesis, columns, fit.state, system, fit.noise)) break;
  }
  take_residuals(hypothesis, fit);
  return fit;
}

Eigen::VectorXd LogProblem::range_costs(const LogHypothesis& hypothesis, const Fit& fit) const {
  Eigen::VectorXd costs = Eigen::VectorXd::Zero(std::ssize(ranges_));
  const Turned turned(fit.state);
  for (Index i = 0; i < costs.size(); ++i) {
    const Range& range = ranges_[static_cast<std::size_t>(i)];
    if (range.in_gap) continue;
    costs(i) = mixture_of(term_of(range, hypothesis, turned).residual_m, sigma_of(range, fit.noise),
                          fit.noise.outlier_share, outlier_width_m_)
                   .cost;
  }
  return costs;
}

LogNoise LogProblem::first_noise(const LogState& start) const {
  LogNoise noise;
  double way_m = 0.0, turn = 0.0;
  for (const Motion& motion : motions_) {
    way_m += motion.step.head<2>().norm();
    turn += motion.per_radian(2, 2);
  }
  way_m = std::max(way_m, 1e-300);
  noise.way_m = kFirstWayError * std::sqrt(way_m);
  noise.heading_per_metre = kFirstTurnError / std::sqrt(way_m);
  noise.heading_per_radian = kFirstTurnError / std::sqrt(std::max(turn, 1.0));
  std::vector<double> sizes;
  const Turned turned(start);
  for (const Range& range : ranges_)
    if (!range.in_gap)
      sizes.push_back(std::abs(term_of(range, LogHypothesis{}, turned).residual_m));
  const double typical = sizes.empty() ? 0.0 : median(sizes);
  noise.range_m = std::max(1.5 * typical, 1e-6 * outlier_width_m_);
  noise.outlier_share = 0.02;
  return noise;
}

ChainSystem LogProblem::score_system(const Fit& fit, const std::vector<double>& times_s) const {
  const LogHypothesis plain;
  const Columns columns = columns_of(plain, fit.noise);
  const Index jumps = std::ssize(times_s);
  ChainSystem system(std::ssize(keys_.rows()) - 1, columns.count + 2 + landmarks_ + jumps);
  // The extra columns stand behind the others, so that the elimination of the poses is one.
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const MotionError m = error_of(motions_[i].step, fit.state.poses[i], fit.state.poses[i + 1]);
    const Eigen::LLT<Eigen::Matrix3d> llt(motion_covariance(motions_[i], fit.noise));
    const Eigen::Matrix3d W = llt.matrixL().solve(Eigen::Matrix3d::Identity());
    system.add_motion(static_cast<Index>(i) - 1, W * m.first, W * m.second, W * m.error);
  }
  const Turned turned(fit.state);
  std::vector<ChainSystem::Slope> slopes;
  for (const Range& range : ranges_) {
    if (range.in_gap) continue;
    const Term term = term_of(range, plain, turned);
    const double sigma = sigma_of(range, fit.noise);
    const double weight =
        std::sqrt(
            mixture_of(term.residual_m, sigma, fit.noise.outlier_share, outlier_width_m_).inlier) /
        sigma;
    slopes.clear();
    const Index column = columns.landmarks[static_cast<std::size_t>(term.landmark)];
    slopes.push_back({column, weight * term.position(0)});
    slopes.push_back({column + 1, weight * term.position(1)});
    slopes.push_back({columns.scale, weight * term.distance_m});
    slopes.push_back({columns.count, weight});
    const double per_second = weight * slope_in_time(range, term, turned);
    slopes.push_back({columns.count + 1, per_second});
    slopes.push_back({columns.count + 2 + range.landmark, weight});
    for (Index j = 0; j < jumps; ++j)
      if (range.time_s >= times_s[static_cast<std::size_t>(j)])
        slopes.push_back({columns.count + 2 + landmarks_ + j, per_second});
    system.add_range(term.before - 1, weight * term.first, weight * term.second, slopes,
                     weight * term.residual_m);
  }
  return system;
}

LogProblem::Scores LogProblem::scores(const Fit& fit, const std::vector<double>& times_s) const {
  const Index jumps = std::ssize(times_s);
  const Index extra = 2 + landmarks_ + jumps;
  Scores scores{.landmark = Eigen::VectorXd::Zero(landmarks_),
                .landmark_sigma_m = Eigen::VectorXd::Constant(landmarks_, kInfinity),
                .jump = Eigen::VectorXd::Zero(jumps),
                .jump_sigma_s = Eigen::VectorXd::Constant(jumps, kInfinity)};
  const auto reduced = score_system(fit, times_s).reduced();
  if (!reduced) return scores;
  const Index base = columns_of(LogHypothesis(), fit.noise).count;
  const Eigen::LDLT<Eigen::MatrixXd> factor(reduced->C.topLeftCorner(base, base));
  const Eigen::MatrixXd across_base = reduced->C.topRightCorner(base, extra);
  const Eigen::MatrixXd solved = factor.solve(across_base);
  const Eigen::VectorXd g = reduced->g.tail(extra) - solved.transpose() * reduced->g.head(base);
  const auto score = [&](Index k, double& drop, double& sigma) {
    const double whole = reduced->C(base + k, base + k);
    const double information = whole - across_base.col(k).dot(solved.col(k));
    if (!(information > 1e-9 * whole)) return;
    drop = g(k) * g(k) / information;
    sigma = 1.0 / std::sqrt(information);
  };
  score(0, scores.common, scores.common_sigma_m);
  score(1, scores.shift, scores.shift_sigma_s);
  for (Index n = 0; n < landmarks_; ++n)
    score(2 + n, scores.landmark(n), scores.landmark_sigma_m(n));
  for (Index j = 0; j < jumps; ++j)
    score(2 + landmarks_ + j, scores.jump(j), scores.jump_sigma_s(j));
  return scores;
}

LogProblem::Covariances LogProblem::covariances(const Fit& fit) const {
  Covariances result;
  result.landmarks.assign(static_cast<std::size_t>(landmarks_), Eigen::Matrix2d::Constant(kNaN));
  result.all = Eigen::MatrixXd::Constant(2 * landmarks_, 2 * landmarks_, kNaN);
  const LogHypothesis plain;
  const Columns columns = columns_of(plain, fit.noise);
  ChainSystem system(std::ssize(keys_.rows()) - 1, columns.count);
  assemble(plain, columns, fit.state, fit.noise, system);
  auto covariance = system.covariance();
  if (!covariance) return result;
  covariance->poses.insert(covariance->poses.begin(), Eigen::Matrix3d::Zero());
  covariance->shared_pose.insert(covariance->shared_pose.begin(),
                                 Eigen::MatrixXd::Zero(columns.count, 3));
  result.is_determined = true;
  result.scale_sigma = std::sqrt(covariance->shared(columns.scale, columns.scale));
  result.are_of_first_pose = !free_of_frame(
      {.poses = fit.state.poses, .landmarks = fit.state.landmarks, .columns = columns.landmarks},
      covariance->shared, covariance->poses, covariance->shared_pose);
  for (Index n = 0; n < landmarks_; ++n) {
    const Index column = columns.landmarks[static_cast<std::size_t>(n)];
    if (column < 0) continue;
    result.landmarks[static_cast<std::size_t>(n)] = covariance->shared.block<2, 2>(column, column);
    for (Index k = 0; k < landmarks_; ++k)
      if (const Index other = columns.landmarks[static_cast<std::size_t>(k)]; other >= 0)
        result.all.block<2, 2>(2 * n, 2 * k) = covariance->shared.block<2, 2>(column, other);
  }
  for (const Eigen::Matrix3d& pose : covariance->poses)
    result.positions.emplace_back(pose.topLeftCorner<2, 2>());
  return result;
}

}  // namespace mapproof
