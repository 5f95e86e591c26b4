#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "render/plot/figure.hpp"
#include "reports/history/finding_groups.hpp"
#include "reports/history/nightly_summary.hpp"
#include "reports/history/pages/nightly_links.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// Number of findings of a study shown at the head of a page and on the console; its trend page
/// lists all.
inline constexpr std::size_t kMostReported = 3;

/// The verdict on a study of a judged nightly run: its first groups of findings, and how many more
/// findings there are; a fourth group is shown if it is the last.
/// @param groups       Of that nightly run; those of other studies are left out.
/// @param is_compared  Whether the reference run has the study, ordered in the same way.
/// @param links        Of the page.
Standing study_standing(const NightlyFacts& nightly_run, std::span<const FindingGroup> groups,
                        const std::string& study, bool is_compared, NightlyLinks& links);

/// The verdict on all studies of a nightly run: the first groups of each, after its name.
Standing nightly_standing(const NightlySummary& summary, NightlyLinks& links);

/// Marks what got worse of a study in its report: the rows of tables that are about a method with a
/// finding, and the figures that draw it with the quantity of the finding.
/// @param figures  Of the report, as values.
/// @param groups   Of any study; known ones are marked as well.
void mark_regressed(Report& report, std::span<const Figure> figures,
                    std::span<const FindingGroup> groups, const std::string& study);

}  // namespace mapproof
