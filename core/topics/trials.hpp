#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/records/studies/trial_json.hpp"
#include "core/records/studies/trial_store.hpp"
#include "core/topics/study_kind.hpp"
#include "core/trials/topic.hpp"

namespace mapproof {

/// What every topic takes, for the reader of experiments.
InputOfTopic input_of_topics();

/// An experiment with the data sets that it is made of, if its topic wants any.
struct TrialOrder {
  TrialExperiment experiment;
  std::vector<TrialData> data;
};

/// Looks up the data sets of an experiment's topic, and notes them in the experiment.
/// @param folder  Of the data; must be given exactly if the topic is of data.
/// @throws InvalidInput if it is not; IoError if it holds no set.
TrialOrder with_data(TrialExperiment experiment,
                     const std::optional<std::filesystem::path>& folder);

/// A study of the experiment without any part yet. @throws InvalidInput if there is no such topic.
TrialStudy planned_study(const TrialExperiment& experiment, const Provenance& provenance);

/// One simulated run of an experiment: layout, walk and anchors are those that an experiment of
/// the 2007 paper has with the same seed, world and walk.
TrialPart simulate_part(const TrialExperiment& experiment, const RunId& run);

/// One data set; its random numbers do not depend on the others that are there.
/// @throws IoError if it cannot be read.
TrialPart make_of_data(const TrialExperiment& experiment, const TrialData& data);

}  // namespace mapproof
