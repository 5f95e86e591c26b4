#include "core/studies/experiment_changes.hpp"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/records/limits.hpp"

namespace mapproof {
namespace {

template <typename Simulated>
void apply_all(const ExperimentChanges& changes, Simulated& experiment) {
  experiment.seed = changes.seed.value_or(experiment.seed);
  experiment.layouts = changes.layouts.value_or(experiment.layouts);
  experiment.poses = changes.poses.value_or(experiment.poses);
  if (static_cast<long>(experiment.layouts) * experiment.poses > kMostRuns)
    throw InvalidInput(fmt::format("--layouts: more than {} runs, with all poses", kMostRuns));
}

/// @throws InvalidInput if layouts or poses are to change where there are none.
void refuse_runs(const ExperimentChanges& changes, const std::string& name) {
  for (const auto& [option, given] :
       {std::pair("--layouts", changes.layouts), std::pair("--poses", changes.poses)})
    if (given) throw InvalidInput(std::string(option) + ": the experiment " + name + " has none");
}

}  // namespace

void apply(const ExperimentChanges& changes, Experiment& experiment) {
  apply_all(changes, experiment);
}

void apply(const ExperimentChanges& changes, SlamExperiment& experiment) {
  experiment.seed = changes.seed.value_or(experiment.seed);
  refuse_runs(changes, experiment.name);
}

void apply(const ExperimentChanges& changes, TopicExperiment& experiment, bool of_data) {
  if (of_data) refuse_runs(changes, experiment.name);
  apply_all(changes, experiment);
}

ExperimentChanges seed_alone(const ExperimentChanges& changes) {
  return {.seed = changes.seed, .layouts = std::nullopt, .poses = std::nullopt};
}

}  // namespace mapproof
