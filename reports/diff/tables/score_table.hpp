#pragma once

#include <string>
#include <vector>

#include "reports/diff/records/record_diff.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// Adds a table of scores, baseline and current, with their tests: the most telling first.
/// @param comparisons  No null.
void add_score_table(std::vector<Block>& blocks, const std::string& id, const std::string& caption,
                     std::vector<const Comparison*> comparisons);

}  // namespace mapproof
