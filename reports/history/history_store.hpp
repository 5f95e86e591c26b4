#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/history/nightly_notes.hpp"
#include "reports/history/nightly_run.hpp"
#include "reports/history/store/database.hpp"

namespace mapproof {

/// history.sqlite in the folder of a store.
std::filesystem::path history_file(const std::filesystem::path& store);

/// The nightly runs that were finished (docs/file-formats.md lists the tables). Each is one
/// transaction: after a kill or a full disk it is there as a whole or not at all, and those before
/// it are untouched.
class HistoryStore {
 public:
  /// Opens the store to append to it; one that does not exist is created. One of an older version
  /// is migrated after a copy of it was kept, which remarks() report. The folder should be locked
  /// (see FolderLock).
  /// @throws IoError if it cannot be opened, is not ours, of a later version, damaged, or gone
  ///         although its nightly runs are there: then all stays as it is, and the message explains
  ///         how to begin a new one.
  static HistoryStore open(const std::filesystem::path& store);

  /// To read it, and for prune and pin. @throws IoError if there is none, it is damaged, or of
  /// another version than this program's.
  static HistoryStore open_existing(const std::filesystem::path& store);

  const std::vector<std::string>& remarks() const { return remarks_; }

  /// All, in order of number. @throws IoError.
  std::vector<NightlyFacts> nightly_runs();
  /// Of one nightly run, in the order they were found. @throws IoError.
  std::vector<NightlyFinding> findings(int nightly_run);
  /// Of all nightly runs that have some, by their numbers, in one query. @throws IoError.
  std::map<int, std::vector<NightlyFinding>> all_findings();
  /// The names of all nightly runs' studies, by their numbers, in one query. @throws IoError.
  std::map<int, std::vector<std::string>> study_names();
  /// Of one nightly run, without its values. @throws IoError.
  std::vector<NightlyStudy> studies(int nightly_run);
  /// The values of a study of that nightly run; empty if it has none of that name. @throws IoError.
  Scores scores(int nightly_run, const std::string& study);

  /// The study over the last `most` nightly runs that had this order, up to and with `until`.
  /// @throws IoError.
  StudyTrend trend(const std::string& study, const std::string& experiment_digest, int most,
                   int until);

  /// Adds a nightly run under its number, in one transaction. @throws IoError; InvalidInput if the
  /// number is taken or not above all others.
  void append(const NightlyRun& nightly_run);

  /// What was said of findings and nightly runs, oldest first. @throws IoError.
  std::vector<NightlyNote> notes();
  /// Adds notes; each replaces those of its kind on the same finding or nightly run, and one with
  /// an empty text only removes them. One that accepts its nightly run pins it as well.
  /// @throws InvalidInput if its nightly run or finding is not there; IoError.
  void add_notes(const std::vector<NightlyNote>& notes);

  /// A UUID of this history, in the form of a URN, which is the same as long as it exists.
  /// @throws IoError.
  std::string identifier();

  /// Pins one nightly run and no other. @throws InvalidInput if it is not there; IoError.
  void pin(int nightly_run);

  /// Removes nightly runs in one transaction. @throws IoError.
  void remove(const std::vector<int>& nightly_runs);

  /// Frees the space of what was removed; needs as much in the meantime. @throws IoError.
  void compact();

  /// The digests that figures of any nightly run name. @throws IoError.
  std::vector<std::string> digests();

  /// The greatest number that was ever given to a nightly run here.
  int last_number();

  /// What SQLite finds wrong; empty if nothing.
  std::string damage() { return database_->damage(); }

 private:
  explicit HistoryStore(std::unique_ptr<Database> database) : database_(std::move(database)) {}
  void append_study(int nightly_run, const NightlyStudy& study);
  void add_note(const NightlyNote& note);

  std::unique_ptr<Database> database_;
  std::vector<std::string> remarks_;
};

}  // namespace mapproof
