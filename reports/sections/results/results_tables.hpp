#pragma once

#include <vector>

#include "reports/model/report.hpp"
#include "reports/sections/results/results_comparison.hpp"
#include "reports/sections/results/results_view.hpp"

namespace mapproof {

/// The tables of a block: one per quantity with the levels as columns, or of a single level one
/// with the quantities as columns; each mean with its interval. Where the study labels its runs,
/// one per run with the quantities as columns. Ids begin with the block's.
std::vector<Table> results_tables(const ResultsView& view, const ResultsBlock& block);

/// One per quantity that has values there: a method per row, a block of the overview per column.
std::vector<Table> overview_tables(const ResultsView& view, const ResultsOverview& overview);

/// Methods, their mean ranks, and their paired differences from the best one.
Table comparison_table(const ResultsView& view, const MethodComparison& comparison);

}  // namespace mapproof
