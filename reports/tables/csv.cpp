#include <cmath>

#include <fmt/format.h>

#include "reports/model/format.hpp"
#include "reports/tables/write_tables.hpp"

namespace mapproof {
namespace {

/// Quoted where RFC 4180 asks for it.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

/// Shortest text that reads back as the same double; empty for a missing value.
std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

bool is_interval(const Table& table, std::size_t column) {
  for (const Row& row : table.rows)
    if (std::holds_alternative<IntervalCell>(row.cells[column])) return true;
  return false;
}

struct Writer {
  bool interval;  ///< The column takes two fields.

  std::string one(const std::string& text) const { return interval ? text + "," : text; }
  std::string operator()(const TextCell& cell) const { return one(field(displayable(cell.text))); }
  std::string operator()(const NumberCell& cell) const { return one(number(cell.value)); }
  std::string operator()(const IntervalCell& cell) const {
    return number(cell.low) + "," + number(cell.high);
  }
  std::string operator()(const MissingCell&) const { return one(""); }
};

}  // namespace

std::string table_csv(const Table& table) {
  std::string text;
  std::vector<bool> intervals;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    intervals.push_back(is_interval(table, i));
    const std::string title = full_heading(table.columns[i]);
    if (i > 0) text += ',';
    text += intervals[i] ? field(title + ", low") + "," + field(title + ", high") : field(title);
  }
  text += "\r\n";
  for (const Row& row : table.rows) {
    for (std::size_t i = 0; i < row.cells.size(); ++i)
      text += (i > 0 ? "," : "") + std::visit(Writer{intervals[i]}, row.cells[i]);
    text += "\r\n";
  }
  return text;
}

}  // namespace mapproof
