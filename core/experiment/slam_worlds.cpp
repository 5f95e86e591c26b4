#include "core/experiment/slam_worlds.hpp"

#include <chrono>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/experiment/seeds.hpp"
#include "core/experiment/slam_run.hpp"
#include "core/range_slam/factors/metric_upgrade.hpp"

namespace mapproof {
namespace {

RangeLog log_of(const RangeWorld& world) {
  RangeLog log;
  log.name = "Simulation";
  const Eigen::Index T = world.ranges_m.cols();
  for (Eigen::Index n = 0; n < world.ranges_m.rows(); ++n)
    log.landmarks.push_back("L" + std::to_string(n + 1));
  for (Eigen::Index t = 0; t < T; ++t)
    for (Eigen::Index n = 0; n < world.ranges_m.rows(); ++n)
      log.ranges.push_back(
          {.time_s = static_cast<double>(t), .landmark = n, .range_m = world.ranges_m(n, t)});
  log.truth = Trajectory{.time_s = Eigen::VectorXd::LinSpaced(T, 0.0, static_cast<double>(T - 1)),
                         .positions_m = world.positions_m,
                         .heading_rad = world.heading_rad};
  log.true_landmarks = world.landmarks_m;
  return log;
}

}  // namespace

RangeWorldOptions range_world_options(const SlamWorldOptions& world, const RangeNoiseModel& noise,
                                      int landmarks, int steps) {
  return {.landmarks = landmarks,
          .steps = steps,
          .half_width_m = world.half_width_m,
          .step_m = world.step_m,
          .turn_sigma_rad = world.turn_sigma_rad,
          .noise_m = noise.noise_m,
          .noise_share = noise.share,
          .noise_correlation = noise.correlation};
}

RangeNoise range_noise(const RangeNoiseModel& noise) {
  return {.sigma_m = noise.noise_m, .share = noise.share};
}

SlamRun make_example(const SlamExperiment& experiment, std::vector<SlamTiming>& timings) {
  if (!experiment.example) throw InvalidInput("the experiment has no example");
  const SlamExample& example = *experiment.example;
  const RangeWorld world =
      simulate_range_world(range_world_options(experiment.world, example.noise,
                                               experiment.world.landmarks, example.steps),
                           derive_seed(experiment.seed, {kSlamExample}));
  SlamRunOptions options{.methods = {SlamMethod::kSpectralKnown, SlamMethod::kSpectral},
                         .known = KnownLandmarks{.rows = {}, .positions_m = {}},
                         .noise = range_noise(example.noise)};
  for (Eigen::Index n = 0; n < experiment.world.known; ++n) options.known->rows.push_back(n);
  options.known->positions_m = world.landmarks_m.topRows(experiment.world.known);
  SlamRunResult result = make_slam_run(example.noise.id, log_of(world), options);
  result.run.figure = example.figure;
  result.run.simulated = true;
  timings = std::move(result.timings);
  return std::move(result.run);
}

std::vector<FactorizationCost> time_factorization(const SlamExperiment& experiment) {
  using Clock = std::chrono::steady_clock;
  std::vector<FactorizationCost> costs;
  RangeNoiseModel noise;
  noise.share = 0.01;
  for (const int landmarks : experiment.factorization.landmarks)
    for (const int steps : experiment.factorization.steps) {
      const RangeWorld world =
          simulate_range_world(range_world_options(experiment.world, noise, landmarks, steps),
                               derive_seed(experiment.seed, {kSlamCost}));
      const Eigen::MatrixXd Y = half_squared_ranges(world.ranges_m);
      const Clock::time_point start = Clock::now();
      metric_upgrade(factorize(Y, 4));
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      costs.push_back({.landmarks = landmarks, .steps = steps, .seconds = seconds});
    }
  return costs;
}

}  // namespace mapproof
