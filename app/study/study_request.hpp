#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/command_line.hpp"
#include "app/study/embedded_experiments.hpp"
#include "core/model/shard.hpp"
#include "core/results/results.hpp"
#include "core/studies/study_plan.hpp"

namespace mapproof {

/// Options of the command line for any experiment.
struct StudyOptions {
  std::string profile;            ///< "": none.
  bool profile_if_there = false;  ///< An experiment without that profile is taken as it stands.
  ExperimentChanges changes = {};
  bool one_of_several = false;  ///< Changes that an experiment knows nothing of are then left out.
  std::optional<std::string> plaza = {};    ///< Folder of the Plaza data.
  std::optional<std::string> data = {};     ///< Folder of data sets, for studies made of them.
  std::optional<std::string> methods = {};  ///< methods.json: methods of others to be added.
};

/// Adds --plaza, --data and --methods to a command.
void add_data_options(CLI::App& app, StudyOptions& options);

/// What is wrong with files that another program wrote to between two times that they were read.
inline constexpr const char* kChangedWhileRead = "was changed while it was read: run this again";

/// Reads a file by `read`. @return Its SHA-256. @throws IoError if it was changed meanwhile.
std::string read_unchanged(const std::filesystem::path& file, const std::function<void()>& read);

/// A study of any type, ready to be made.
struct StudyRequest {
  std::string name = {};
  std::string digest = {};                 ///< SHA-256 of its text and profile.
  StudyPlan plan = {};                     ///< Of an experiment.
  std::optional<ShardSession> shard = {};  ///< The plan is its share of a study.
  std::filesystem::path given = {};        ///< A study that another program made, which is copied.
  std::map<std::string, std::string> texts =
      {};  ///< The files of a study that is at hand, by name.
  /// The rows of its results.csv, if that is none of `texts`.
  std::shared_ptr<const std::vector<Result>> table = {};
  /// What nightly runs of it are compared by, where it is not what its study.json says; may be
  /// empty.
  std::string compared_by = {};
};

/// Reads an experiment of any type and looks up its data; nothing is made. What the records say of
/// methods of others is disclosed. Folders of data that it
/// has no use for are left alone: see check_data_used().
/// @throws IoError, InvalidInput, CLI::ValidationError.
StudyRequest read_study_request(const ExperimentText& file, const StudyOptions& options,
                                const Disclosure& disclosure);

/// The request to take the table of results in a folder as a study. @throws IoError.
StudyRequest given_study_request(const std::filesystem::path& folder);

/// SHA-256 of the files of the study of results in a folder. @throws IoError.
std::string results_study_digest(const std::filesystem::path& folder);

/// Whether an experiment cannot be made without StudyOptions::data. @throws IoError if it is none.
bool needs_data(const ExperimentText& file);

/// Throws if data or methods were given that none of the experiments uses. @throws InvalidInput.
void check_data_used(std::span<const StudyRequest> requests, const StudyOptions& options);

/// The words after the command and its name that give the same studies again: --profile, --seed and
/// the rest.
std::vector<std::string> words_of(std::span<const StudyRequest> requests,
                                  const StudyOptions& options);

/// The text of the study.json that make_study() writes. @throws InvalidInput.
std::string study_json(const StudyRequest& request);

}  // namespace mapproof
