#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/model/report.hpp"
#include "reports/sections/results/results_comparison.hpp"
#include "reports/sections/results/results_view.hpp"

namespace mapproof {

/// The tables of a block: one per quantity with the levels as columns, or of a single level one
/// with the quantities as columns; each mean with its interval. Where the study labels its runs,
/// one per run with the quantities as columns. Ids begin with the block's.
std::vector<Table> results_tables(const ResultsView& view, const ResultsBlock& block);

/// Blocks of a single level that have the same quantities, with one line each, in one table with a
/// block per row.
/// @param title  Its caption.
Table blocks_table(const ResultsView& view, std::span<const ResultsBlock> blocks,
                   const std::string& title);

/// The one line of a block whose quantities have no other; empty of a block with several.
std::optional<ResultsLine> only_line(const ResultsView& view, const ResultsBlock& block);

/// One per quantity that has values there: a method per row, a block of the overview per column.
std::vector<Table> overview_tables(const ResultsView& view, const ResultsOverview& overview);

/// Methods, their mean ranks, and their paired differences from the best one.
Table comparison_table(const ResultsView& view, const MethodComparison& comparison);

}  // namespace mapproof
