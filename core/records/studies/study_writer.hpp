#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/model/study.hpp"

namespace mapproof {

/// The content of a study.json, of any kind of study.
struct StudyHead {
  std::string experiment;  ///< As JSON: canonical, every default written out.
  std::string solver_digest;
  std::vector<MethodFiles> method_files = {};
};

/// What a study's folder begins with.
struct StudyStart {
  std::string text;  ///< Of study.json.
  /// Reads such a text. @throws IoError with the location.
  std::function<StudyHead(const std::string& text, const std::string& source)> read_head;
  /// Files and folders, below the study's, that parts are written to.
  std::vector<std::filesystem::path> records;
};

/// A file below a study's folder.
struct PartFile {
  std::filesystem::path file;
  std::string text;
};

/// What one task of a study gave.
struct StudyPart {
  std::vector<PartFile> files =
      {};                    ///< As they are written: the last one marks the part as complete.
  std::string timings = {};  ///< Lines of timings.jsonl.
  std::filesystem::path emptied = {};  ///< A folder of its own, below the study's, emptied first.
};

/// "/seed is 2007 there and 2008 here": the first of the differences of two JSON texts.
std::string first_difference(const std::string& there, const std::string& here);

/// Writes the folder of a study of any kind (docs/file-formats.md says what is in it).
///
/// One process at a time: the folder is locked as long as the writer lives. The bytes of every file
/// but timings.jsonl depend only on what is written, not on the order or the number of tries.
class StudyWriter {
 public:
  /// Makes the folder, or resumes the study in it; leftovers of a killed process are removed.
  /// Records that were made by another Provenance::solver_digest, or by other method_files, are
  /// removed too: see redone().
  /// @param busy  If given, the writer waits while another process uses the folder; called once,
  ///              before the wait.
  /// @throws IoError if the folder holds another experiment, holds files but no study, is in use
  ///         by another process, or cannot be written.
  StudyWriter(const std::filesystem::path& folder, const StudyStart& start,
              const std::function<void()>& busy = {});

  StudyWriter(StudyWriter&&) noexcept;
  StudyWriter& operator=(StudyWriter&&) noexcept;
  ~StudyWriter();

  const std::filesystem::path& folder() const;

  /// What made the records that were removed when the folder was opened, "another solver"; empty:
  /// none were.
  const std::string& redone() const;

  /// Writes the files, then the timings. Thread-safe. @throws IoError.
  void write(const StudyPart& part);

  /// Appends to timings.jsonl. Thread-safe. @throws IoError.
  void write_session(const Session& session);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mapproof
