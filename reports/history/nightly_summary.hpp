#pragma once

#include <span>
#include <string>
#include <vector>

#include "reports/history/finding_groups.hpp"

namespace mapproof {

/// One nightly run for people and programs that do not open its pages.
struct NightlySummary {
  NightlyFacts facts = {};
  std::vector<FindingGroup> groups = {};  ///< Those that are new first.
  std::vector<StudyTrend> trends = {};    ///< Of its studies.
  std::vector<std::string> remarks = {};
  std::vector<NightlyNote> notes = {};      ///< On this nightly run.
  std::vector<NightlyNote> all_notes = {};  ///< On all nightly runs.

  /// How many findings are not known.
  std::size_t new_findings() const;
  std::size_t known_findings() const;
  /// The verdict without the findings that are known.
  NightlyVerdict verdict() const;
  /// verdict_title() of its findings.
  std::string title() const;
  /// The same in a few words, for a badge: "passed", "MPE +17.6 %", "3 findings".
  std::string short_verdict() const;
};

/// "Nothing got worse since nightly run 3.", "Accuracy got worse: 2 findings.", "Not compared: …":
/// what is new by its kind, then what is known as known: "Time grew: 10 findings; accuracy is worse
/// as known: 2 findings."
/// @param groups  All of them.
std::string verdict_sentence(const NightlyFacts& nightly_run, std::span<const FindingGroup> groups);

/// The same as a title, after the number of the nightly run: "Nightly run 7: time grew: 1 finding".
std::string verdict_title(const NightlyFacts& nightly_run, std::span<const FindingGroup> groups);

/// For a comment, a job's page or a message: title, findings with their commits, remarks. Nothing
/// in it is active: names are text.
std::string nightly_markdown(const NightlySummary& summary);

/// JUnit XML: a test suite per study and a test case per method and judged quantity, which fails if
/// a finding is about it; one that is known counts as skipped. Findings about anything else are
/// cases of their own.
std::string nightly_junit(const NightlySummary& summary);

/// An SVG with "nightly" and the verdict, 20 pixels high.
std::string nightly_badge(const NightlySummary& summary);

/// The same as JSON, as shields.io reads it from a server ("endpoint").
std::string nightly_badge_json(const NightlySummary& summary);

/// What an Atom feed holds.
struct FeedFacts {
  std::string identifier;                 ///< Of the history (HistoryStore::identifier()).
  std::vector<NightlySummary> summaries;  ///< Of the nightly runs, the last one first.
  std::string nightly_runs =
      {};  ///< Where nightly_runs/ lies, from the feed's folder: "../store/".
};

/// An Atom feed [rfc4287] of nightly runs, one entry each: its title, its findings with their
/// commits, and what was noted on it, as plain text. Links are relative to the feed.
std::string nightly_feed(const FeedFacts& facts);

}  // namespace mapproof
