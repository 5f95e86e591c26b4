#pragma once

#include <map>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"
#include "reports/history/history_tables.hpp"
#include "reports/history/night.hpp"
#include "reports/history/night_links.hpp"
#include "reports/history/trend_figures.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// A page with its figures as values.
struct HistoryPage {
  Report report;
  std::vector<Figure> figures;
  std::map<std::string, std::string> link_words;  ///< See HtmlOptions.
};

/// Nights of histories that were damaged and set aside: they are in no history any more.
struct LostNights {
  std::vector<std::string> kept_as;  ///< File names: "history.sqlite.damaged-1".
  NightStudies reports;              ///< The studies of each whose reports are still there.
};

/// All that the index tells.
struct IndexFacts {
  std::vector<NightFacts> nights = {};
  NightFindings findings = {};
  NightStudies studies = {};              ///< Of the nights whose reports are to be linked.
  std::vector<std::string> remarks = {};  ///< What could not be judged of the last night, or is
                                          ///< only suspected.
  std::vector<StudyTrend> trends = {};    ///< Of the last night's studies.
  LostNights lost = {};
};

/// One study over the nights: what was found, accuracy, seconds and memory of what trend_figures()
/// shows. Pure: the same values give the same page.
/// @param trend        At least one night.
/// @param is_compared  Whether the last one's night of reference has the study, ordered in the same
///                     way.
HistoryPage trend_page(const StudyTrend& trend, const NightFindings& findings, bool is_compared,
                       const HistoryPlaces& places);

/// How the last night stands, a figure or two of its course, and all nights, the last one first.
HistoryPage index_page(const IndexFacts& facts, const HistoryPlaces& places);

/// Puts at the head of a study's report how its night stands, and where else to look.
/// @param is_compared  As for trend_page().
/// @param lost         Not empty: told of, since the history was found damaged that night.
void add_night(Report& report, const Night& night, const std::string& study, bool is_compared,
               const LostNights& lost, NightLinks& links);

}  // namespace mapproof
