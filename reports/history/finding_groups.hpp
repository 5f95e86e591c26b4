#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/history/nightly_notes.hpp"
#include "reports/history/nightly_run.hpp"
#include "reports/history/shown_names.hpp"

namespace mapproof {

/// The two nightly runs between which a finding began, and what was under test in them.
struct CommitRange {
  NightlyFacts before = {};  ///< Number 0: it began with the first nightly run that is known.
  NightlyFacts since = {};   ///< Likewise: it is not known any more.

  /// "between nightly runs 4 and 5"; "since nightly run 5" where the one before is not known.
  std::string words() const;
  /// The same with the time at which each began.
  std::string dated_words() const;
  /// Whether both nightly runs name a commit, and not the same one.
  bool has_commits() const;
  /// "1a2b3c4d5..6f7a8b9c0"; empty without both commits.
  std::string text() const;
  /// The page that compares them; empty if no address is known.
  std::string url() const;
  /// What searches the commit in between; empty without both commits. It builds by `since.build`,
  /// or BUILD if that is empty, and calls `since.command` without what names one commit or writes
  /// files.
  std::string bisect() const;
  /// What a reader has to put into bisect() before it runs: in place of BUILD, and of the folders
  /// that are not shown; empty where it is complete.
  std::string bisect_gaps() const;
};

/// Nightly run `since` of a study and the one of it before.
CommitRange commits_of(const StudyTrend& trend, int since);

inline constexpr const char* kUnknownStore = "STORE";

/// The --store of a command of `nightly`, as a word of a shell; kUnknownStore where there is none.
std::string store_word(const std::string& command);

/// The first digits of a commit, enough to distinguish it.
std::string short_commit(const std::string& commit);

/// The page of a commit: "REPOSITORY/commit/ID", as GitHub, GitLab and Gitea have it; empty if the
/// address is not known, or not an http or https one.
std::string commit_url(const std::string& repository, const std::string& commit);

/// A setting of a method: its parameter and the levels of factors.
struct FindingSetting {
  std::string shown;  ///< "K = 6", "range noise 0.1 m", "K = 6, share missing 40 %".
  std::optional<ShownLevel> parameter = {};  ///< "K" and "6", for what has one.
  std::vector<ShownLevel> levels = {};
};

/// The medians at the last step in the nightly run that changes are shown against and in this one.
struct MedianPair {
  double before = 0.0, after = 0.0;
};

/// Findings of one nightly run on the settings of one method: by the same rule, of the same
/// quantity, begun in the same nightly run.
struct FindingGroup {
  std::string study = {};
  HistoryRule rule = HistoryRule::kAccuracy;
  std::string setup = {};                  ///< As shown; may be empty.
  std::string method = {};                 ///< "ISOMAP", "all methods", "isomap-K6 and isomap-K8".
  std::string family = {};                 ///< `method` but for the number at its end: "isomap-K".
  std::vector<FindingSetting> settings = {};  ///< None: the method has none.
  std::size_t settings_of_method = 0;         ///< How many have values of this quantity.
  std::string quantity = {};               ///< Its label.
  std::string quantity_id = {};
  /// Of each finding that has one: by rule kAccuracy the change of the median at the last step, as
  /// figures and tables show it; else NightlyFinding::change.
  std::vector<double> changes = {};
  /// Likewise of each whose median was 0, so that its change has no percentage; these are groups of
  /// their own.
  std::vector<MedianPair> from_zero = {};
  bool in_points = false;            ///< The changes are in points rather than in percent.
  bool higher_is_better = false;     ///< A change for the worse is below 0.
  bool over_steps = false;           ///< The findings are about the mean over the steps.
  bool is_time = false;              ///< The quantity is a time, which a study declares itself.
  std::vector<int> numbers = {};     ///< Index of each finding in its nightly run, from 1.
  std::vector<std::string> sentences = {};
  std::vector<std::string> lines =
      {};  ///< Each as trend figures and tables call it: "ISOMAP, K = 6".
  std::vector<SeriesId> series = {};      ///< The first step of each that the findings are about.
  std::optional<MedianPair> medians = {};  ///< Of the first finding by rule kAccuracy.
  std::string unit = {};               ///< Of the medians.
  bool great_errors = false;           ///< See has_great_errors().
  std::optional<NightlyNote> known = {};  ///< By which all of them are known.
  CommitRange commits = {};

  /// "MPE +17.6 %", "seconds +12.0 to +14.1 %", "results are lost"; of an error that got worse in
  /// pairs of runs alone "MPE got worse in pairs of runs, its median −0.3 %"; of one that was 0
  /// "MPE from 0 to 0.00400 m".
  std::string change_text() const;
  /// Whether the method has three settings or more, and all of them are here.
  bool has_all_settings() const;
  /// "MPE +17.6 % (K = 6 and 8)", "MPE +17.6 % (all 4 settings)" where three or more are all.
  std::string change_of_settings() const;
  /// "ISOMAP: MPE +17.6 % (K = 6 and 8)".
  std::string headline() const;
  /// "median 0.0857 → 0.0985 m" of a single finding that has medians, unless change_text() says
  /// them; else empty.
  std::string values_text() const;
  /// "2 findings"; empty for one.
  std::string count_text() const;
  /// By how much it got worse, the largest of its changes, in units of the least change that a rule
  /// for accuracy finds: percent and points on one scale. Infinite if results are lost, 0
  /// of what has no percentage.
  double worsening() const;
};

/// The findings of a nightly run in groups, in the order of all pages and messages: those that are
/// new first, accuracy before time and memory, then what got worse most.
/// @param nightly_run  The number of that nightly run.
/// @param findings  All of that nightly run: they determine what changes are shown against.
/// @param trends  Of the studies; findings of a study without one have no method and no commits.
std::vector<FindingGroup> grouped(int nightly_run, std::span<const NightlyFinding> findings,
                                  std::span<const StudyTrend> trends,
                                  std::span<const NightlyNote> notes);

/// "3 findings" of all groups that are known, or that are not: as many as their count_text() say.
std::size_t count_findings(std::span<const FindingGroup> groups, bool known);

/// The index of the nightly run that changes of a study are shown against: the one that the last
/// was compared with, or the one before its findings began if that is earlier; the first where that
/// is none of these.
/// @param findings  Of the last nightly run; those of other studies are left out.
std::size_t base_index(const StudyTrend& trend, std::span<const NightlyFinding> findings);

/// "2026-11-22 03:30 +01:00": when a nightly run began, by the clock of the place where it ran; in
/// UTC "2026-11-22 02:30 UTC". What is not a time stays as it is.
std::string local_time(const NightlyFacts& nightly_run);

/// "nightly run 3, 2026-11-22 03:30 +01:00, commit 5fb294c0f", without the commit if it is not
/// known.
std::string dated_name(const NightlyFacts& nightly_run);

}  // namespace mapproof
