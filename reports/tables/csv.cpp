#include <variant>
#include <vector>

#include "core/base/csv.hpp"
#include "reports/model/format.hpp"
#include "reports/tables/write_tables.hpp"

namespace mapproof {
namespace {

bool is_interval(const Table& table, std::size_t column) {
  for (const Row& row : table.rows)
    if (std::holds_alternative<IntervalCell>(row.cells[column])) return true;
  return false;
}

struct Writer {
  bool interval;  ///< The column takes two fields.

  std::string one(const std::string& text) const { return interval ? text + "," : text; }
  std::string operator()(const TextCell& cell) const {
    return one(csv_field(displayable(cell.text)));
  }
  std::string operator()(const NumberCell& cell) const { return one(csv_number(cell.value)); }
  std::string operator()(const IntervalCell& cell) const {
    return csv_number(cell.low) + "," + csv_number(cell.high);
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
    text += intervals[i] ? csv_field(title + ", low") + "," + csv_field(title + ", high")
                         : csv_field(title);
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
