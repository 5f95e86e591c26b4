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
/// @param trend  At least one night.
HistoryPage trend_page(const StudyTrend& trend, const NightFindings& findings);

/// All nights, the last one first, and what the last one says.
/// @param studies  Of the nights whose reports are to be linked.
/// @param remarks  What could not be judged, or is only suspected, of the last night.
Report index_page(std::span<const NightFacts> nights, const NightFindings& findings,
                  const NightStudies& studies, std::span<const std::string> remarks);

/// How a study of a judged night stands.
/// @param is_compared  Whether the night of reference has the study, ordered in the same way.
Standing standing(const Night& night, const std::string& study, bool is_compared);

/// "Nothing got worse.", "Accuracy got worse: 2 findings.", …
std::string verdict_sentence(const NightFacts& night, std::size_t findings);

}  // namespace mapproof
