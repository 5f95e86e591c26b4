#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"
#include "reports/history/finding_groups.hpp"
#include "reports/history/nightly_run.hpp"
#include "reports/history/nightly_summary.hpp"
#include "reports/history/pages/index_facts.hpp"
#include "reports/history/pages/nightly_links.hpp"
#include "reports/history/pages/trend_figures.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// A page with its figures as values.
struct HistoryPage {
  Report report;
  std::vector<Figure> figures;
  std::map<std::string, std::string> link_words;  ///< See HtmlOptions.
};

/// The last nightly run of them, with its findings in groups; empty facts without any.
NightlySummary last_summary(const IndexFacts& facts);

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
  bool is_compared = false;     ///< Whether the reference run has it, ordered in the same way.
  const LostNightlyRuns& lost;  ///< Not empty: reported, since the history was found damaged.
  std::span<const FindingGroup> groups = {};  ///< Of the nightly run.
  std::span<const Figure> figures = {};    ///< Of the report: those of what got worse are marked.
  std::set<std::string> comparisons = {};  ///< As of IndexFacts, with those that are to be made.
};

/// Puts the verdict on a study's nightly run and what got worse at the head of its report, with
/// links to related pages, and before its other sections those that show what got worse.
void add_nightly_run(Report& report, const StudyOfNightlyRun& study, NightlyLinks& links);

}  // namespace mapproof
