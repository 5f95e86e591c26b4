#include "core/records/observations/csv_columns.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"

namespace mapproof {
namespace {

bool is_called(const CsvColumn& column, std::string_view cell) {
  return std::ranges::find(column.words, lower_case(cell)) != column.words.end();
}

/// Which cell of the rows holds the column.
/// @throws IoError if it is needed but not there, or there twice.
std::optional<std::size_t> cell_of(const CsvColumn& column, const TableRow& header,
                                   const std::string& source) {
  std::optional<std::size_t> found;
  const std::string place = fmt::format("line {}", header.line);
  for (std::size_t i = 0; i < header.cells.size(); ++i) {
    if (!is_called(column, header.cells[i])) continue;
    if (found) throw IoError(source, place, fmt::format("two columns of {}", column.label));
    found = i;
  }
  if (!found && column.is_needed)
    throw IoError(source, place,
                  fmt::format("no column of {}: expected {} in the header", column.label,
                              fmt::join(column.words, ", ")));
  return found;
}

double number_at(const TableRow& row, std::size_t cell, const std::string& source) {
  const std::optional<double> value = number_in(row.cells[cell]);
  if (!value || !std::isfinite(*value))
    throw IoError(source, fmt::format("line {}", row.line), number_problem(row.cells[cell]));
  return *value;
}

std::string name_at(const TableRow& row, std::size_t cell, const std::string& source) {
  const std::string_view name = row.cells[cell];
  if (name.empty() || name.size() > kLongestName)
    throw IoError(source, fmt::format("line {}", row.line),
                  name.empty() ? "a landmark without a name" : "a name that is too long");
  return std::string(name);
}

}  // namespace

NumberTable read_columns(ByteSource& input, const std::vector<CsvColumn>& numbers,
                         const CsvColumn* names) {
  const std::string& source = input.name();
  const std::string bytes = input.rest();
  TableReader reader(checked_text(bytes, source), source);
  TableRow row;
  if (!reader.next(row)) throw IoError(source, "is empty");
  const std::size_t width = row.cells.size();
  std::vector<std::size_t> cells;
  for (const CsvColumn& column : numbers)
    if (const auto cell = cell_of(column, row, source)) cells.push_back(*cell);
  const auto name_cell = names == nullptr ? std::nullopt : cell_of(*names, row, source);

  NumberTable table{.source = source};
  std::vector<double> values;
  while (reader.next(row)) {
    if (row.cells.size() != width)
      throw IoError(source, fmt::format("line {}", row.line),
                    fmt::format("has {} cells, expected {}", row.cells.size(), width));
    if (table.rows.size() == kMostSteps)
      throw IoError(source, fmt::format("more than {} rows", kMostSteps));
    table.rows.push_back(row.line);
    for (const std::size_t cell : cells) values.push_back(number_at(row, cell, source));
    if (name_cell) table.names.push_back(name_at(row, *name_cell, source));
  }
  table.set_values(values, std::ssize(cells));
  return table;
}

bool names_columns(const TableRow& row, const std::vector<CsvColumn>& columns) {
  return std::ranges::all_of(columns, [&](const CsvColumn& column) {
    return !column.is_needed ||
           std::ranges::any_of(row.cells, [&](auto cell) { return is_called(column, cell); });
  });
}

}  // namespace mapproof
