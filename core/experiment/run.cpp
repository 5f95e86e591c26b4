#include "core/experiment/run.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/base/errors.hpp"
#include "core/embed/embedder.hpp"
#include "core/experiment/run_details.hpp"
#include "core/experiment/scored_map.hpp"
#include "core/experiment/seeds.hpp"
#include "core/experiment/variations.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"

namespace mapproof {
namespace {

using Clock = std::chrono::steady_clock;

/// Builds, scores and keeps the maps of one sensor after `step` observations.
void map_at(const Experiment& experiment, const ObservationHistory& history,
            const SensorStudy& study, int step, RunResult& result) {
  const Run& run = result.run;
  HistoryEmbedder embedder(history, step, embedder_options(experiment.solver));
  for (const MethodSetting& setting : settings_of(study)) {
    const Clock::time_point start = Clock::now();
    const Embedding embedding = embedder.embed(setting);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    ScoredMap map =
        scored_map(embedding, run.world.landmarks_m, run.anchors, experiment.affine_fit);
    result.timings.push_back({run.id, history.sensor, setting, step, seconds});
    result.run.records.push_back({.sensor = history.sensor,
                                  .setting = setting,
                                  .step = step,
                                  .statuses = map.statuses,
                                  .score = map.score,
                                  .iterations = embedding.iterations,
                                  .stress = embedding.stress,
                                  .certificate = embedding.certificate});
    if (step == study.checkpoints.back() && embedding.spectrum.size() > 0)
      result.details.sensors.back().spectra.emplace_back(setting, embedding.spectrum);
    result.maps.push_back({.id = record_id(run.id, history.sensor, setting, step),
                           .origin = FromSensor{history.sensor, setting},
                           .step = step,
                           .frame = map.frame,
                           .names = history.names,
                           .estimate = std::move(map.positions_m),
                           .truth_m = run.world.landmarks_m,
                           .anchors = run.anchors,
                           .statuses = std::move(map.statuses),
                           .certificate = std::nullopt,
                           .score = map.score});
  }
}

/// One walk, long enough for every part of the experiment, so that sensors can be compared on it.
int observations_of(const Experiment& experiment) {
  int observations = 1;
  for (const SensorStudy& study : experiment.sensors) {
    if (study.checkpoints.empty()) throw InvalidInput("a sensor's study without checkpoints");
    observations = std::max(observations, study.checkpoints.back());
  }
  for (const Variation& variation : experiment.variations)
    observations = std::max(observations, variation.step);
  return observations;
}

}  // namespace

std::vector<RunId> runs_of(const Experiment& experiment) {
  std::vector<RunId> runs;
  for (int layout = 1; layout <= experiment.layouts; ++layout)
    for (int pose = 1; pose <= experiment.poses; ++pose) runs.push_back({layout, pose});
  return runs;
}

RunWorld make_run_world(const Experiment& experiment, const RunId& id) {
  const auto layout = static_cast<std::uint64_t>(id.layout);
  const auto pose = static_cast<std::uint64_t>(id.pose);
  // The same layout for all its poses.
  Random scatter(derive_seed(experiment.seed, {kLayout, layout}));
  Random choice(derive_seed(experiment.seed, {kPlacement, layout}));
  Random wander(derive_seed(experiment.seed, {kWalk, layout, pose}));
  RunWorld made;
  made.world = scatter_landmarks(experiment.world, scatter);
  made.anchors = place_anchors(made.world, experiment.anchors, experiment.anchor_placement, choice);
  made.path = random_walk(made.world, experiment.walk, observations_of(experiment), wander);
  return made;
}

ObservationHistory observed_in(const Experiment& experiment, const RunId& id, const RunWorld& made,
                               const SensorOptions& sensor) {
  Random noise(derive_seed(experiment.seed, {kNoise, static_cast<std::uint64_t>(id.layout),
                                             static_cast<std::uint64_t>(id.pose),
                                             static_cast<std::uint64_t>(sensor.sensor)}));
  return observe(made.world, made.path, sensor, noise);
}

RunResult simulate_run(const Experiment& experiment, const RunId& id) {
  const RunWorld made = make_run_world(experiment, id);
  RunResult result;
  Run& run = result.run;
  run.id = result.details.id = id;
  run.world = made.world;
  run.anchors = made.anchors;
  result.details.path = made.path;
  const Path& path = result.details.path;

  for (const SensorStudy& study : experiment.sensors) {
    const ObservationHistory history = observed_in(experiment, id, made, study.sensor);
    if (study.sensor.sensor == Sensor::kVisibility && study.sensor.occlusion)
      run.occlusion = count_occlusion(run.world, path, study.sensor);
    result.details.sensors.push_back(sensor_details(study, run.world, path, history));
    for (const int step : study.checkpoints) map_at(experiment, history, study, step, result);
  }
  run.variations = vary(experiment, run, path);
  return result;
}

}  // namespace mapproof
