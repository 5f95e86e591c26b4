#pragma once

#include <span>
#include <string>

#include "reports/history/pages/index_facts.hpp"
#include "reports/history/pages/nightly_links.hpp"
#include "reports/history/pages/trend_figures.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// One row per study of the last nightly run, with what changed over its nightly runs.
Table studies_table(const IndexFacts& facts, NightlyLinks& links);

/// One row per nightly run, the last one first.
Table nightly_runs_table(const IndexFacts& facts, NightlyLinks& links);

/// One row per finding of those nightly runs, the last nightly run first.
Table findings_table(const NightlyFindings& findings, const std::string& study);

/// The values of each method in the last nightly run, in the one that changes are shown against
/// (see base_index()) and in the first. Rows of what got worse are marked.
/// @param found  The last nightly run's findings, of any study.
Table accuracy_table(const StudyTrend& trend, std::span<const NightlyFinding> found = {});

}  // namespace mapproof
