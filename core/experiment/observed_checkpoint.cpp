#include "core/experiment/observed_checkpoint.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/random.hpp"
#include "core/experiment/run.hpp"
#include "core/experiment/seeds.hpp"
#include "core/observe/features.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {
namespace {

ObservationHistory first_steps(const ObservationHistory& history, int steps) {
  return {
      .sensor = history.sensor, .names = history.names, .values = history.values.leftCols(steps)};
}

}  // namespace

Eigen::MatrixXd external_input(const ObservationHistory& history, int steps, ExternalInput input) {
  switch (input) {
    case ExternalInput::kDistances: {
      Eigen::MatrixXd distances = proximities(history, steps).squared_distances.cwiseSqrt();
      for (const Eigen::Index i : unseen_landmarks(history, steps)) {
        distances.row(i).setConstant(kInfinity);
        distances.col(i).setConstant(kInfinity);
        distances(i, i) = 0.0;
      }
      return distances;
    }
    case ExternalInput::kFeatures:
      return features(history, steps).values;
    case ExternalInput::kHistory:
      return history.values.leftCols(steps);
  }
  throw InvalidInput("unknown input of a method");
}

std::string checkpoint_id(const RunId& run, Sensor sensor, int steps) {
  return fmt::format("{}/{}/{}", slug(run), name(sensor), steps);
}

std::uint64_t checkpoint_seed(std::uint64_t seed, const RunId& run, Sensor sensor, int steps) {
  constexpr int kUnusedBits = 11;  // 53 are exact in JSON of any language.
  return derive_seed(seed,
                     {kExternalMap, static_cast<std::uint64_t>(run.layout),
                      static_cast<std::uint64_t>(run.pose), static_cast<std::uint64_t>(sensor),
                      static_cast<std::uint64_t>(steps)}) >>
         kUnusedBits;
}

void observe_run(const Experiment& experiment, const RunId& run,
                 const std::function<void(const ObservedCheckpoint&)>& use) {
  const RunWorld made = make_run_world(experiment, run);
  for (const SensorStudy& study : experiment.sensors) {
    const ObservationHistory history = observed_in(experiment, run, made, study.sensor);
    for (const int steps : study.checkpoints)
      use({.run = run,
           .sensor = study.sensor.sensor,
           .steps = steps,
           .history = first_steps(history, steps),
           .ground_truth_m = made.world.landmarks_m,
           .anchors = made.anchors,
           .seed = checkpoint_seed(experiment.seed, run, study.sensor.sensor, steps)});
  }
}

}  // namespace mapproof
