#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"
#include "reports/history/nightly_links.hpp"
#include "reports/history/nightly_run.hpp"
#include "reports/history/nightly_summary.hpp"
#include "reports/history/trend_figures.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// Names of the studies by nightly run.
using NightlyStudies = std::map<int, std::vector<std::string>>;

/// One row per finding of those nightly runs, the last nightly run first.
Table findings_table(const NightlyFindings& findings, const std::string& study);

/// The values of each method in the last nightly run, in the one before and in the first.
Table accuracy_table(const StudyTrend& trend);

/// A page with its figures as values.
struct HistoryPage {
  Report report;
  std::vector<Figure> figures;
  std::map<std::string, std::string> link_words;  ///< See HtmlOptions.
};

/// Nightly runs of histories that were damaged and set aside: they are in no history any more.
struct LostNightlyRuns {
  std::vector<std::string> kept_as;  ///< File names: "history.sqlite.damaged-1".
  NightlyStudies reports;            ///< The studies of each whose reports are still there.
};

/// All that the index shows.
struct IndexFacts {
  std::vector<NightlyFacts> nightly_runs = {};
  NightlyFindings findings = {};
  NightlyStudies studies = {};            ///< Of the nightly runs whose reports are to be linked.
  std::vector<std::string> remarks = {};  ///< What could not be judged of the last nightly run, or
                                          ///< is only suspected.
  std::vector<StudyTrend> trends = {};    ///< Of the last nightly run's studies.
  LostNightlyRuns lost = {};
  std::vector<NightlyNote> notes = {};
  std::set<std::string> comparisons = {};  ///< comparison_file() of those that are there.
};

/// The last nightly run of them, with its findings in groups; empty facts without any.
NightlySummary last_summary(const IndexFacts& facts);

/// One row per nightly run, the last one first.
Table nightly_runs_table(const IndexFacts& facts, NightlyLinks& links);

/// One study over the nightly runs: what was found, accuracy, seconds and memory of what
/// trend_figures() shows. Pure: the same values give the same page.
/// @param trend        At least one nightly run.
/// @param is_compared  Whether the last one's reference run has the study, ordered in the same
///                     way.
HistoryPage trend_page(const StudyTrend& trend, const NightlyFindings& findings, bool is_compared,
                       const HistoryFolders& folders, std::span<const NightlyNote> notes = {});

/// The verdict on the last nightly run, what got worse and where it began, one line per study, a
/// figure or two of the trends, and all nightly runs, the last one first.
HistoryPage index_page(const IndexFacts& facts, const HistoryFolders& folders);

/// A study of one nightly run.
struct StudyOfNightlyRun {
  const NightlyRun& nightly_run;
  std::string name;
  bool is_compared = false;     ///< As for trend_page().
  const LostNightlyRuns& lost;  ///< Not empty: reported, since the history was found damaged.
  std::span<const FindingGroup> groups = {};  ///< Of the nightly run.
  std::span<const Figure> figures = {};    ///< Of the report: those of what got worse are marked.
  std::set<std::string> comparisons = {};  ///< As of IndexFacts, with those that are to be made.
};

/// Puts the verdict on a study's nightly run and what got worse at the head of its report, with
/// links to related pages, and before its other sections those that show what got worse.
void add_nightly_run(Report& report, const StudyOfNightlyRun& study, NightlyLinks& links);

}  // namespace mapproof
