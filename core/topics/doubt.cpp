#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include <fmt/format.h>

#include "core/align/rigid.hpp"
#include "core/base/random.hpp"
#include "core/base/stopwatch.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/range_slam/fit/log_fit.hpp"
#include "core/simulate/range_world.hpp"
#include "core/topics/topics.hpp"

namespace mapproof {
namespace {

constexpr const char* kDoubtMethod = "slam";
constexpr double kEllipse95 = 5.991464547107979;  ///< Chi-squared of 2 degrees of freedom.

/// A fault at its full size.
struct DoubtFault {
  const char* id;
  const char* title;
  FitCode code;
  double DriveFaults::*what;
  double full;
  double most = 1e300;  ///< Sizes beyond it make no sense.
};

constexpr DoubtFault kDoubtFaults[] = {
    {"common-offset", "All ranges 3 m too long", FitCode::kCommonOffset,
     &DriveFaults::common_offset_m, 3.0},
    {"landmark-offset", "Ranges of one landmark 5 m too long", FitCode::kLandmarkOffset,
     &DriveFaults::landmark_offset_m, 5.0},
    {"late-clock", "Ranges stamped 5 s late", FitCode::kTimeOffset, &DriveFaults::late_s, 5.0},
    {"clock-jump", "Clock of the ranges jumps by 20 s half-way", FitCode::kClockJump,
     &DriveFaults::jump_s, 20.0},
    {"moved-landmark", "One landmark moved by 10 m half-way", FitCode::kLandmarkMoved,
     &DriveFaults::moved_m, 10.0},
    {"exchanged-ids", "IDs of two landmarks exchanged half-way", FitCode::kIdsExchanged,
     &DriveFaults::exchanged_share, 1.0, 1.0},
    {"odometry-gap", "Odometry missing for 60 s", FitCode::kOdometryGap, &DriveFaults::gap_s, 60.0},
    {"odometry-frozen", "Odometry at a standstill for 60 s", FitCode::kOdometryFrozen,
     &DriveFaults::frozen_s, 60.0}};

TopicDesign doubt_design(const TopicExperiment& experiment) {
  TopicDesign design;
  design.setups.push_back({"fault-free", "Fault-free logs", {}});
  for (const DoubtFault& fault : kDoubtFaults)
    design.setups.push_back({fault.id,
                             fault.title,
                             {{.id = "size_percent",
                               .label = "size of the fault",
                               .unit = "%",
                               .levels = list_option(experiment, "sizes_percent")}}});
  design.methods.push_back({kDoubtMethod, "test of the fit"});
  design.quantities = {
      study_quantity("reported_percent", "Share of faults reported", "%", Better::kHigher),
      study_quantity("named_percent", "Share of causes named right", "%", Better::kHigher),
      study_quantity("alarm_percent", "Share of fault-free logs with an alarm", "%",
                     Better::kLower),
      study_quantity("denied_percent", "Share of fault-free logs that do not fit", "%",
                     Better::kLower),
      study_quantity("inside_percent", "Share of landmarks in their 95 % ellipse", "%",
                     Better::kNeither),
      study_quantity("nees", "Squared error over its variance", "", Better::kNeither),
      study_quantity("landmarks_m", "Landmark error", "m", Better::kLower)};
  return design;
}

/// Noise from a third to three times the usual one; every other drive has errors that hang together
/// in time.
RangeDriveOptions drive_options(const TopicTask& context) {
  Random random(derive_seed(context.seed, {1}));
  RangeDriveOptions options;
  options.steps = context.experiment.steps;
  options.landmarks = 4 + static_cast<int>(4.0 * random.uniform());
  const auto noisier = [&] { return std::exp(random.uniform(-1.0986, 1.0986)); };
  options.forward_sigma_m *= noisier();
  options.heading_change_sigma_rad *= noisier();
  options.range_sigma_m *= noisier();
  options.range_scale = random.uniform(0.95, 1.07);
  const double most = number_option(context.experiment, "correlation");
  if (random.uniform() < 0.5) options.correlation = most;
  options.offset_sigma_m = number_option(context.experiment, "offset_sigma_m");
  return options;
}

LogFitOptions fit_options(const TopicTask& context, bool only_tests) {
  LogFitOptions options;
  options.test_keys = static_cast<Eigen::Index>(number_option(context.experiment, "keys"));
  options.final_keys = options.test_keys;
  options.odometry_scale_sigma = 0.0;  // The simulated odometry has the true scale.
  options.only_tests = only_tests;
  return options;
}

/// How the landmarks of a map lie to their true positions, after a rigid fit.
void add_coverage(const LogFit& fit, const Points& true_landmarks_m, TopicOutcome& outcome) {
  const Points& mapped = fit.estimate.landmarks_m;
  if (mapped.rows() != true_landmarks_m.rows() || !mapped.allFinite() ||
      std::ssize(fit.estimate.landmark_cov_m2) != mapped.rows())
    return;
  // Into the frame of the map, in which the covariances are.
  const Points there =
      Points(fit_similarity(true_landmarks_m, mapped, Alignment::kRigid)(true_landmarks_m));
  double inside = 0.0, nees = 0.0, error_m = 0.0;
  const double count = static_cast<double>(true_landmarks_m.rows());
  for (Eigen::Index n = 0; n < true_landmarks_m.rows(); ++n) {
    const Eigen::Vector2d error = (mapped.row(n) - there.row(n)).transpose();
    const Eigen::Matrix2d& C = fit.estimate.landmark_cov_m2[static_cast<std::size_t>(n)];
    const double squared = error.dot(C.inverse() * error);
    inside += squared <= kEllipse95 ? 1.0 : 0.0;
    nees += squared;
    error_m += error.norm();
  }
  outcome.values["inside_percent"] = 100.0 * inside / count;
  outcome.values["nees"] = nees / count;
  outcome.values["landmarks_m"] = error_m / count;
}

TopicOutcome fault_free_outcome(const TopicTask& context, const RangeDriveOptions& options) {
  Random random(derive_seed(context.seed, {2}));
  const RangeLog log = simulate_drive(options, {}, random);
  const LogFit fit = fit_log(log, {}, fit_options(context, false));
  TopicOutcome outcome{
      .at = condition("fault-free"), .method = kDoubtMethod, .values = {}, .statuses = {}};
  outcome.values["alarm_percent"] = fit.fit.verdict == FitVerdict::kFits ? 0.0 : 100.0;
  outcome.values["denied_percent"] = fit.fit.verdict == FitVerdict::kDoesNotFit ? 100.0 : 0.0;
  if (fit.fit.verdict == FitVerdict::kFits) add_coverage(fit, *log.true_landmarks, outcome);
  return outcome;
}

TopicOutcome fault_outcome(const TopicTask& context, const RangeDriveOptions& options,
                           const DoubtFault& fault, double percent) {
  Random random(derive_seed(context.seed, {2}));
  DriveFaults faults;
  faults.*fault.what = std::min(fault.most, fault.full * percent / 100.0);
  const RangeLog log = simulate_drive(options, faults, random);
  const LogFit fit = fit_log(log, {}, fit_options(context, true));
  const bool is_reported = fit.fit.verdict != FitVerdict::kFits;
  const bool is_named = std::ranges::any_of(
      fit.fit.causes, [&](const FitCause& cause) { return cause.code == fault.code; });
  return {.at = condition(fault.id, {{.factor = "size_percent", .value = percent}}),
          .method = kDoubtMethod,
          .values = {{"reported_percent", is_reported ? 100.0 : 0.0},
                     {"named_percent", is_named ? 100.0 : 0.0}},
          .statuses = {}};
}

TopicPart make_doubt(const TopicTask& context) {
  TopicPart part;
  const RangeDriveOptions options = drive_options(context);
  const Stopwatch stopwatch;
  part.outcomes.push_back(fault_free_outcome(context, options));
  // False alarms are rare: they need more logs than the faults do.
  const bool is_first = context.run.pose == 1;
  const std::span<const DoubtFault> faults(kDoubtFaults, is_first ? std::size(kDoubtFaults) : 0);
  for (const DoubtFault& fault : faults)
    for (const double percent : list_option(context.experiment, "sizes_percent"))
      if (fault.full * percent / 100.0 <= fault.most || percent <= 100.0)
        part.outcomes.push_back(fault_outcome(context, options, fault, percent));
  add_seconds(part, kDoubtMethod, stopwatch.seconds());
  return part;
}

}  // namespace

const Topic kDoubtTopic = {
    .name = "doubt",
    .of_data = false,
    .options = {{"sizes_percent", {10, 25, 50, 100, 300}, 1, 300, false, true},
                {"keys", {150}, 50, 5000, true, false},
                {"correlation", {0.5}, 0.0, 0.99, false, false},
                {"offset_sigma_m", {0.0}, 0.0, 10.0, false, false}},
    .design = doubt_design,
    .make = make_doubt};

}  // namespace mapproof
