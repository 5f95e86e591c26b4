#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/model/study.hpp"

namespace mapproof {

/// The files that stand in the folder of every study.
inline constexpr const char* kStudyFile = "study.json";
inline constexpr const char* kTimingsFile = "timings.jsonl";
inline constexpr const char* kResultsFile = "results.csv";

/// Whether the folder holds a study.json, be it readable or not: what stands in its place and is
/// not a file is refused by its reader. @throws IoError as is_there().
bool is_study(const std::filesystem::path& folder);

/// Every reader of a study asks it first.
/// @throws IoError if the folder is not there, holds no study.json, or a link that leads out of it.
void require_study(const std::filesystem::path& folder);

/// The schema that the folder's study.json names, be the rest readable or not; empty if
/// there is none. @throws IoError.
std::string study_schema(const std::filesystem::path& folder);

/// Where the records of the mapping methods stand in a study's folder.
struct StudyFiles {
  std::filesystem::path folder;  ///< Empty: paths are below the folder.

  std::filesystem::path study() const { return folder / kStudyFile; }
  std::filesystem::path timings() const { return folder / kTimingsFile; }
  std::filesystem::path runs() const { return folder / "runs"; }
  std::filesystem::path maps() const { return folder / "maps"; }
  std::filesystem::path details() const { return folder / "details"; }
  std::vector<std::filesystem::path> records() const { return {runs(), maps(), details()}; }
  std::filesystem::path run(const RunId& id) const { return runs() / (slug(id) + ".json"); }
  std::filesystem::path map(const RunId& id) const { return maps() / (slug(id) + ".json"); }
  std::filesystem::path detail(const RunId& id) const { return details() / (slug(id) + ".json"); }

  /// The runs that have a file, ascending; other files are passed over. @throws IoError.
  std::vector<RunId> listed_runs() const;
};

/// The run of a file named slug(run) + ".json"; empty for any other name.
std::optional<RunId> run_of_file(const std::filesystem::path& file);

/// Whether the experiment has that run.
bool contains(const Experiment& experiment, const RunId& run);

/// Where things stand in the folder of a range-only study.
struct SlamFiles {
  std::filesystem::path folder;  ///< Empty: paths are below the folder.

  std::filesystem::path study() const { return folder / kStudyFile; }
  std::filesystem::path timings() const { return folder / kTimingsFile; }
  std::filesystem::path runs() const { return folder / "runs"; }
  std::vector<std::filesystem::path> records() const {
    return {runs(), paths(), curves(), histories(), space()};
  }
  std::filesystem::path run(const std::string& id) const { return runs() / (id + ".json"); }
  std::filesystem::path paths() const { return folder / "paths"; }
  std::filesystem::path paths(const std::string& id) const { return paths() / id; }
  std::filesystem::path curves() const { return folder / "convergence"; }
  std::filesystem::path curve(const std::string& id) const { return curves() / (id + ".json"); }
  std::filesystem::path histories() const { return folder / "histories.json"; }
  std::filesystem::path space() const { return folder / "space.json"; }
};

}  // namespace mapproof
