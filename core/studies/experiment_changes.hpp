#pragma once

#include "core/model/experiment.hpp"
#include "core/model/slam/slam_experiment.hpp"
#include "core/model/topic_study.hpp"
#include "core/studies/study_plan.hpp"

namespace mapproof {

/// @throws InvalidInput if the experiment becomes too large.
void apply(const ExperimentChanges& changes, Experiment& experiment);

/// The same of a range-only experiment, which has no layouts and poses.
void apply(const ExperimentChanges& changes, SlamExperiment& experiment);

/// The same of an experiment of a topic; one that is made of data has no layouts and poses.
void apply(const ExperimentChanges& changes, TopicExperiment& experiment, bool of_data);

/// The changes that every experiment knows.
ExperimentChanges seed_alone(const ExperimentChanges& changes);

}  // namespace mapproof
