#include "core/experiment/run.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/base/errors.hpp"
#include "core/embed/embedder.hpp"
#include "core/observe/proximities.hpp"
#include "core/score/map_score.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"

namespace mapproof {
namespace {

using Clock = std::chrono::steady_clock;

/// What the parts of a run draw their random numbers for.
enum Purpose : std::uint64_t { kLayout = 1, kWalk = 2, kNoise = 3 };

/// A map as it goes to disk, aligned to the anchors and scored.
MapRecord scored_map(const Experiment& experiment, const Run& run,
                     const ObservationHistory& history, const MethodSetting& setting, int step,
                     const Embedding& embedding) {
  AlignedMap aligned = align_to_anchors(embedding.coordinates, run.world.landmarks_m, run.anchors,
                                        experiment.affine_fit);
  MapRecord map{.id = record_id(run.id, history.sensor, setting, step),
                .sensor = history.sensor,
                .setting = setting,
                .step = step,
                .frame = aligned.aligned ? Frame::kTruth : Frame::kSimilarity,
                .names = history.names,
                .estimate = std::move(aligned.positions_m),
                .truth_m = run.world.landmarks_m,
                .anchors = run.anchors,
                .statuses = embedding.statuses,
                .score = std::nullopt};
  map.statuses.insert(map.statuses.end(), aligned.statuses.begin(), aligned.statuses.end());
  if (aligned.aligned)
    map.score = score_map(map.estimate, *map.truth_m, run.anchors, experiment.affine_fit);
  return map;
}

void map_at(const Experiment& experiment, const ObservationHistory& history,
            const SensorStudy& study, int step, RunResult& result) {
  HistoryEmbedder embedder(history, step);
  for (const MethodSetting& setting : settings_of(study)) {
    const Clock::time_point start = Clock::now();
    const Embedding embedding = embedder.embed(setting);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    MapRecord map = scored_map(experiment, result.run, history, setting, step, embedding);
    result.timings.push_back({result.run.id, history.sensor, setting, step, seconds});
    result.run.records.push_back({.sensor = history.sensor,
                                  .setting = setting,
                                  .step = step,
                                  .statuses = map.statuses,
                                  .score = map.score,
                                  .iterations = embedding.iterations,
                                  .stress = embedding.stress,
                                  .certificate = embedding.certificate});
    result.maps.push_back(std::move(map));
  }
}

}  // namespace

std::vector<RunId> runs_of(const Experiment& experiment) {
  std::vector<RunId> runs;
  for (int layout = 1; layout <= experiment.layouts; ++layout)
    for (int pose = 1; pose <= experiment.poses; ++pose) runs.push_back({layout, pose});
  return runs;
}

RunResult simulate_run(const Experiment& experiment, const RunId& id) {
  const auto layout = static_cast<std::uint64_t>(id.layout);
  const auto pose = static_cast<std::uint64_t>(id.pose);

  // The same layout for all its poses.
  Random scatter(derive_seed(experiment.seed, {kLayout, layout}));
  RunResult result;
  result.run.id = id;
  result.run.world = scatter_landmarks(experiment.world, scatter);
  result.run.anchors = corner_anchors(result.run.world, experiment.anchors);

  // One walk, long enough for every sensor, so that sensors can be compared on it.
  int observations = 1;
  for (const SensorStudy& study : experiment.sensors) {
    if (study.checkpoints.empty()) throw InvalidInput("a sensor's study without checkpoints");
    observations = std::max(observations, study.checkpoints.back());
  }
  Random wander(derive_seed(experiment.seed, {kWalk, layout, pose}));
  const Path path = random_walk(result.run.world, experiment.walk, observations, wander);

  for (const SensorStudy& study : experiment.sensors) {
    const auto sensor = static_cast<std::uint64_t>(study.sensor.sensor);
    Random noise(derive_seed(experiment.seed, {kNoise, layout, pose, sensor}));
    const ObservationHistory history = observe(result.run.world, path, study.sensor, noise);
    for (const int step : study.checkpoints) map_at(experiment, history, study, step, result);
  }
  return result;
}

}  // namespace mapproof
