#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.hpp"
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

/// The names of the profiles in such a file, sorted. @throws IoError as above.
std::vector<std::string> slam_profiles(std::string_view text, const std::string& source);

/// Whether a JSON text says that it is such a file. @throws IoError if it is no JSON of ours.
bool is_slam_experiment(std::string_view text, const std::string& source);

/// The value in that file, and back from a document without profiles.
nlohmann::ordered_json slam_experiment_value(const SlamExperiment& experiment);
SlamExperiment read_slam_experiment(const JsonCursor& document);

}  // namespace mapproof
