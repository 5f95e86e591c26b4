#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"
#include "reports/history/night.hpp"
#include "reports/history/trend_figures.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// A page with its figures as values.
struct HistoryPage {
  Report report;
  std::vector<Figure> figures;
};

/// Names of the studies by night.
using NightStudies = std::map<int, std::vector<std::string>>;

/// One study over the nights: what was found, accuracy, seconds and memory of what
/// trend_figures() shows. Pure: the same values give the same page.
/// @param trend        At least one night.
/// @param is_compared  Whether the last one's night of reference has the study, ordered in the same
///                     way.
HistoryPage trend_page(const StudyTrend& trend, const NightFindings& findings, bool is_compared);

/// All nights, the last one first, and what the last one says.
/// @param studies  Of the nights whose reports are to be linked.
/// @param remarks  What could not be judged, or is only suspected, of the last night.
Report index_page(std::span<const NightFacts> nights, const NightFindings& findings,
                  const NightStudies& studies, std::span<const std::string> remarks);

}  // namespace mapproof
