#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/trial_study.hpp"

namespace mapproof {

/// What an experiment file may give to a topic.
struct TopicInput {
  const std::vector<TrialOption>* options = nullptr;  ///< Null: there is no such topic.
  bool sweeps = false;                                ///< Sensors with methods, and sweeps.
};

/// Of a topic by its name.
using InputOfTopic = std::function<TopicInput(std::string_view topic)>;

/// An experiment of trials from the text of its file, mapproof.trial_experiment
/// (docs/file-formats.md), every bound checked, options that it leaves out at their usual values.
/// @param source, profile  As parse_experiment().
/// @throws IoError with the place if the text is no such experiment or lacks that profile.
TrialExperiment parse_trial_experiment(std::string_view text, const std::string& source,
                                       const InputOfTopic& input_of,
                                       const std::string& profile = "");

}  // namespace mapproof
