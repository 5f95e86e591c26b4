#include <string_view>
#include <variant>
#include <vector>

#include "core/base/csv.hpp"
#include "core/base/unit_text.hpp"
#include "reports/model/format.hpp"
#include "reports/tables/write_tables.hpp"

namespace mapproof {
namespace {

bool is_interval(const Table& table, std::size_t column) {
  for (const Row& row : table.rows)
    if (std::holds_alternative<IntervalCell>(row.cells[column])) return true;
  return false;
}

/// A spreadsheet would take such a text for a formula; the sign in front makes it a text.
std::string harmless(const std::string& text) {
  constexpr std::string_view kBegins = "=+-@\t\r\n";
  const std::string shown = displayable(text);
  const bool acts = !shown.empty() && kBegins.find(shown.front()) != std::string_view::npos;
  return csv_field(acts ? "'" + shown : shown);
}

struct Writer {
  bool interval;  ///< The column takes two fields.

  std::string one(const std::string& text) const { return interval ? text + "," : text; }
  std::string operator()(const TextCell& cell) const { return one(harmless(cell.text)); }
  std::string operator()(const NumberCell& cell) const { return one(csv_number(cell.value)); }
  std::string operator()(const IntervalCell& cell) const {
    return csv_number(cell.low) + "," + csv_number(cell.high);
  }
  std::string operator()(const MissingCell&) const { return one(""); }
};

}  // namespace

TableLines csv_lines(const Table& table) {
  TableLines lines;
  std::vector<bool> intervals;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    intervals.push_back(is_interval(table, i));
    const std::string title = with_plain_spaces(full_heading(table.columns[i]));
    if (i > 0) lines.head += ',';
    lines.head += intervals[i] ? harmless(title + ", low") + "," + harmless(title + ", high")
                               : harmless(title);
  }
  lines.head += "\r\n";
  for (const Row& row : table.rows) {
    std::string text;
    for (std::size_t i = 0; i < row.cells.size(); ++i)
      text += (i > 0 ? "," : "") + std::visit(Writer{intervals[i]}, row.cells[i]);
    lines.rows.push_back(text + "\r\n");
  }
  return lines;
}

std::string table_csv(const Table& table) { return joined(csv_lines(table)); }

}  // namespace mapproof
