#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/console.hpp"
#include "core/experiment/run_slam_experiment.hpp"
#include "core/model/experiment.hpp"

namespace mapproof {

/// A range-only experiment and the logs of it that are there.
struct NightlySlam {
  SlamExperiment experiment;
  SlamData data;
};

/// One experiment of a night.
struct NightlyOrder {
  std::string name;    ///< Of its folder and in the history.
  std::string digest;  ///< SHA-256 of its text and profile.
  std::variant<Experiment, NightlySlam> experiment;
};

/// Reads what is asked for, all of it before anything is made.
/// @param experiments  Names of embedded ones, or files.
/// @param profile      Taken of those that have it; "": none.
/// @throws IoError, InvalidInput: among others if two have one name.
std::vector<NightlyOrder> read_nightly_orders(const std::vector<std::string>& experiments,
                                              const std::string& profile,
                                              const std::optional<std::string>& plaza);

/// Makes the records of a study in a process of its own, so that the peak of its memory is its own
/// and its crash is its own.
/// @return The ExitCode of that process, kInternal if a signal ended it. @throws IoError.
int make_apart(const NightlyOrder& order, const std::filesystem::path& folder, int jobs,
               const std::string& command, const Console& console);

}  // namespace mapproof
