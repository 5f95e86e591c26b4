#pragma once

#include <string>
#include <vector>

#include "reports/diff/diff_result.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// The report blocks of one compared item, besides its images and its cause: movements, scores with
/// their tests, styles, SVG elements, pixels. Long tables are cut; a note then states so.
/// @param all     The whole comparison: it holds the records from which a figure is made.
/// @param number  Distinguishes the tables' ids from those of other items.
/// @note Reads the ids of the figure's records from its files again. If that fails, the figure has
/// no scores.
std::vector<Block> item_blocks(const DiffItem& item, const DiffResult& all, std::size_t number);

/// The overview of the comparison: names, counts, versions and renderers that differ.
KeyValues whole_facts(const DiffResult& result);

}  // namespace mapproof
