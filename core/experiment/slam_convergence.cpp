#include <cmath>
#include <numeric>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/parallel.hpp"
#include "core/base/random.hpp"
#include "core/experiment/seeds.hpp"
#include "core/experiment/slam_worlds.hpp"

namespace mapproof {
namespace {

/// Mean over independent values; NaN if there is none.
MeanEstimate mean_of(const std::vector<double>& values) {
  if (values.empty()) return {.mean = kNaN, .values = 0, .clusters = 0, .half_width = {}};
  std::vector<int> own(values.size());
  std::iota(own.begin(), own.end(), 0);
  return clustered_mean(values, own);
}

/// The mean of one field at one number of steps, pair by pair.
MeanEstimate mean_of(const std::vector<std::vector<ModelError>>& pairs, int steps,
                     double ModelError::*field) {
  std::vector<double> values;
  for (const std::vector<ModelError>& errors : pairs)
    for (const ModelError& error : errors)
      if (error.steps == steps && std::isfinite(error.*field)) values.push_back(error.*field);
  return mean_of(values);
}

/// How eq. 5 falls with the steps [boots2013].
double fall(int steps) { return std::sqrt(std::log(steps) / steps); }

double slope_of(const std::vector<ConvergencePoint>& points) {
  double n = 0.0, sum_x = 0.0, sum_y = 0.0, sum_xx = 0.0, sum_xy = 0.0;
  for (const ConvergencePoint& point : points) {
    const double x = std::log(point.steps);
    const double y = std::log(point.observation.mean);
    if (!std::isfinite(y)) continue;
    n += 1.0;
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
  }
  return n < 2.0 ? kNaN : (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
}

/// Of the first world drawn for the pair whose known landmarks serve.
std::vector<ModelError> errors_of_pair(const SlamExperiment& experiment,
                                       const RangeNoiseModel& noise,
                                       const RangeWorldOptions& options, std::uint64_t pair) {
  constexpr std::uint64_t kMostDraws = 100;
  const ConvergenceOptions& convergence = *experiment.convergence;
  const std::vector<Eigen::Index> steps(convergence.steps.begin(), convergence.steps.end());
  std::vector<ModelError> errors;
  for (std::uint64_t draw = 0; draw < kMostDraws; ++draw) {
    RangeWorld world =
        simulate_range_world(options, derive_seed(experiment.seed, {kSlamPair, pair, draw}));
    errors = model_errors(
        {.landmarks_m = std::move(world.landmarks_m),
         .positions_m = std::move(world.positions_m),
         .ranges_m = std::move(world.ranges_m),
         .noise = range_noise(noise)},
        steps, {.known = experiment.world.known, .subtract_variances = !noise.plain_svd});
    if (!errors.empty() && errors.back().condition <= convergence.most_condition) break;
  }
  return errors;
}

}  // namespace

ConvergenceCurve make_convergence(const SlamExperiment& experiment, const RangeNoiseModel& noise) {
  if (!experiment.convergence) throw InvalidInput("the experiment has no convergence");
  const ConvergenceOptions& convergence = *experiment.convergence;
  const RangeWorldOptions options = range_world_options(
      experiment.world, noise, experiment.world.landmarks, convergence.steps.back());

  std::vector<std::vector<ModelError>> pairs(static_cast<std::size_t>(convergence.pairs));
  parallel_for(pairs.size(), [&](std::size_t pair) {
    pairs[pair] = errors_of_pair(experiment, noise, options, pair);
  });

  ConvergenceCurve curve{.id = noise.id,
                         .title = noise.title,
                         .landmarks = experiment.world.landmarks,
                         .points = {},
                         .slope = 0.0};
  for (const int count : convergence.steps) {
    ConvergencePoint point{.steps = count,
                           .observation = mean_of(pairs, count, &ModelError::observation),
                           .landmarks_m = mean_of(pairs, count, &ModelError::landmarks_m),
                           .positions_m = mean_of(pairs, count, &ModelError::positions_m),
                           .sine = mean_of(pairs, count, &ModelError::sine),
                           .bound = 0.0};
    const double first = curve.points.empty() ? point.sine.mean : curve.points.front().sine.mean;
    point.bound = first * fall(count) / fall(convergence.steps.front());
    curve.points.push_back(point);
  }
  curve.slope = slope_of(curve.points);
  return curve;
}

}  // namespace mapproof
