#pragma once

#include <set>
#include <span>
#include <string>

#include "render/plot/figure.hpp"
#include "reports/history/finding_groups.hpp"
#include "reports/history/index_facts.hpp"
#include "reports/history/nightly_links.hpp"
#include "reports/history/nightly_run.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

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
