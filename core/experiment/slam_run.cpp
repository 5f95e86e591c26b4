#include "core/experiment/slam_run.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/align/path_at.hpp"
#include "core/align/rigid.hpp"
#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/random.hpp"
#include "core/base/stopwatch.hpp"
#include "core/experiment/seeds.hpp"
#include "core/range_slam/dead_reckoning.hpp"
#include "core/range_slam/ekf.hpp"
#include "core/range_slam/factors/spectral_slam.hpp"
#include "core/range_slam/factors/spread_rows.hpp"
#include "core/range_slam/factors/synchronous_slam.hpp"
#include "core/range_slam/refinement/bootstrap.hpp"
#include "core/range_slam/refinement/refine.hpp"
#include "core/range_slam/refinement/refine_starts.hpp"
#include "core/score/trajectory_error.hpp"

namespace mapproof {
namespace {

void turn(std::vector<Eigen::Matrix2d>& covariances, const Similarity& motion) {
  for (Eigen::Matrix2d& cov : covariances) {
    const Eigen::Matrix2d turned =
        motion.scale * motion.scale * motion.rotation * cov * motion.rotation.transpose();
    cov = turned;
  }
}

void move(SlamEstimate& estimate, const Similarity& motion) {
  estimate.path.positions_m = Points(motion(estimate.path.positions_m));
  estimate.landmarks_m = Points(motion(estimate.landmarks_m));
  for (double& heading : estimate.path.heading_rad) {
    const Eigen::Vector2d way =
        motion.rotation * Eigen::Vector2d(std::cos(heading), std::sin(heading));
    heading = std::atan2(way.y(), way.x());
  }
  turn(estimate.landmark_cov_m2, motion);
  turn(estimate.position_cov_m2, motion);
}

/// The first, and those that take more freedom than it.
std::vector<Alignment> alignments_from(Alignment first) {
  switch (first) {
    case Alignment::kNone:
      return {Alignment::kNone, Alignment::kRigid, Alignment::kSimilarity};
    case Alignment::kRigid:
      return {Alignment::kRigid, Alignment::kSimilarity};
    default:
      return {first};
  }
}

std::vector<double> pose_errors(const Trajectory& path, const Trajectory& ground_truth) {
  const Eigen::VectorXd errors =
      (positions_at(ground_truth, path.time_s) - path.positions_m).rowwise().norm();
  return {errors.begin(), errors.end()};
}

constexpr Eigen::Index kPosesWithCovariance = 60;  ///< As many ellipses as a figure can show.
constexpr Eigen::Index kStatesShown = 300;         ///< Of a metric upgrade.

SlamEstimate failed(const RangeLog& log, Status why) {
  SlamEstimate estimate;
  estimate.path.positions_m.resize(0, 2);
  estimate.landmarks_m = Points::Constant(static_cast<Eigen::Index>(log.landmarks.size()), 2, kNaN);
  estimate.statuses.push_back(std::move(why));
  return estimate;
}

QuadricPoints shown_of(const QuadricCloud& cloud, const std::vector<Eigen::Index>& rows) {
  const Eigen::MatrixXd symmetric = 0.5 * (cloud.Q + cloud.Q.transpose());
  return {.points = cloud.points(rows, Eigen::all), .Q = symmetric};
}

std::optional<UpgradeClouds> clouds_of(const MetricUpgrade& upgrade) {
  if (upgrade.map.empty()) return std::nullopt;
  UpgradeClouds clouds;
  clouds.steps = spread_rows(upgrade.before.points.rows(), kStatesShown);
  clouds.before = shown_of(upgrade.before, clouds.steps);
  clouds.after = shown_of(upgrade.after, clouds.steps);
  return clouds;
}

bool is_spectral(SlamMethod method) {
  return method == SlamMethod::kSpectral || method == SlamMethod::kSpectral7 ||
         method == SlamMethod::kSpectralKnown || method == SlamMethod::kSpectralKnown7;
}

KnownLandmarks without(const KnownLandmarks& known, Eigen::Index row) {
  KnownLandmarks others;
  std::vector<Eigen::Index> kept;
  for (std::size_t k = 0; k < known.rows.size(); ++k)
    if (known.rows[k] != row) {
      others.rows.push_back(known.rows[k]);
      kept.push_back(static_cast<Eigen::Index>(k));
    }
  others.positions_m = known.positions_m(kept, Eigen::all);
  return others;
}

bool is_refinement(SlamMethod method) {
  return method == SlamMethod::kRefined || method == SlamMethod::kRefinedFromOdometry ||
         method == SlamMethod::kRefinedFromRandom || method == SlamMethod::kRepaired;
}

bool has_start_pose(const StartPose& start) {
  return start.x_m != 0.0 || start.y_m != 0.0 || start.heading_rad != 0.0;
}

/// A log and what is known of it, in coordinates about a point near by: squares of coordinates far
/// from 0 would leave no digits for the map.
struct NearOrigin {
  RangeLog log;
  SlamRunOptions options;
  Eigen::RowVector2d origin_m = Eigen::RowVector2d::Zero();  ///< Of these, in those of the log.
  bool has_start = false;                                    ///< The log has a start pose.
};

void move_by(Points& positions_m, const Eigen::RowVector2d& offset_m) {
  positions_m.rowwise() += offset_m;
}

/// About the mean of the landmarks that tie a frame, else about the start.
NearOrigin near_origin(RangeLog log, const SlamRunOptions& options) {
  NearOrigin near{.log = std::move(log), .options = options};
  near.has_start = has_start_pose(near.log.start);
  if (options.known && options.known->rows.size() >= 2)
    near.origin_m = options.known->positions_m.colwise().mean();
  else
    near.origin_m << near.log.start.x_m, near.log.start.y_m;
  const Eigen::RowVector2d offset_m = -near.origin_m;
  if (near.has_start) {
    near.log.start.x_m += offset_m.x();
    near.log.start.y_m += offset_m.y();
  }
  if (near.log.ground_truth) move_by(near.log.ground_truth->positions_m, offset_m);
  if (near.log.true_landmarks) move_by(*near.log.true_landmarks, offset_m);
  if (near.options.known) move_by(near.options.known->positions_m, offset_m);
  // What the map holds where it is given would flatter it.
  if (options.ties_refinement && options.known && near.log.true_landmarks)
    for (const Eigen::Index row : options.known->rows)
      near.log.true_landmarks->row(row).setConstant(kNaN);
  if (near.options.fit && near.options.fit->known)
    move_by(near.options.fit->known->positions_m, offset_m);
  return near;
}

/// The alignment under which the error of a method on this log is reported first.
Alignment first_alignment(SlamMethod method, const NearOrigin& near) {
  const SlamMethodInfo& facts = info(method);
  if (facts.knows_landmarks) return Alignment::kNone;
  // What starts in a frame of its own cannot be compared as it is.
  if (method == SlamMethod::kDeadReckoning)
    return near.has_start ? Alignment::kNone : Alignment::kRigid;
  const bool refines = is_refinement(method) || method == SlamMethod::kBatchFixedScale;
  if (refines && near.options.ties_refinement && near.options.known) return Alignment::kNone;
  return near.log.odometry.empty() ? Alignment::kRigidWithReflection : facts.alignment;
}

bool has(const SlamEstimate& estimate, StatusCode code) {
  return std::ranges::any_of(estimate.statuses, [&](const Status& s) { return s.code == code; });
}

RefinementStart start_of(const SlamRecord& record, int number) {
  const SlamEstimate& estimate = record.estimate;
  RefinementStart start{.method = record.method,
                        .number = number,
                        .cost = estimate.cost.value_or(kNaN),
                        .mean_m = std::nullopt,
                        .iterations = estimate.iterations,
                        .converged = estimate.cost && !has(estimate, StatusCode::kNotConverged)};
  if (!record.errors.empty()) start.mean_m = record.errors.front().mean_m;
  return start;
}

/// The random starts after the first, which is a record of its own.
void add_random_starts(SlamEstimates& estimates, const NearOrigin& near, SlamRun& run) {
  const SlamMethod method = SlamMethod::kRefinedFromRandom;
  const SlamRunOptions& options = near.options;
  if (std::ranges::find(options.methods, method) == options.methods.end() ||
      near.log.odometry.empty())
    return;
  for (int number = 2; number <= options.random_starts; ++number) {
    SlamRecord record{.method = method, .estimate = {}, .errors = {}, .error_m = {}};
    try {
      record.estimate = estimates.refined_from_random(number);
    } catch (const InvalidInput&) {
      return;  // The first one has the reason.
    }
    score_against_ground_truth(record, near.log, first_alignment(method, near));
    run.starts.push_back(start_of(record, number));
  }
}

/// The path that the others are aligned to without ground truth: one in the frame of the known
/// landmarks, the refined one if it is there, else the first.
const SlamRecord* reference_path(const std::vector<SlamRecord>& records, const NearOrigin& near) {
  const SlamRecord* best = nullptr;
  const auto rank = [&](const SlamRecord& record) {
    const bool is_tied = record.method != SlamMethod::kDeadReckoning &&
                         first_alignment(record.method, near) == Alignment::kNone;
    return (is_tied ? 2 : 0) + (is_tied && record.method == SlamMethod::kRefined ? 1 : 0);
  };
  for (const SlamRecord& record : records)
    if (record.estimate.path.size() > 0 && (best == nullptr || rank(record) > rank(*best)))
      best = &record;
  return best;
}

/// Without ground truth.
void align_to_reference(std::vector<SlamRecord>& records, const NearOrigin& near) {
  const SlamRecord* reference = reference_path(records, near);
  for (SlamRecord& record : records)
    if (&record != reference && first_alignment(record.method, near) != Alignment::kNone)
      align_to(record.estimate, reference->estimate.path, near.log.odometry.empty());
}

/// The verdict on the fit, and the repaired map where it is asked for.
void take_fit(SlamEstimates& estimates, const NearOrigin& near, SlamRun& run) {
  if (!near.options.fit) return;
  const LogFit* fit = estimates.log_fit();
  if (fit == nullptr) {
    run.fit = Fit{.why = {FitMissing::kOdometry}};
    return;
  }
  run.fit = fit->fit;
  run.fitted_ranges = fit->ranges;
  if (fit->held_out) {
    run.fit->numbers.push_back({"fit_held_out_nats", fit->held_out->plain});
    run.fit->numbers.push_back({"fit_repaired_held_out_nats", fit->held_out->repaired});
  }
  if (!near.options.repairs || !fit->repaired || (fit->held_out && !fit->held_out->is_better()))
    return;
  SlamRecord record{.method = SlamMethod::kRepaired,
                    .estimate = estimates.estimate(SlamMethod::kRepaired),
                    .errors = {},
                    .error_m = {}};
  score_against_ground_truth(record, near.log, first_alignment(SlamMethod::kRefined, near));
  run.records.push_back(std::move(record));
}

constexpr double kUsualRange_m = 30.0;

void scale_path(Trajectory& path, double factor) { path.positions_m *= factor; }

void scale_value(FitValue& value, double factor) {
  if (!value.id.ends_with("_m")) return;
  value.value *= factor;
  if (value.sigma) *value.sigma *= factor;
}

void scale_fit(Fit& fit, double factor) {
  for (FitCause& cause : fit.causes)
    for (FitValue& value : cause.values) scale_value(value, factor);
  for (FitTest& test : fit.tests)
    if (test.limit) scale_value(*test.limit, factor);
  // The variance of odometry grows with the way, as the square root of which its deviation does.
  for (FitNumber& number : fit.numbers) {
    // Densities are per length.
    if (number.quantity.ends_with("held_out_nats")) number.value -= std::log(factor);
    const double power = number.quantity == "fit_range_sigma_m"       ? 1.0
                         : number.quantity == "fit_forward_sigma_m"   ? 0.5
                         : number.quantity == "fit_heading_sigma_rad" ? -0.5
                                                                      : 0.0;
    number.value *= std::pow(factor, power);
  }
}

void scale_estimate(SlamEstimate& estimate, double factor) {
  scale_path(estimate.path, factor);
  estimate.landmarks_m *= factor;
  for (auto* covariances : {&estimate.landmark_cov_m2, &estimate.position_cov_m2})
    for (Eigen::Matrix2d& C : *covariances) C *= factor * factor;
  estimate.singular_values *= factor * factor;
  if (estimate.noise_level) *estimate.noise_level *= factor * factor;
  estimate.range_offsets_m *= factor;
}

void scale_error(TrajectoryError& error, double factor) {
  for (double* value : {&error.mean_m, &error.rmse_m, &error.last_tenth_m, &error.best_tenth_m,
                        &error.worst_tenth_m})
    *value *= factor;
  if (error.landmarks_m) *error.landmarks_m *= factor;
}

}  // namespace

SlamRunResult make_slam_run(const std::string& id, RangeLog log, const SlamRunOptions& given) {
  SlamRunResult result;
  SlamRun& run = result.run;
  run.id = id;
  if (given.known) run.known = given.known->rows;
  std::ranges::sort(run.known);
  const NearOrigin near = near_origin(log, given);
  run.log = std::move(log);
  const SlamRunOptions& options = near.options;
  SlamEstimates estimates(near.log, options);
  for (const SlamMethod method : options.methods) {
    estimates.prepare(method);
    const Stopwatch stopwatch;
    SlamRecord record{
        .method = method, .estimate = estimates.estimate(method), .errors = {}, .error_m = {}};
    const double seconds = stopwatch.seconds();
    result.timings.push_back(
        {.run = id, .method = method, .seconds = seconds + estimates.prepared_s(method)});
    if (record.estimate.landmark_cov_m2.empty())
      record.estimate.landmark_cov_m2 = estimates.landmark_covariances(method, record.estimate);
    score_against_ground_truth(record, near.log, first_alignment(method, near));
    if (is_refinement(method) && options.random_starts > 0)
      run.starts.push_back(start_of(record, 1));
    run.records.push_back(std::move(record));
  }
  take_fit(estimates, near, run);
  add_random_starts(estimates, near, run);
  run.windows = estimates.windows();
  if (std::ranges::find(options.methods, SlamMethod::kSpectral) != options.methods.end())
    run.upgrade = estimates.upgrade();
  if (!run.log.ground_truth) align_to_reference(run.records, near);
  for (SlamRecord& record : run.records) {
    move_by(record.estimate.path.positions_m, near.origin_m);
    move_by(record.estimate.landmarks_m, near.origin_m);
  }
  return result;
}

void score_against_ground_truth(SlamRecord& record, const RangeLog& log, Alignment first) {
  SlamEstimate& estimate = record.estimate;
  if (!log.ground_truth || estimate.path.size() == 0) return;
  const std::optional<Similarity> motion = path_alignment(estimate.path, *log.ground_truth, first);
  if (!motion) return;
  for (const Alignment alignment : alignments_from(first))
    if (const auto error =
            trajectory_error(estimate, *log.ground_truth, log.true_landmarks, alignment))
      record.errors.push_back(*error);
  if (first != Alignment::kNone) move(estimate, *motion);
  record.error_m = pose_errors(estimate.path, *log.ground_truth);
}

void align_to(SlamEstimate& estimate, const Trajectory& path, bool may_mirror) {
  if (estimate.path.size() == 0) return;
  const auto motion = path_alignment(
      estimate.path, path, may_mirror ? Alignment::kRigidWithReflection : Alignment::kRigid);
  if (motion) move(estimate, *motion);
}

SlamEstimates::SlamEstimates(const RangeLog& log, const SlamRunOptions& options)
    : log_(log), options_(options) {}

SlamEstimate SlamEstimates::estimate(SlamMethod method) {
  try {
    return solve(method);
  } catch (const InvalidInput& error) {
    // Only the data of a log can break what its reader does not check.
    return failed(log_, status_with_message(StatusCode::kFailed, error.what()));
  }
}

SlamEstimate SlamEstimates::refined_from_random(int number) {
  const std::uint64_t seed =
      derive_seed(options_.seed, {kSlamStart, static_cast<std::uint64_t>(number)});
  return refined(random_start(log_, seed), true);
}

std::vector<Eigen::Matrix2d> SlamEstimates::landmark_covariances(
    SlamMethod method, const SlamEstimate& estimate) const {
  const bool is_flat = method == SlamMethod::kSpectral || method == SlamMethod::kSpectralKnown;
  const Trajectory& path = estimate.path;
  if (!is_flat || !window_ || path.size() < 2 || Y_.cols() != path.size()) return {};
  const double step_s = (path.time_s(path.size() - 1) - path.time_s(0)) / double(path.size() - 1);
  BootstrapOptions options;
  options.block = std::clamp<Eigen::Index>(std::lround(window_->length_s / step_s), 1, path.size());
  options.seed = derive_seed(options_.seed, {kSlamBootstrap});
  return bootstrap_landmarks(Y_, estimate.landmarks_m,
                             method == SlamMethod::kSpectralKnown ? options_.known : std::nullopt,
                             options)
      .covariances_m2;
}

void SlamEstimates::prepare(SlamMethod method) {
  if (log_.odometry.empty()) return;
  try {
    if (is_spectral(method)) window();
    if (options_.fit) log_fit();
    if (method == SlamMethod::kRefined || method == SlamMethod::kBatchFixedScale) spectral_start();
    if (method == SlamMethod::kRefinedFromOdometry) odometry_start();
  } catch (const InvalidInput&) {
    return;  // The error recurs, and is reported, when the method itself runs.
  }
}

bool SlamEstimates::is_of_fit(SlamMethod method) const {
  return method == SlamMethod::kRefined && !options_.ties_refinement && fit_ &&
         fit_->estimate.path.size() > 0;
}

double SlamEstimates::prepared_s(SlamMethod method) const {
  return is_of_fit(method) ? fit_->map_s : 0.0;
}

std::optional<WindowCurve> SlamEstimates::windows() const {
  return window_ ? std::optional(curve_) : std::nullopt;
}

SlamEstimate SlamEstimates::solve(SlamMethod method) {
  if (info(method).knows_landmarks && !options_.known)
    return failed(log_, status_of<StatusReason::kNoKnownLandmark>());
  if (log_.odometry.empty() && !is_spectral(method))
    return failed(log_, status_of<StatusReason::kNoOdometry>());
  switch (method) {
    case SlamMethod::kDeadReckoning:
      return dead_reckoning_start(log_);  // Not that of prepare(): this one is timed.
    case SlamMethod::kEkf:
      return filtered();
    case SlamMethod::kSpectralKnown:
    case SlamMethod::kSpectralKnown7:
      return spectral(true, method == SlamMethod::kSpectralKnown7);
    case SlamMethod::kSpectral:
    case SlamMethod::kSpectral7:
      return spectral(false, method == SlamMethod::kSpectral7);
    case SlamMethod::kBatchFixedScale: {
      SlamEstimate start = spectral_start();
      if (start.path.size() == 0) start = odometry_start();
      start.range_scale = 1.0;
      return refined(start, false);
    }
    case SlamMethod::kRepaired:
      if (log_fit() == nullptr || !log_fit()->repaired)
        return failed(log_, status_of<StatusReason::kNoStart>());
      return repaired();
    case SlamMethod::kRefined:
      if (log_fit() != nullptr && log_fit()->estimate.path.size() > 0)
        return is_of_fit(method) ? log_fit()->estimate : refined(log_fit()->estimate, true);
      if (spectral_start().path.size() == 0)
        return failed(log_, status_of<StatusReason::kNoStart>());
      return refined(spectral_start(), true);
    case SlamMethod::kRefinedFromOdometry:
      return refined(odometry_start(), true);
    case SlamMethod::kRefinedFromRandom:
      return refined_from_random(1);
  }
  throw InvalidInput("unknown method");
}

SlamEstimate SlamEstimates::spectral(bool with_known, bool with_heading) {
  const std::optional<KnownLandmarks> known = with_known ? options_.known : std::nullopt;
  if (!log_.odometry.empty()) {
    SpectralSlam found = spectral_slam(
        log_, reckoned(), {.known = known, .with_heading = with_heading, .window = window()});
    Y_ = std::move(found.Y);
    if (!with_known && !with_heading) upgrade_ = clouds_of(found.upgrade);
    return std::move(found.estimate);
  }
  if (with_heading) return failed(log_, status_of<StatusReason::kNoOdometryForHeadings>());
  const auto landmarks = static_cast<Eigen::Index>(log_.landmarks.size());
  SynchronousSlam found =
      synchronous_slam(synchronous_ranges(log_.ranges, landmarks), known, options_.noise);
  if (!with_known) upgrade_ = clouds_of(found.upgrade);
  return std::move(found.estimate);
}

SlamEstimate SlamEstimates::filtered() {
  EkfOptions options;
  options.covariances = kPosesWithCovariance;
  if (const LogFit* fit = log_fit(); fit != nullptr && fit->noise.range_m > 0.0) {
    options.odometry = noise_of_motion(fit->noise);
    options.range_sigma_m = fit->noise.range_m;
  }
  return ekf_slam(log_, options);
}

const LogFit* SlamEstimates::log_fit() {
  if (!options_.fit || log_.odometry.empty()) return nullptr;
  if (fit_) return &*fit_;
  std::vector<SlamEstimate> starts;
  if (const SlamEstimate& spectral = spectral_start(); spectral.path.size() > 0)
    starts.push_back(spectral);
  starts.push_back(odometry_start());
  LogFitOptions options = *options_.fit;
  options.holds_out = options_.repairs;
  fit_ = fit_log(log_, starts, options);
  return &*fit_;
}

/// Of the mean motion: the noise of odometry grows with the way.
OdometryNoise SlamEstimates::noise_of_motion(const LogNoise& noise) const {
  double way_m = 0.0, turn = 0.0;
  for (const Motion& motion : log_.odometry) {
    way_m += std::hypot(motion.distance_m, motion.sideways_m);
    turn += std::abs(motion.heading_change_rad);
  }
  const double count = static_cast<double>(log_.odometry.size());
  const double forward_m = std::max(noise.way_m * std::sqrt(way_m / count), 1e-9);
  const double heading_change_rad =
      std::max(std::hypot(noise.heading_per_metre * std::sqrt(way_m / count),
                          noise.heading_per_radian * std::sqrt(turn / count)),
               1e-9);
  return {
      .forward_m = forward_m, .sideways_m = forward_m, .heading_change_rad = heading_change_rad};
}

RefineOptions SlamEstimates::refinement(const LogNoise& noise) const {
  RefineOptions options;
  if (noise.range_m > 0.0) {
    options.odometry = noise_of_motion(noise);
    options.range_sigma_m = noise.range_m;
  }
  options.covariances = kPosesWithCovariance;
  if (options_.ties_refinement) options.known = options_.known;
  return options;
}

SlamEstimate SlamEstimates::refined(const SlamEstimate& start, bool estimate_scale) {
  const LogFit* fit = log_fit();
  RefineOptions options = refinement(fit == nullptr ? LogNoise() : fit->noise);
  options.estimate_scale = estimate_scale;
  return refine(log_, start, options);
}

SlamEstimate SlamEstimates::repaired() {
  const LogFit& fit = *log_fit();
  if (!options_.ties_refinement || !options_.known) return fit.repaired->estimate;
  RefineOptions options = refinement(fit.repaired->noise);
  SlamEstimate start = fit.repaired->estimate;
  const Eigen::Index N = start.landmarks_m.rows();
  if (fit.cause.code == FitCode::kLandmarkMoved) {
    // Nothing says at which of its two positions it was surveyed.
    options.known = without(*options.known, fit.cause.landmarks.front());
    start.landmarks_m.conservativeResize(N + 1, 2);
    start.landmarks_m.row(N).setConstant(kNaN);
  }
  SlamEstimate found = refine(fit.repaired->log, start, options);
  found.landmarks_m.conservativeResize(N, 2);
  if (std::ssize(found.landmark_cov_m2) > N)
    found.landmark_cov_m2.resize(static_cast<std::size_t>(N));
  return found;
}

const Trajectory& SlamEstimates::reckoned() {
  if (!reckoned_) reckoned_ = dead_reckoned(log_);
  return *reckoned_;
}

const WindowOptions& SlamEstimates::window() {
  if (window_) return *window_;
  const auto landmarks = static_cast<Eigen::Index>(log_.landmarks.size());
  const WindowSearch search = choose_window(ranges_by_landmark(log_.ranges, landmarks, reckoned()),
                                            reckoned(), reckoned().time_s);
  curve_ = summary(search);
  window_ = search.options;
  return *window_;
}

const SlamEstimate& SlamEstimates::spectral_start() {
  if (!spectral_start_) spectral_start_ = spectral(false, false);
  return *spectral_start_;
}

const SlamEstimate& SlamEstimates::odometry_start() {
  if (!odometry_start_) odometry_start_ = dead_reckoning_start(log_);
  return *odometry_start_;
}

double unit_of(const RangeLog& log) {
  std::vector<double> ranges;
  for (const RangeMeasurement& range : log.ranges) ranges.push_back(range.range_m);
  const double typical = ranges.empty() ? kUsualRange_m : median(ranges);
  return typical > 0.0 ? typical / kUsualRange_m : 1.0;
}

RangeLog in_unit(RangeLog log, double factor) {
  for (RangeMeasurement& range : log.ranges) {
    range.range_m *= factor;
    range.sigma_m *= factor;
  }
  log.start.x_m *= factor;
  log.start.y_m *= factor;
  for (Motion& motion : log.odometry) {
    motion.distance_m *= factor;
    motion.sideways_m *= factor;
    if (motion.sigmas) motion.sigmas->head<2>() *= factor;
  }
  if (log.ground_truth) scale_path(*log.ground_truth, factor);
  if (log.true_landmarks) *log.true_landmarks *= factor;
  return log;
}

void take_unit(SlamRun& run, RangeLog log, double factor) {
  run.log = std::move(log);
  for (SlamRecord& record : run.records) {
    scale_estimate(record.estimate, factor);
    for (TrajectoryError& error : record.errors) scale_error(error, factor);
    for (double& error : record.error_m) error *= factor;
  }
  if (run.windows)
    for (double& error : run.windows->held_out_m) error *= factor;
  if (run.upgrade) {
    const Eigen::Vector4d lengths(factor, factor, factor * factor, 1.0);
    run.upgrade->after.points *= lengths.head<3>().asDiagonal();
    const Eigen::Vector4d inverse = lengths.cwiseInverse();
    run.upgrade->after.Q =
        (inverse.asDiagonal() * run.upgrade->after.Q * inverse.asDiagonal()).eval();
  }
  for (FittedRange& range : run.fitted_ranges) range.range_m *= factor;
  if (run.fit) scale_fit(*run.fit, factor);
}

}  // namespace mapproof
