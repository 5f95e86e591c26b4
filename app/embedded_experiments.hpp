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
};

/// The names of the experiments that `reproduce` knows, by the year of their papers.
std::vector<std::string> experiment_names();

/// The experiment of that name: from DIR/experiments/NAME.json if `templates` holds it, else the
/// embedded one.
/// @throws InvalidInput if there is none of that name; IoError if the file cannot be read.
ExperimentText experiment_text(const std::string& name,
                               const std::optional<std::filesystem::path>& templates);

}  // namespace mapproof
