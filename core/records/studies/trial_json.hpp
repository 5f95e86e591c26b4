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

/// The files of a study of trials (docs/file-formats.md). All parsers throw IoError with the place.

/// study.json (mapproof.trial_study): experiment, design and provenance; parts are not
/// in it.
std::string trial_study_json(const TrialStudy& study);
TrialStudy parse_trial_study(std::string_view text, const std::string& source);

/// parts/ID.json (mapproof.trial_part), without its seconds.
/// @param digest  Of the data set that it was made of; empty: simulated.
std::string trial_part_json(const TrialPart& part, const std::string& digest);

/// A part, and the digest of its data.
struct ReadTrialPart {
  TrialPart part;
  std::string digest;
};

/// @param design  Every trial's setup, series, level and number of values is checked against it;
///                null: a file alone, that nothing is known about.
ReadTrialPart parse_trial_part(std::string_view text, const std::string& source,
                               const TrialDesign* design);

}  // namespace mapproof
