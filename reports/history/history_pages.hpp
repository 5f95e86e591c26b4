#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"
#include "reports/history/index_facts.hpp"
#include "reports/history/nightly_links.hpp"
#include "reports/history/nightly_run.hpp"
#include "reports/history/nightly_summary.hpp"
#include "reports/history/trend_figures.hpp"
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

}  // namespace mapproof
