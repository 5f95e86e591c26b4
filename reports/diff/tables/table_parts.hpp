#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/model/report.hpp"

namespace mapproof {

/// Rows of one table on a page; the rest is counted.
inline constexpr std::size_t kMostTableRows = 30;

/// Text of a user's file, at most 500 characters.
TextCell user_text(const std::string& text);

/// A number with four significant digits of `scale`; missing if it is not a finite number.
NumberCell scaled_number(double value, double scale);

/// Adds the table unless it has no rows; rows beyond kMostTableRows are cut, and a note says how
/// many of `total` are shown.
void add_table(std::vector<Block>& blocks, Table table, long total);

}  // namespace mapproof
