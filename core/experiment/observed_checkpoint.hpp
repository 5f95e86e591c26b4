#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/model/experiment.hpp"
#include "core/model/observation_history.hpp"
#include "core/model/study.hpp"

namespace mapproof {

/// What a method of others gets of the first observations: one row per landmark.
/// @param steps  1 <= steps <= history.steps().
Eigen::MatrixXd external_input(const ObservationHistory& history, int steps, ExternalInput input);

/// "layout-1-pose-1/bearing/2000": of what a map is made.
std::string checkpoint_id(const RunId& run, Sensor sensor, int steps);

/// Of that checkpoint alone, below 2^53.
std::uint64_t checkpoint_seed(std::uint64_t seed, const RunId& run, Sensor sensor, int steps);

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
