#include "reports/html/table_data.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "reports/html/escape.hpp"
#include "reports/model/format.hpp"
#include "reports/tables/write_tables.hpp"

namespace mapproof {
namespace {

using kainjow::mustache::data;
using kainjow::mustache::list;

constexpr std::size_t kMostRowsOpen = 30;  ///< Longer tables are folded until asked for.
constexpr std::size_t kLongCell = 80;      ///< Longer texts scroll in a box of their own.

bool any_group(const Table& table) {
  for (const Column& column : table.columns)
    if (!column.group.empty()) return true;
  return false;
}

data heading_data(const Table& table, std::size_t index, bool two_rows) {
  const Column& column = table.columns[index];
  data out;
  out.set("title", column.title);
  out.set("unit", text_or_false(column.unit));
  out.set("hint", text_or_false(column.hint));
  out.set("index", fmt::format("{}", index));
  out.set("text", holds_text(table, index));
  out.set("group", false);
  out.set("rows", two_rows && column.group.empty() ? data("2") : data(false));
  const bool begins = index > 0 && table.columns[index - 1].group != column.group;
  out.set("begins", begins);
  return out;
}

data group_data(const Table& table, std::size_t first, std::size_t count) {
  data out;
  out.set("group", true);
  out.set("title", table.columns[first].group);
  out.set("columns", fmt::format("{}", count));
  out.set("begins", first > 0);
  return out;
}

/// One heading row, or two where columns share headings.
void add_headings(const Table& table, data& out) {
  const bool two_rows = any_group(table);
  list upper;
  list lower;
  for (std::size_t i = 0; i < table.columns.size();) {
    const std::string& group = table.columns[i].group;
    if (group.empty()) {
      upper.push_back(heading_data(table, i++, two_rows));
      continue;
    }
    const std::size_t first = i;
    for (; i < table.columns.size() && table.columns[i].group == group; ++i)
      lower.push_back(heading_data(table, i, false));
    upper.push_back(group_data(table, first, i - first));
  }
  out.set("upper", upper);
  out.set("lower", lower);
  out.set("two_rows", two_rows);
}

/// What a column is sorted by: numbers as they are, an interval by its middle; empty goes last.
struct SortKey {
  std::string operator()(const TextCell& cell) const { return cell.text; }
  std::string operator()(const NumberCell& cell) const { return number(cell.value); }
  std::string operator()(const IntervalCell& cell) const {
    return number(0.5 * cell.low + 0.5 * cell.high);
  }
  std::string operator()(const MissingCell&) const { return ""; }

  static std::string number(double value) {
    return std::isfinite(value) ? fmt::format("{}", value) : "";
  }
};

data cell_data(const Table& table, const Row& row, std::size_t index, const HtmlOptions& options) {
  const Cell& cell = row.cells[index];
  const auto* text = std::get_if<TextCell>(&cell);
  const auto emphasis = text != nullptr ? text->emphasis : Emphasis::kPlain;
  data out;
  const bool is_file = emphasis == Emphasis::kFile;
  out.set("value", is_file ? link_words(text->text, options) : format_cell(cell));
  out.set("heads", index == 0);
  out.set("is_text", text != nullptr || holds_text(table, index));
  out.set("code", emphasis == Emphasis::kCode);
  out.set("file", is_file);
  out.set("link", is_file ? file_link(text->text) : "");
  const bool is_strong = emphasis == Emphasis::kStrong;
  out.set("strong", is_strong);
  out.set("data", emphasis != Emphasis::kCode && !is_file && !is_strong);
  out.set("long", text != nullptr && text->text.size() > kLongCell);
  const std::string key = std::visit(SortKey{}, cell);
  out.set("sort", text == nullptr ? data("key", key) : data(false));
  const bool begins = index > 0 && table.columns[index - 1].group != table.columns[index].group;
  out.set("begins", begins);
  return out;
}

data row_data(const Table& table, const Row& row, const HtmlOptions& options) {
  data out;
  list cells;
  cells.reserve(row.cells.size());
  for (std::size_t i = 0; i < row.cells.size(); ++i)
    cells.push_back(cell_data(table, row, i, options));
  out.set("cells", cells);
  out.set("marked", row.marked);
  out.set("source", text_or_false(row.source));
  return out;
}

std::string without_line_end(std::string text) {
  text.erase(text.find_last_not_of("\r\n") + 1);
  return text;
}

/// The rows, each with the lines that stand for it where the table is copied as text.
list rows_data(const Table& table, const HtmlOptions& options) {
  const bool copies = options.copies_tables;
  TableLines csv, latex;
  if (copies) {
    csv = csv_lines(table);
    latex = latex_lines(table);
  }
  list rows;
  rows.reserve(table.rows.size());
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    data row = row_data(table, table.rows[i], options);
    row.set("lines", data(copies));
    row.set("csv", copies ? without_line_end(csv.rows[i]) : "");
    row.set("latex", copies ? without_line_end(latex.rows[i]) : "");
    rows.push_back(std::move(row));
  }
  return rows;
}

/// What stands before and after the rows in a text.
void add_frames(const Table& table, bool copies, data& out) {
  out.set("copies", data(copies));
  out.set("csv_head", copies ? without_line_end(csv_lines(table).head) : "");
  const TableLines latex = copies ? latex_lines(table) : TableLines{};
  out.set("latex_head", latex.head);
  out.set("latex_tail", latex.tail);
}

}  // namespace

data table_data(const Table& table, const HtmlOptions& options) {
  data out;
  out.set("id", table.id);
  out.set("caption", table.caption);
  out.set("folder", text_or_false(options.table_folder));
  add_headings(table, out);
  const list rows = rows_data(table, options);
  add_frames(table, options.copies_tables, out);
  out.set("any_rows", !rows.empty());
  out.set("folded", data(table.rows.size() > kMostRowsOpen));
  out.set("row_count", counted(std::ssize(table.rows), "row"));
  out.set("table_rows", rows);
  list notes;
  for (const std::string& note : table.notes) notes.push_back(data("note", note));
  out.set("any_notes", !notes.empty());
  out.set("notes", notes);
  return out;
}

}  // namespace mapproof
