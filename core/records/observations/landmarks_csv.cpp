#include "core/records/observations/landmarks_csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/observations/name_list.hpp"
#include "core/records/tables/column_names.hpp"
#include "core/records/tables/number_rows.hpp"
#include "core/records/tables/respelling.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {
namespace {

/// Which cell of a row holds the name, x and y.
using Columns = std::array<std::size_t, 3>;

constexpr std::array kRoles = {ColumnRole::kLandmark, ColumnRole::kX, ColumnRole::kY};

/// 0, 1 or 2 for a heading of the column of names, x or y; 3 for any other.
std::size_t column_named(std::string_view cell) {
  const std::optional<ColumnRole> role = column_heading(cell, 0, {}).role;
  return role ? static_cast<std::size_t>(std::ranges::find(kRoles, *role) - kRoles.begin()) : 3;
}

/// A row of three cells or more without a number.
bool is_landmarks_header(const TableRow& row) {
  return row.cells.size() >= 3 &&
         std::ranges::none_of(row.cells,
                              [](std::string_view cell) { return number_in(cell).has_value(); }) &&
         !(row.cells.size() == 3 && (is_missing(row.cells[1]) || is_missing(row.cells[2])));
}

/// @throws IoError unless each of name, x and y is there once; others are not read.
Columns columns_of(const TableRow& header, const std::string& source) {
  Columns columns{};
  std::array<bool, 3> is_found{};
  const std::string location = fmt::format("line {}", header.line);
  for (std::size_t i = 0; i < header.cells.size(); ++i) {
    const std::size_t column = column_named(header.cells[i]);
    if (column == 3) continue;
    if (is_found[column])
      throw IoError(source, location,
                    "expected the columns name, x, y once; got " + in_quotes(header.cells[i]));
    columns[column] = i;
    is_found[column] = true;
  }
  for (std::size_t column = 0; column < 3; ++column)
    if (!is_found[column])
      throw IoError(source, location,
                    fmt::format("expected the columns name, x, y; got {}",
                                in_quotes(fmt::format("{}", fmt::join(header.cells, ",")))));
  return columns;
}

double read_coordinate(std::string_view cell, const std::string& source, std::size_t line) {
  const std::string location = fmt::format("line {}", line);
  if (is_missing(cell)) throw IoError(source, location, "a coordinate is missing");
  const std::optional<double> value = number_in(cell);
  if (!value) throw IoError(source, location, number_problem(cell));
  if (!(std::abs(*value) <= kFarthest_m))
    throw IoError(
        source, location,
        fmt::format("coordinates are in metres, at most {}, got {}", kFarthest_m, in_quotes(cell)));
  return *value;
}

NamedPoints parse_table(std::string_view text, const std::string& source) {
  TableReader reader(text, source);
  TableRow row;
  Columns columns = {0, 1, 2};
  std::size_t width = columns.size();
  NameList names(source);
  std::vector<double> coordinates;
  for (bool is_first = true; reader.next(row); is_first = false) {
    if (is_first && is_landmarks_header(row)) {
      columns = columns_of(row, source);
      width = row.cells.size();
      continue;
    }
    if (row.cells.size() != width)
      throw IoError(source, fmt::format("line {}", row.line),
                    fmt::format("has {} cells, expected {}", row.cells.size(),
                                width == 3 ? "name, x, y" : fmt::format("{}", width)));
    names.add(row.cells[columns[0]], row.line);
    coordinates.push_back(read_coordinate(row.cells[columns[1]], source, row.line));
    coordinates.push_back(read_coordinate(row.cells[columns[2]], source, row.line));
  }
  return named_points(names, coordinates, source);
}

/// Five bare numbers between blanks, as in Landmark_Groundground_truth.dat.
bool is_groundtruth(std::string_view text, const std::string& source) {
  TableReader reader(text, source, TableReader::kBlanks);
  TableRow row;
  return reader.next(row) && row.cells.size() == 5 &&
         std::ranges::all_of(row.cells,
                             [](std::string_view cell) { return number_in(cell).has_value(); });
}

}  // namespace

NamedPoints read_landmarks(ByteSource& source) {
  respell(source);
  const std::string bytes = source.rest();
  return parse_landmarks(checked_text(bytes, source.name()), source.name());
}

NamedPoints read_landmarks(const std::filesystem::path& path) {
  ByteSource source(path);
  return read_landmarks(source);
}

NamedPoints parse_landmarks(std::string_view text, const std::string& source) {
  return is_groundtruth(text, source) ? parse_groundtruth(text, source) : parse_table(text, source);
}

bool is_landmarks_table(std::string_view text, const std::string& source) {
  if (is_groundtruth(text, source)) return true;
  TableReader reader(text, source);
  TableRow row;
  if (!reader.next(row)) return false;
  if (is_landmarks_header(row)) {
    const auto names = [&](std::size_t column) {
      return std::ranges::find(row.cells, column, column_named) != row.cells.end();
    };
    return names(1) && names(2);
  }
  std::set<std::string, std::less<>> names;
  do {
    if (row.cells.size() != 3 || !number_in(row.cells[1]) || !number_in(row.cells[2]) ||
        !names.emplace(row.cells[0]).second)
      return false;
  } while (reader.next(row));
  return true;
}

NamedPoints parse_groundtruth(std::string_view text, const std::string& source) {
  NumberRows rows(text, source, 5);
  NameList names(source);
  std::vector<double> coordinates;
  while (rows.next()) {
    names.add(fmt::format("{}", rows.id(0)), rows.line());
    for (const std::size_t i : {1U, 2U}) {
      if (std::abs(rows[i]) > kFarthest_m) rows.fail("a position beyond any map");
      coordinates.push_back(rows[i]);
    }
  }
  return named_points(names, coordinates, source);
}

}  // namespace mapproof
