#pragma once

#include <string>
#include <vector>

#include "reports/diff/diff_result.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// What is to be said of one compared item beside its pictures and its cause: what moved, scores
/// with their tests, styles, SVG elements, pixels. Long tables are cut; their notes say so.
///
/// @param all     For the records that a figure is made of.
/// @param number  Distinguishes the tables' ids from those of other items.
/// @note Reads the figure's records' ids from its files again; if that fails, the figure has no
///       scores.
std::vector<Block> item_blocks(const DiffItem& item, const DiffResult& all, std::size_t number);

/// What was compared: names, counts, versions and renderers that differ.
KeyValues whole_facts(const DiffResult& result);

}  // namespace mapproof
