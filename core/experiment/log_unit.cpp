#include "core/experiment/log_unit.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "core/base/median.hpp"

namespace mapproof {
namespace {

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
    const double power = number.quantity == "fit_range_sigma_m"              ? 1.0
                         : number.quantity == "fit_forward_sigma_m"          ? 0.5
                         : number.quantity == "fit_heading_change_sigma_rad" ? -0.5
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
