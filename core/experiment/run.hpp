#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/model/experiment.hpp"
#include "core/model/observation_history.hpp"
#include "core/model/world.hpp"
#include "core/records/studies/study_store.hpp"

namespace mapproof {

class MethodProcesses;

/// All runs of an experiment, ascending.
std::vector<RunId> runs_of(const Experiment& experiment);

/// A run before anything is observed in it.
struct RunWorld {
  World world;
  Path path;  ///< As long as the experiment's latest step.
  std::vector<Eigen::Index> anchors;
};

/// Scatters the landmarks and walks. The layout draws one stream of random numbers and the walk
/// another, whatever the options: experiments that differ in noise, reach, anchors or steps have
/// the same layout and walk, of which fewer steps are a beginning; fewer landmarks are the first
/// of more; rooms of other sizes are filled from the same draws.
/// @throws InvalidInput if the landmarks do not fit the room or a sensor has no checkpoint.
RunWorld make_run_world(const Experiment& experiment, const RunId& id);

/// What a sensor observes along the walk. Another noise scales the same draws.
ObservationHistory observed_in(const Experiment& experiment, const RunId& id, const RunWorld& made,
                               const SensorOptions& sensor);

/// One run: scatters the landmarks, walks, observes, maps and scores at every checkpoint
/// [yairi2007, section 3].
///
/// Pure but for the timings: the same experiment and id give the same records and maps. The world
/// depends on the seed and the layout alone, the walk on the pose too, and a sensor's noise on the
/// sensor too, so that adding a sensor or a method changes nothing else.
/// @param others  Processes of the experiment's methods of others; null where it has none.
/// @throws InvalidInput if the landmarks do not fit the room, a sensor has no checkpoint, or a
///         method of others has no process.
RunResult simulate_run(const Experiment& experiment, const RunId& id,
                       MethodProcesses* others = nullptr);

/// What one sensor of one run observed up to a checkpoint, for whoever maps it.
struct ObservedCheckpoint {
  RunId run;
  Sensor sensor = Sensor::kVisibility;
  int steps = 0;
  ObservationHistory history;  ///< Of those steps alone.
  Points ground_truth_m;       ///< M x 2.
  std::vector<Eigen::Index> anchors;
  std::uint64_t seed = 0;  ///< See checkpoint_seed().
};

/// Simulates the run of an experiment again, without mapping, and shows every checkpoint of every
/// sensor in order. @throws InvalidInput as simulate_run().
void observe_run(const Experiment& experiment, const RunId& run,
                 const std::function<void(const ObservedCheckpoint&)>& use);

}  // namespace mapproof
