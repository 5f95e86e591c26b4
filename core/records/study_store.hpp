#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "core/model/experiment.hpp"
#include "core/model/map_record.hpp"
#include "core/model/run_details.hpp"
#include "core/model/study.hpp"

namespace mapproof {

/// Everything that one run leaves behind.
struct RunResult {
  Run run;
  RunDetails details;
  std::vector<MapRecord> maps;
  std::vector<Timing> timings;
};

/// The folder of a study while it is being made (docs/file-formats.md says what is in it).
///
/// One process at a time: the folder is locked as long as the store lives. The bytes of every file
/// but timings.jsonl depend only on what is written, not on the order or the number of tries.
class StudyStore {
 public:
  /// Makes the folder, or resumes the study in it; leftovers of a killed process are removed.
  /// Runs that were made by another Provenance::solver_digest are removed too: see redone().
  /// @throws IoError if the folder holds another experiment, holds files but no study, is in use
  ///         by another process, or cannot be written.
  static StudyStore open(const std::filesystem::path& folder, const Experiment& experiment,
                         const Provenance& provenance);

  StudyStore(StudyStore&&) noexcept;
  StudyStore& operator=(StudyStore&&) noexcept;
  ~StudyStore();

  /// Whether runs of an older solver were removed when the folder was opened.
  bool redone() const;

  /// The runs that need not be made again, ascending; damaged files count as not made.
  std::vector<RunId> finished() const;

  /// Writes the maps, then the run (its presence means finished), then the timings. Thread-safe.
  /// @throws IoError; InvalidInput if the run is not one of this experiment.
  void write(const RunResult& result);

  /// Appends to timings.jsonl. Thread-safe. @throws IoError.
  void write_session(const Session& session);

 private:
  struct State;
  explicit StudyStore(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Whether the folder holds a study.json.
bool is_study(const std::filesystem::path& folder);

/// The schema that the folder's study.json says it is of, be the rest readable or not; empty if
/// there is none. @throws IoError.
std::string study_schema(const std::filesystem::path& folder);

/// The study in a folder: the runs finished so far, ascending, each as it was written.
/// @throws IoError if there is no study or a file of it is damaged.
Study read_study(const std::filesystem::path& folder);

/// What figures show of one run beyond its maps; empty in a study of an older version.
/// @throws IoError.
std::optional<RunDetails> read_details(const std::filesystem::path& folder, const RunId& run);

/// The maps of one run, in the order they were written. @throws IoError.
std::vector<MapRecord> read_maps(const std::filesystem::path& folder, const RunId& run);

/// Sorted by run, sensor, method, parameter, step; of a piece timed twice the later one. Empty
/// without a timings.jsonl; a last line torn by a kill is left out. @throws IoError.
std::vector<Timing> read_timings(const std::filesystem::path& folder);

/// In the order they were written; otherwise as read_timings(). @throws IoError.
std::vector<Session> read_sessions(const std::filesystem::path& folder);

}  // namespace mapproof
