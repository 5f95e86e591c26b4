#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/external/method_process.hpp"
#include "core/model/experiment.hpp"
#include "core/model/map_record.hpp"
#include "core/model/observation_history.hpp"
#include "core/model/study.hpp"
#include "core/results/results.hpp"

namespace mapproof {

/// What one sensor of one run observed up to a checkpoint, for whoever maps it.
struct ObservedCheckpoint {
  RunId run;
  Sensor sensor = Sensor::kVisibility;
  int steps = 0;
  std::string id;              ///< "layout-1-pose-1/bearing/2000".
  ObservationHistory history;  ///< Of those steps alone.
  Points ground_truth_m;       ///< M x 2.
  std::vector<Eigen::Index> anchors;
  std::uint64_t seed = 0;  ///< Below 2^53, of this checkpoint alone.
};

/// Simulates the run of an experiment again, without mapping, and shows every checkpoint of every
/// sensor in order. @throws InvalidInput as simulate_run().
void observe_run(const Experiment& experiment, const RunId& run,
                 const std::function<void(const ObservedCheckpoint&)>& use);

/// What a method gets of a checkpoint: one row per landmark.
Eigen::MatrixXd external_input(const ObservedCheckpoint& checkpoint, ExternalInput input);

/// One map of somebody else, aligned and scored as the study's own are.
struct ExternalMap {
  std::string method;  ///< With its parameter: "tsne-perplexity10".
  RunId run;
  Sensor sensor = Sensor::kVisibility;
  int steps = 0;
  std::string id;                     ///< Of the checkpoint.
  std::optional<MapRecord> map = {};  ///< Empty if there is none.
  std::string failure = {};           ///< Why, one line.
};

/// Aligns coordinates to the anchors and scores them against the ground truth.
/// @param coordinates  M x 2, any frame; NaN rows: no position.
ExternalMap scored_external_map(const Experiment& experiment, const ObservedCheckpoint& checkpoint,
                                const std::string& method, const Points& coordinates);

/// Adds the scores of a map under the condition, run and group that the study's own have; those of
/// a map that there is not are lost.
void add_rows(const ExternalMap& map, std::vector<Result>& rows);

}  // namespace mapproof
