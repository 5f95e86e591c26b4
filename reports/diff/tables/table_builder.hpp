#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/model/report.hpp"

namespace mapproof {

/// The most rows of one table on a page; the others are counted.
inline constexpr std::size_t kMostTableRows = 30;

/// A cell with text of a user's file, cut to 500 characters.
TextCell user_text(const std::string& text);

/// The most decimals of a number in a table.
inline constexpr int kMostDecimals = 9;

/// A number with three significant digits of `scale`; missing if it is not a finite number.
NumberCell scaled_number(double value, double scale);

/// Adds the table unless it has no rows. Rows beyond kMostTableRows are cut; a note then states how
/// many of `total` are shown.
void add_table(std::vector<Block>& blocks, Table table, long total);

}  // namespace mapproof
