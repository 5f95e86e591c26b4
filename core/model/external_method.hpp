#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/method.hpp"

namespace mapproof {

/// What a method of somebody else gets for each map (docs/external-methods.md).
enum class ExternalInput {
  kDistances,  ///< M x M distances of the observation vectors; infinite: no common step.
  kFeatures,   ///< M x C observation vectors; 0 where nothing was observed.
  kHistory,    ///< M x N observations as they came; NaN: nothing observed.
};

/// "distances", "features", "history".
std::string_view name(ExternalInput input);

/// A mapping method that is a command.
struct ExternalMethod {
  std::string name;
  std::string label;
  std::string source;
  ExternalInput input = ExternalInput::kDistances;
  std::vector<std::string> command;
  std::vector<std::string> files;  ///< What it is made of, below its folder.
  double timeout_s = 60.0;         ///< For each map.
  std::string symbol;              ///< Of its parameter; empty: it has none.
  std::vector<double> values;      ///< Of the parameter.
  /// Where the command is started: the folder of the file that names it. Not in files. Empty: it
  /// must not be started, since nobody but a study's records named it.
  std::optional<std::filesystem::path> folder = {};
};

/// As records have it.
Method method_of(const ExternalMethod& method);

}  // namespace mapproof
