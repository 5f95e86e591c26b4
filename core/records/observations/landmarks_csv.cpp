#include "core/records/observations/landmarks_csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/observations/name_list.hpp"
#include "core/records/tables/column_names.hpp"
#include "core/records/tables/number_rows.hpp"
#include "core/records/tables/respelling.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {
namespace {

/// Which cell of a row holds the name, x and y, and the factors to metres: of a height, of x and
/// of y.
struct Columns {
  std::array<std::size_t, 3> cell = {0, 1, 2};
  std::array<double, 3> factor = {1.0, 1.0, 1.0};
  std::optional<std::size_t> height = {};  ///< Its cell.
};

constexpr std::array kRoles = {ColumnRole::kLandmark, ColumnRole::kX, ColumnRole::kY};

/// What a heading says of a column: 0, 1 or 2 for names, x or y, and the factor; none for others.
struct Heading {
  std::optional<std::size_t> column;
  double factor = 1.0;
  std::string unknown_unit = {};
};

Heading heading_of(std::string_view cell, std::size_t number, const ColumnNames& named) {
  const ColumnHeading heading = column_heading(cell, number, named);
  if (heading.role) {
    const auto found = std::ranges::find(kRoles, *heading.role);
    if (found == kRoles.end()) return {};
    return {static_cast<std::size_t>(found - kRoles.begin()), heading.factor, heading.unknown_unit};
  }
  const auto is_named = [&](ColumnRole role) {
    return std::ranges::find(named, role, &NamedColumn::role) != named.end();
  };
  if (const auto factor = column_factor(cell, ColumnRole::kX, kEastWords);
      factor && !is_named(ColumnRole::kX))
    return {1, *factor};
  if (const auto factor = column_factor(cell, ColumnRole::kY, kNorthWords);
      factor && !is_named(ColumnRole::kY))
    return {2, *factor};
  return {};
}

/// A row of three cells or more without a number.
bool is_landmarks_header(const TableRow& row) {
  return row.cells.size() >= 3 &&
         std::ranges::none_of(row.cells,
                              [](std::string_view cell) { return number_in(cell).has_value(); }) &&
         !(row.cells.size() == 3 && (is_missing(row.cells[1]) || is_missing(row.cells[2])));
}

/// "; latitudes and longitudes ..." for a header that names them.
std::string remedy_for(const TableRow& header) {
  if (std::ranges::any_of(header.cells, is_geographic))
    return "; latitudes and longitudes have to be projected to metres (UTM) first";
  return "; --columns landmark=HEADER,x=HEADER,y=HEADER names others";
}

/// The names that count for positions: where the header's own words suffice, neither numbers, which
/// are those of the observations, nor the axes of a camera's frame.
ColumnNames names_of_positions(const TableRow& header, const ColumnNames& names) {
  std::array<int, 3> counts{};
  for (std::size_t i = 0; i < header.cells.size(); ++i)
    if (const Heading own = heading_of(header.cells[i], i, {}); own.column) ++counts[*own.column];
  if (std::ranges::any_of(counts, [](int count) { return count != 1; })) return names;
  const bool is_camera =
      std::ranges::find(names, ColumnRole::kRight, &NamedColumn::role) != names.end();
  ColumnNames others;
  std::ranges::copy_if(names, std::back_inserter(others), [&](const NamedColumn& column) {
    const bool is_number = column.header.find_first_not_of("0123456789") == std::string::npos;
    return !is_number &&
           !(is_camera && (column.role == ColumnRole::kX || column.role == ColumnRole::kRight));
  });
  return others;
}

/// @throws IoError unless each of name, x and y is there once; others are not read.
Columns columns_of(const TableRow& header, const std::string& source, const ColumnNames& all) {
  const ColumnNames names = names_of_positions(header, all);
  const ColumnNames named = columns_in(header.cells, names);
  Columns columns{};
  std::array<bool, 3> is_found{};
  const std::string location = fmt::format("line {}", header.line);
  for (std::size_t i = 0; i < header.cells.size(); ++i) {
    const Heading heading = heading_of(header.cells[i], i, named);
    if (!heading.column) {
      if (const auto factor = column_factor(header.cells[i], ColumnRole::kX, kUpWords)) {
        columns.height = i;
        columns.factor[0] = *factor;
      }
      continue;
    }
    // Beside names, "anchor" is a yes or no, as in map.csv.
    const auto is_flag = [&](std::size_t cell) {
      return *heading.column == 0 && lower_case(trimmed(header.cells[cell])) == "anchor";
    };
    if (is_found[*heading.column] && is_flag(i)) continue;
    if (is_found[*heading.column] && !is_flag(columns.cell[*heading.column]))
      throw IoError(source, location,
                    fmt::format("expected the columns name, x, y once; got {}; --columns "
                                "{}=HEADER names the one to read",
                                in_quotes(header.cells[i]), name(kRoles[*heading.column])));
    if (!heading.unknown_unit.empty())
      throw IoError(
          source, location,
          fmt::format("{}: coordinates in that unit are not known; m, cm, mm, km, ft or inch",
                      in_quotes(header.cells[i])));
    columns.cell[*heading.column] = i;
    columns.factor[*heading.column] = heading.factor;
    is_found[*heading.column] = true;
  }
  for (const NamedColumn& column : names)
    for (std::size_t i = 0; i < kRoles.size(); ++i)
      if (!is_found[i] && column.role == kRoles[i])
        require_columns(header.cells, {{column.role, column.header}}, source);
  if (std::ranges::find(is_found, false) != is_found.end())
    throw IoError(source, location,
                  fmt::format("expected the columns name, x, y; got {}{}",
                              in_quotes(fmt::format("{}", fmt::join(header.cells, ","))),
                              remedy_for(header)));
  return columns;
}

/// Of a table without a header: name, x, y, or as the user numbers them.
Columns numbered_columns(const TableRow& first, const ColumnNames& names) {
  Columns columns{};
  for (std::size_t column = 0; column < kRoles.size(); ++column)
    for (const NamedColumn& named : names)
      for (std::size_t i = 0; named.role == kRoles[column] && i < first.cells.size(); ++i)
        if (is_named(named, first.cells[i], i)) columns.cell[column] = i;
  return columns;
}

double read_coordinate(std::string_view cell, double factor, const std::string& source,
                       std::size_t line) {
  const std::string location = fmt::format("line {}", line);
  if (is_missing(cell)) throw IoError(source, location, "a coordinate is missing");
  const std::optional<double> value = number_in(cell);
  if (!value) throw IoError(source, location, number_problem(cell));
  if (!(std::abs(factor * *value) <= kFarthest_m))
    throw IoError(
        source, location,
        fmt::format("coordinates are in metres, at most {}, got {}", kFarthest_m, in_quotes(cell)));
  return factor * *value;
}

/// A remark on the heights of a file; empty if all are 0, or if they are not numbers.
std::string remark_on_heights(const std::vector<double>& heights_m, const std::string& source) {
  if (std::ranges::all_of(heights_m, [](double height_m) { return height_m == 0.0; })) return "";
  const auto [low, high] = std::ranges::minmax(heights_m);
  return fmt::format(
      "The heights in {} ({:g} to {:g} m) are not used: the map is plane. Ranges to a landmark far "
      "above or below the robot are longer than their distance in the plane.",
      source, low, high);
}

NamedPoints parse_table(std::string_view text, const std::string& source,
                        const ColumnNames& names_of_columns) {
  TableReader reader(text, source);
  TableRow row;
  Columns columns;
  std::size_t width = kRoles.size();
  NameList names(source);
  std::vector<double> coordinates, heights_m;
  for (bool is_first = true; reader.next(row); is_first = false) {
    if (is_first && is_landmarks_header(row)) {
      columns = columns_of(row, source, names_of_columns);
      width = row.cells.size();
      continue;
    }
    if (is_first && !columns_in(row.cells, names_of_columns).empty()) {
      columns = numbered_columns(row, names_of_columns);
      width = row.cells.size();
    }
    if (row.cells.size() != width)
      throw IoError(source, fmt::format("line {}", row.line),
                    fmt::format("has {} cells, expected {}", row.cells.size(),
                                width == 3 ? "name, x, y" : fmt::format("{}", width)));
    names.add(row.cells[columns.cell[0]], row.line);
    for (const std::size_t axis : {1U, 2U})
      coordinates.push_back(
          read_coordinate(row.cells[columns.cell[axis]], columns.factor[axis], source, row.line));
    if (columns.height)
      if (const std::optional<double> height = number_in(row.cells[*columns.height]))
        heights_m.push_back(columns.factor[0] * *height);
  }
  NamedPoints points = named_points(std::move(names), coordinates, source);
  points.heights = remark_on_heights(heights_m, source);
  return points;
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

NamedPoints read_landmarks(ByteSource& source, const ColumnNames& names) {
  respell(source);
  const std::string bytes = source.rest();
  return parse_landmarks(checked_text(bytes, source.name()), source.name(), names);
}

NamedPoints read_landmarks(const std::filesystem::path& path, const ColumnNames& names) {
  ByteSource source(path);
  return read_landmarks(source, names);
}

NamedPoints parse_landmarks(std::string_view text, const std::string& source,
                            const ColumnNames& names) {
  return is_groundtruth(text, source) ? parse_groundtruth(text, source)
                                      : parse_table(text, source, names);
}

bool is_landmarks_table(std::string_view text, const std::string& source,
                        const ColumnNames& names) {
  if (is_groundtruth(text, source)) return true;
  TableReader reader(text, source);
  TableRow row;
  if (!reader.next(row)) return false;
  if (is_landmarks_header(row)) {
    const ColumnNames named = columns_in(row.cells, names);
    std::array<bool, 3> is_found{};
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      if (const Heading heading = heading_of(row.cells[i], i, named); heading.column)
        is_found[*heading.column] = true;
      if (column_heading(row.cells[i], i, named).role == ColumnRole::kTime) return false;
    }
    return is_found[1] && is_found[2];
  }
  std::set<std::string, std::less<>> labels;
  do {
    if (row.cells.size() != 3 || !number_in(row.cells[1]) || !number_in(row.cells[2]) ||
        !labels.emplace(row.cells[0]).second)
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
  return named_points(std::move(names), coordinates, source);
}

}  // namespace mapproof
