#include "core/align/rigid_space.hpp"
#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/experiment/seeds.hpp"
#include "core/experiment/slam_worlds.hpp"
#include "core/range_slam/factors/space_slam.hpp"
#include "core/simulate/range_flight.hpp"

namespace mapproof {
namespace {

double mean_distance(const SpacePoints& a, const SpacePoints& b) {
  return (a - b).rowwise().norm().mean();
}

/// What a flight's ranges give, aligned to the truth where no landmark tied it down.
SpaceRecord record_of(const RangeFlight& flight, const RangeNoise& noise,
                      const std::optional<KnownSpaceLandmarks>& known) {
  SpaceRecord record{.knows_landmarks = known.has_value(),
                     .estimate = space_slam(flight.ranges_m, known, noise),
                     .alignment = known ? Alignment::kNone : Alignment::kRigidWithReflection,
                     .landmarks_error_m = {},
                     .positions_error_m = {}};
  SpaceEstimate& estimate = record.estimate;
  if (estimate.empty()) return record;
  if (!known) {
    const SpaceMotion motion = fit_space_motion(estimate.positions_m, flight.positions_m, true);
    estimate.positions_m = SpacePoints(motion(estimate.positions_m));
    estimate.landmarks_m = SpacePoints(motion(estimate.landmarks_m));
  }
  record.landmarks_error_m = mean_distance(estimate.landmarks_m, flight.landmarks_m);
  record.positions_error_m = mean_distance(estimate.positions_m, flight.positions_m);
  return record;
}

}  // namespace

SpaceRun make_space_run(const SlamExperiment& experiment) {
  if (!experiment.space) throw InvalidInput("the experiment has no flight");
  const SpaceFlightOptions& options = *experiment.space;
  const RangeFlight flight =
      simulate_range_flight({.landmarks = options.landmarks,
                             .steps = options.steps,
                             .half_width_m = options.half_width_m,
                             .height_m = options.height_m,
                             .step_m = options.step_m,
                             .turn_sigma_rad = options.turn_sigma_rad,
                             .noise = {.sigma_m = options.noise.noise_m,
                                       .share = options.noise.share,
                                       .correlation = options.noise.correlation}},
                            derive_seed(experiment.seed, {kSlamSpace}));
  SpaceRun run{.landmarks_m = flight.landmarks_m,
               .positions_m = flight.positions_m,
               .known = {},
               .noise = options.noise.title,
               .records = {}};
  for (Eigen::Index n = 0; n < options.known; ++n) run.known.push_back(n);
  const RangeNoise noise = range_noise(options.noise);
  run.records.push_back(
      record_of(flight, noise,
                KnownSpaceLandmarks{.rows = run.known,
                                    .positions_m = flight.landmarks_m.topRows(options.known)}));
  run.records.push_back(record_of(flight, noise, std::nullopt));
  return run;
}

}  // namespace mapproof
