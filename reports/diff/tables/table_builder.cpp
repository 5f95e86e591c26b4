#include "reports/diff/tables/table_builder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace mapproof {

TextCell user_text(const std::string& text) { return {printable(text, 500), Emphasis::kData}; }

NumberCell scaled_number(double value, double scale) {
  const double digits =
      std::isfinite(scale) && scale > 0.0 ? 2.0 - std::floor(std::log10(scale)) : 2.0;
  return {value, static_cast<int>(std::clamp(digits, 0.0, double{kMostDecimals}))};
}

void add_table(std::vector<Block>& blocks, Table table, long total) {
  if (table.rows.empty()) return;
  if (table.rows.size() > kMostTableRows) table.rows.resize(kMostTableRows);
  const long shown = std::ssize(table.rows);
  if (total > shown) table.notes.push_back(fmt::format("{} of {} shown.", shown, total));
  blocks.emplace_back(std::move(table));
}

}  // namespace mapproof
