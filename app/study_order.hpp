#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/command_line.hpp"
#include "app/embedded_experiments.hpp"
#include "core/experiment/run_slam_experiment.hpp"
#include "core/model/experiment.hpp"
#include "core/trials/run_trials.hpp"

namespace mapproof {

/// What the command line says about any experiment.
struct OrderOptions {
  std::string profile;            ///< "": none.
  bool profile_if_there = false;  ///< An experiment without that profile is taken as it stands.
  ExperimentChanges changes = {};
  bool one_of_several = false;  ///< Changes that an experiment knows nothing of are then left out.
  std::optional<std::string> plaza = {};  ///< Folder of the Plaza data.
  std::optional<std::string> data = {};   ///< Folder of data sets, for studies made of them.
};

/// Adds --plaza and --data to a verb.
void add_data_options(CLI::App& app, OrderOptions& options);

/// A range-only experiment and the logs of it that are there.
struct LoggedSlam {
  SlamExperiment experiment;
  SlamData data;
};

/// A study that another program made: its folder is copied.
struct GivenStudy {
  std::filesystem::path folder;
};

/// An experiment of any kind with the data that it is made of, ready to be run.
struct StudyOrder {
  std::string name;
  std::string digest;  ///< SHA-256 of its text and profile.
  std::variant<Experiment, LoggedSlam, TrialOrder, GivenStudy> experiment;
};

/// Reads an experiment of any kind and looks up its data; nothing is made. Folders of data that it
/// has no use for are left alone: see check_data_used().
/// @throws IoError, InvalidInput, CLI::ValidationError.
StudyOrder read_study_order(const ExperimentText& file, const OrderOptions& options);

/// The order to take the table of results in a folder as a study. @throws IoError.
StudyOrder given_study_order(const std::filesystem::path& folder);

/// Whether it is an experiment of trials on data sets. @throws IoError if it is no experiment.
bool is_made_of_data(const ExperimentText& file);

/// Throws if a folder of data was given that none of the experiments uses. @throws InvalidInput.
void check_data_used(std::span<const StudyOrder> orders, const OrderOptions& options);

/// The words after the verb and its name that give the same studies again: --profile, --seed and
/// the rest.
std::vector<std::string> words_of(std::span<const StudyOrder> orders, const OrderOptions& options);

/// The text of the study.json that make_study() writes. @throws InvalidInput.
std::string study_json(const StudyOrder& order);

/// Runs what a folder does not hold yet, with a progress line, and notes the session.
/// @param command  What makes the study again. @throws IoError, InvalidInput.
void make_study(const StudyOrder& order, const std::filesystem::path& folder, int jobs,
                const std::string& command, const Console& console);

/// A study in numbers: as a few lines of text, and for --json.
struct StudyNumbers {
  std::string text;
  nlohmann::ordered_json object;
  std::vector<std::string> missing;  ///< Data asked for that are not there.
};

/// @throws IoError.
StudyNumbers read_study_numbers(const std::filesystem::path& folder);

}  // namespace mapproof
