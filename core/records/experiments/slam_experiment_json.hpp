#pragma once

#include <string>
#include <string_view>

#include "core/model/slam_experiment.hpp"

namespace mapproof {

/// A range-only experiment from the text of its file, mapproof.slam_experiment
/// (docs/file-formats.md), every bound checked.
/// @param source, profile  As parse_experiment().
/// @return Methods in the order of all_slam_methods() and all_methods().
/// @throws IoError with the place if the text is no such experiment or lacks that profile.
SlamExperiment parse_slam_experiment(std::string_view text, const std::string& source,
                                     const std::string& profile = "");

/// The file that parses to exactly this experiment: canonical, every default written out.
std::string slam_experiment_json(const SlamExperiment& experiment);

}  // namespace mapproof
