#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/records/studies/study_contents.hpp"
#include "core/studies/study_plan.hpp"

namespace mapproof {

/// A JSON file of a kind of study.
struct StudyFile {
  std::string_view schema;  ///< "mapproof.run".
  /// Reads it, with all its profiles if it has any. @throws IoError with the location.
  void (*check)(std::string_view text, const std::string& source);
};

/// What can be studied and how: its experiments, its folder, what results are in it. One file in
/// this folder each; a new one is added to study_kind.cpp.
struct StudyKind {
  std::string_view study;        ///< Schema of its study.json: "mapproof.slam_study".
  std::string_view title;        ///< "a range-only study".
  std::string_view experiment;   ///< Of its experiments; empty: other programs make such studies.
  std::vector<StudyFile> files;  ///< All of them, these two among them.
  std::vector<std::filesystem::path> records;  ///< Folders and files with what came out.

  /// Whether an experiment cannot be made without PlanOptions::data. @throws IoError.
  bool (*needs_data)(std::string_view text, const std::string& source) = nullptr;
  /// An experiment with its data, ready to be run. @throws IoError, InvalidInput.
  StudyPlan (*plan)(std::string_view text, const std::string& source,
                    const PlanOptions& options) = nullptr;

  /// What a folder with that study.json begins with; null where no experiment makes it.
  /// @throws IoError.
  StudyStart (*start)(std::string_view text, const std::string& source) = nullptr;
  /// Adds what a folder holds; `text` is its study.json. @throws IoError.
  void (*read)(const std::filesystem::path& folder, const std::string& text,
               const ContentsAsked& asked, StudyContents& contents) = nullptr;
  /// Reads all of a folder for what its files one by one do not show.
  /// @return What looks unusual, a line each. @throws IoError.
  std::vector<std::string> (*check)(const std::filesystem::path& folder) = nullptr;
};

/// Maps of simulated worlds by the mapping methods [yairi2007].
extern const StudyKind kMappingStudies;

/// Paths and maps from ranges, of logs and of simulated worlds [boots2013].
extern const StudyKind kRangeStudies;

/// Questions put to many simulated worlds or to data: a Topic of core/topics each.
extern const StudyKind kTopicStudies;

/// Tables of results that other programs wrote.
extern const StudyKind kTableStudies;

/// These, in the order in which they are asked.
std::span<const StudyKind* const> all_study_kinds();

/// The kind of an experiment's text. @throws IoError with the location if it is none.
const StudyKind& kind_of_experiment(std::string_view text, const std::string& source);

/// The kind of the study in a folder; null if its study.json is of no kind that is known.
/// @throws IoError if there is no study.json or it cannot be read.
const StudyKind* kind_of_study(const std::filesystem::path& folder);

/// The files, below a study's folder, that hold what came of a run: those that have its id as their
/// name or their folder's, in order; of a run that has none, every file of records.
std::vector<std::filesystem::path> files_of_run(const std::filesystem::path& folder,
                                                const std::string& run);

/// Reads the study in a folder, of any kind. Where it has no records but a results.csv, as a
/// report's page carries them, the rows come from that table.
/// @throws IoError if there is no study.json or it cannot be read.
StudyContents read_study_contents(const std::filesystem::path& folder, const ContentsAsked& asked);

/// The results.csv of a study, made of its records. @throws IoError.
std::string results_table_of(const std::filesystem::path& folder);

/// Writes results.csv of a study whose records are all there. @throws IoError.
void write_results_table(const std::filesystem::path& folder);

}  // namespace mapproof
