#pragma once

#include <span>
#include <string>

#include "render/plot/figure.hpp"
#include "reports/history/finding_groups.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// Marks what got worse of a study in its report: the rows of tables that are about a method with a
/// finding, and the figures that draw it with the quantity of the finding.
/// @param figures  Of the report, as values.
/// @param groups   Of any study; known ones are marked as well.
void mark_regressed(Report& report, std::span<const Figure> figures,
                    std::span<const FindingGroup> groups, const std::string& study);

}  // namespace mapproof
