#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/model/trial_study.hpp"

namespace mapproof {

/// The folder of a study of trials while it is being made (docs/file-formats.md says what is in
/// it). One process at a time, as StudyStore; the bytes of every file but timings.jsonl depend only
/// on what is written.
class TrialStore {
 public:
  /// Makes the folder, or resumes the study in it; records of another solver are removed.
  /// @param study  Experiment, design and provenance are read.
  /// @throws IoError if the folder holds another experiment, holds files but no study, is in use
  ///         by another process, or cannot be written.
  static TrialStore open(const std::filesystem::path& folder, const TrialStudy& study);

  TrialStore(TrialStore&&) noexcept;
  TrialStore& operator=(TrialStore&&) noexcept;
  ~TrialStore();

  /// Whether records of an older solver were removed when the folder was opened.
  bool redone() const;

  /// Whether a part need not be made again; a damaged file counts as not made.
  /// @param digest  Of the data set; empty: simulated.
  bool has(const std::string& part, const std::string& digest) const;

  /// Writes the part, then its seconds. Thread-safe. @throws IoError.
  void write(const TrialPart& part, const std::string& digest);

  /// Appends to timings.jsonl. Thread-safe. @throws IoError.
  void write_session(const Session& session);

 private:
  struct State;
  explicit TrialStore(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Whether the folder holds the study.json of a study of trials. @throws IoError if it holds one
/// that cannot be read.
bool is_trial_study(const std::filesystem::path& folder);

/// The study in a folder, as far as it was made: parts in the order of run or data set, with their
/// seconds; without conclusions.
/// @throws IoError if there is no such study or a file of it is damaged.
TrialStudy read_trial_study(const std::filesystem::path& folder);

}  // namespace mapproof
