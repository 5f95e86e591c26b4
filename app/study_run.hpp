#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "app/console.hpp"
#include "core/experiment/run_slam_experiment.hpp"
#include "core/model/experiment.hpp"
#include "core/model/study.hpp"
#include "core/trials/run_trials.hpp"

namespace mapproof {

/// Runs what a folder does not hold yet of an experiment, with a progress line, and notes the
/// session.
/// @param command  What makes the study again.
/// @throws IoError, InvalidInput.
void make_records(const Experiment& experiment, const std::filesystem::path& folder, int jobs,
                  const std::string& command, const Console& console);

/// The same of a range-only experiment and the logs of it that are there.
void make_slam_records(const SlamExperiment& experiment, const SlamData& data,
                       const std::filesystem::path& folder, int jobs, const std::string& command,
                       const Console& console);

/// The same of an experiment of trials.
void make_trial_records(const TrialOrder& order, const std::filesystem::path& folder, int jobs,
                        const std::string& command, const Console& console);

/// The study in numbers, for --json: runs, records, and per sensor and method the mean errors at
/// the last checkpoint.
nlohmann::ordered_json study_result(const Study& study);

/// The same as a few lines of text.
std::string study_text(const Study& study);

/// A range-only study in numbers: runs, and the errors of each method with their alignment.
nlohmann::ordered_json slam_study_result(const SlamStudy& study);

/// The same as a few lines of text.
std::string slam_study_text(const SlamStudy& study);

}  // namespace mapproof
