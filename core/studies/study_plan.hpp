#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/records/studies/study_writer.hpp"

namespace mapproof {

/// What the command line sets of an experiment in place of its file.
struct ExperimentChanges {
  std::optional<std::uint64_t> seed;
  std::optional<int> layouts;
  std::optional<int> poses;
};

/// How an experiment is to be planned.
struct PlanOptions {
  std::string profile = {};  ///< "": none.
  ExperimentChanges changes = {};
  /// One of several experiments: a change that it knows nothing of is left out, not refused.
  bool one_of_several = false;
  std::optional<std::filesystem::path> plaza = {};  ///< Folder of the Plaza data.
  std::optional<std::filesystem::path> data = {};   ///< Folder of data sets.
  /// Of the experiment's file: where its methods of others are started.
  std::filesystem::path folder = {};
  /// methods.json, whose methods are added; they are started in its folder.
  std::optional<std::filesystem::path> methods = {};
  /// Of what methods say, in records.
  std::function<std::string(std::string text)> disclosed = {};
  /// Of the commands of methods, in records.
  std::function<std::vector<std::string>(std::vector<std::string> words)> disclosed_command = {};
};

/// What one worker does.
struct Task {
  std::string id;  ///< Unlike those of the plan's other tasks.
  /// Whether the study's folder holds what it gives, whole.
  std::function<bool(const std::filesystem::path& folder)> is_done;
  std::function<StudyPart()> make;  ///< Depends on the plan alone, seconds apart.
};

/// A study that can be made: its experiment with the data it is made of, as tasks.
struct StudyPlan {
  std::string name;
  std::uint64_t seed = 0;
  std::optional<int> layouts = {};  ///< Of simulated runs.
  std::optional<int> poses = {};    ///< Likewise.
  bool uses_plaza = false;
  bool uses_data = false;
  bool uses_methods = false;  ///< PlanOptions::methods.
  std::function<StudyStart(const Provenance&)> start;
  std::vector<Task> tasks = {};
  std::string_view noun = "parts";  ///< What the tasks give.
  /// What is made alone after the tasks, so that nothing disturbs its seconds, if any task was
  /// done; may be empty.
  std::function<StudyPart()> last = {};
  std::vector<std::string> remarks = {};  ///< On its data, a sentence each.
};

/// How far a study has come.
struct Progress {
  int finished = 0;  ///< Those that are on disk, those of earlier sessions among them.
  int reused = 0;    ///< Of these, the ones that were there at the start.
  int total = 0;
  std::string_view noun = "parts";  ///< What is counted.
};

/// Makes whatever of the plan the writer's folder does not hold yet, `jobs` tasks at a time.
///
/// The folder ends up the same for any number of jobs and after any interruption.
/// @param jobs      Threads, >= 1; more than there are cores are granted too.
/// @param progress  Called at the start and after each task, one call at a time.
/// @throws IoError if data cannot be read or a record cannot be written; what was written stays.
void run_study(const StudyPlan& plan, StudyWriter& writer, int jobs,
               const std::function<void(const Progress&)>& progress);

}  // namespace mapproof
