#pragma once

#include <string>
#include <vector>

#include "reports/diff/figures/figure_diff.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// Adds what moved, from where to where, and what changed otherwise.
/// @param suffix  Ends the tables' ids.
void add_figure_tables(std::vector<Block>& blocks, const FigureDiff& diff,
                       const std::string& suffix);

}  // namespace mapproof
