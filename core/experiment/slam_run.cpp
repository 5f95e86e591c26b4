#include "core/experiment/slam_run.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "core/base/errors.hpp"
#include "core/experiment/slam_estimates.hpp"
#include "core/experiment/slam_scores.hpp"

namespace mapproof {
namespace {

using Clock = std::chrono::steady_clock;

bool is_refinement(SlamMethod method) {
  return method == SlamMethod::kRefined || method == SlamMethod::kRefinedFromOdometry ||
         method == SlamMethod::kRefinedFromRandom;
}

bool has_start_pose(const StartPose& start) {
  return start.x_m != 0.0 || start.y_m != 0.0 || start.heading_rad != 0.0;
}

/// Under which the error of a method on this log is told first.
Alignment first_alignment(SlamMethod method, const RangeLog& log, const SlamRunOptions& options) {
  const SlamMethodInfo& facts = info(method);
  if (facts.knows_landmarks) return Alignment::kNone;
  // What starts in a frame of its own cannot be compared as it comes.
  if (method == SlamMethod::kDeadReckoning)
    return has_start_pose(log.start) ? Alignment::kNone : Alignment::kRigid;
  const bool refines = is_refinement(method) || method == SlamMethod::kBatchFixedScale;
  if (refines && options.ties_refinement && options.known) return Alignment::kNone;
  return log.odometry.empty() ? Alignment::kRigidWithReflection : facts.alignment;
}

bool has(const SlamEstimate& estimate, StatusCode code) {
  return std::ranges::any_of(estimate.statuses, [&](const Status& s) { return s.code == code; });
}

RefinementStart start_of(const SlamRecord& record, int number) {
  const SlamEstimate& estimate = record.estimate;
  RefinementStart start{.method = record.method,
                        .number = number,
                        .cost = estimate.cost.value_or(std::numeric_limits<double>::quiet_NaN()),
                        .mean_m = std::nullopt,
                        .iterations = estimate.iterations,
                        .converged = estimate.cost && !has(estimate, StatusCode::kNotConverged)};
  if (!record.errors.empty()) start.mean_m = record.errors.front().mean_m;
  return start;
}

/// The random starts after the first, which is a record of its own.
void add_random_starts(SlamEstimates& estimates, const SlamRunOptions& options, SlamRun& run) {
  const SlamMethod method = SlamMethod::kRefinedFromRandom;
  if (std::ranges::find(options.methods, method) == options.methods.end() ||
      run.log.odometry.empty())
    return;
  for (int number = 2; number <= options.random_starts; ++number) {
    SlamRecord record{.method = method, .estimate = {}, .errors = {}, .error_m = {}};
    try {
      record.estimate = estimates.refined_from_random(number);
    } catch (const InvalidInput&) {
      return;  // The first one says why.
    }
    score_against_truth(record, run.log, first_alignment(method, run.log, options));
    run.starts.push_back(start_of(record, number));
  }
}

/// Without a truth all paths are aligned to the first there is.
void lay_on_first(SlamRun& run, const SlamRunOptions& options) {
  const SlamRecord* first = nullptr;
  for (SlamRecord& record : run.records) {
    if (first == nullptr && record.estimate.path.size() > 0) first = &record;
    if (first == nullptr || first == &record ||
        first_alignment(record.method, run.log, options) == Alignment::kNone)
      continue;
    lay_on(record.estimate, first->estimate.path, run.log.odometry.empty());
  }
}

}  // namespace

SlamRunResult make_slam_run(const std::string& id, RangeLog log, const SlamRunOptions& options) {
  SlamRunResult result;
  SlamRun& run = result.run;
  run.id = id;
  run.log = std::move(log);
  if (options.known) run.known = options.known->rows;
  std::ranges::sort(run.known);
  SlamEstimates estimates(run.log, options);
  for (const SlamMethod method : options.methods) {
    estimates.prepare(method);
    const Clock::time_point start = Clock::now();
    SlamRecord record{
        .method = method, .estimate = estimates.estimate(method), .errors = {}, .error_m = {}};
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    result.timings.push_back({.run = id, .method = method, .seconds = seconds});
    if (record.estimate.landmark_cov_m2.empty())
      record.estimate.landmark_cov_m2 = estimates.landmark_covariances(method, record.estimate);
    score_against_truth(record, run.log, first_alignment(method, run.log, options));
    if (is_refinement(method) && options.random_starts > 0)
      run.starts.push_back(start_of(record, 1));
    run.records.push_back(std::move(record));
  }
  add_random_starts(estimates, options, run);
  run.windows = estimates.windows();
  if (std::ranges::find(options.methods, SlamMethod::kSpectral) != options.methods.end())
    run.upgrade = estimates.upgrade();
  if (!run.log.truth) lay_on_first(run, options);
  return result;
}

}  // namespace mapproof
