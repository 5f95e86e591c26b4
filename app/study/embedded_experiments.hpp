#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/resource.hpp"

namespace mapproof {

/// The experiments in the program: "yairi2007.json".
std::span<const Resource> embedded_experiments();

/// An experiment's text and where it came from.
struct ExperimentText {
  std::string text;
  std::string source;
  std::filesystem::path folder = {};  ///< Of its file; empty: of none, or the current one.
};

/// The names of the papers' experiments, by the year that they end in.
std::vector<std::string> paper_names();

/// The names of all experiments that `reproduce` knows: the papers', then the others by the
/// alphabet.
std::vector<std::string> experiment_names();

/// The experiment of that name: from DIR/experiments/NAME.json if `templates` holds it, else the
/// embedded one.
/// @throws InvalidInput if there is none of that name; IoError if the file cannot be read.
ExperimentText experiment_text(const std::string& name,
                               const std::optional<std::filesystem::path>& templates);

/// Whether the words name a file rather than an experiment: a file that is there, a pipe, or what
/// has a dot or a slash, which names have not.
bool is_experiment_file(const std::string& file_or_name);

/// The experiment in a file, or else the embedded one of that name.
/// @throws InvalidInput, IoError as experiment_text().
ExperimentText experiment_of(const std::string& file_or_name);

/// The studies right below a folder that holds none itself, in the order of the experiments that
/// `reproduce` knows. @throws IoError if it cannot be listed.
std::vector<std::filesystem::path> study_folders(const std::filesystem::path& folder);

}  // namespace mapproof
