#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/model/study.hpp"
#include "core/records/studies/study_folder.hpp"

namespace mapproof {

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

}  // namespace mapproof
