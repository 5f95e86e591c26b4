#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/records/studies/topic_json.hpp"
#include "core/records/studies/topic_store.hpp"
#include "core/studies/study_kind.hpp"
#include "core/topics/topic.hpp"

namespace mapproof {

/// What every topic takes, for the reader of experiments.
InputOfTopic input_of_topics();

/// An experiment with the data sets that it is made of, if its topic wants any.
struct ExperimentWithData {
  TopicExperiment experiment;
  std::vector<DataSetFolder> data;
};

/// Looks up the data sets of an experiment's topic, and notes them in the experiment.
/// @param folder  Of the data; must be given exactly if the topic is of data.
/// @throws InvalidInput if it is not; IoError if it holds no set.
ExperimentWithData with_data(TopicExperiment experiment,
                             const std::optional<std::filesystem::path>& folder);

/// A study of the experiment without any part yet. @throws InvalidInput if there is no such topic.
TopicStudy planned_study(const TopicExperiment& experiment, const Provenance& provenance);

/// One simulated run of an experiment: layout, walk and anchors are those that an experiment of
/// the 2007 paper has with the same seed, world and walk.
TopicPart simulate_part(const TopicExperiment& experiment, const RunId& run);

/// One data set; its random numbers do not depend on the others that are there.
/// @throws IoError if it cannot be read.
TopicPart make_of_data(const TopicExperiment& experiment, const DataSetFolder& data);

}  // namespace mapproof
