#pragma once

#include <span>
#include <string>

#include "reports/history/night_links.hpp"
#include "reports/history/trend_figures.hpp"

namespace mapproof {

/// Names of the studies by night.
using NightStudies = std::map<int, std::vector<std::string>>;

/// "2026-11-22 02:30" of "2026-11-22T02:30:07Z"; what is no such time as it is.
std::string to_the_minute(const std::string& utc);

/// One row a night, the last one first.
/// @param studies  Of each night: its report is linked where there is one study, else its folder.
Table nights_table(std::span<const NightFacts> nights, const NightFindings& findings,
                   const NightStudies& studies, NightLinks& links);

/// One row a finding of those nights, the last night first.
Table findings_table(const NightFindings& findings, const std::string& study);

/// Where each method stands tonight beside the night before and the first.
Table accuracy_table(const StudyTrend& trend);

}  // namespace mapproof
