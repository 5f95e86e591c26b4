#include "core/records/ranges/range_columns.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/tables/time_text.hpp"

namespace mapproof {
namespace {

const RangeColumn kLandmark{ColumnRole::kLandmark, "landmarks", {}};
const RangeColumn kNanoseconds{ColumnRole::kNanoseconds, "nanoseconds", {}, false};

/// Examples of usual headers, for errors.
std::string_view usual_headers(ColumnRole role) {
  switch (role) {
    case ColumnRole::kTime:
      return "t, time, timestamp, stamp, datetime";
    case ColumnRole::kLandmark:
      return "beacon, landmark, id, tag, name";
    case ColumnRole::kDistance:
      return "ddist, distance";
    case ColumnRole::kHeadingChange:
      return "dheading, turn";
    default:
      return name(role);
  }
}

/// The factor to s, m or rad of a header's cell that is the column; empty: it is another one.
std::optional<double> factor_of(const RangeColumn& column, std::string_view cell,
                                const std::string& location, const std::string& source) {
  if (const std::optional<double> factor = column_factor(cell, column.role, column.words))
    return factor;
  const ColumnHeading heading = column_heading(cell, 0, {});
  if (heading.role != column.role) return std::nullopt;
  if (!heading.unknown_unit.empty())
    throw IoError(source, location,
                  fmt::format("{}: {} in that unit are not known", in_quotes(cell), column.label));
  return heading.factor;
}

/// Where a column is in the rows.
struct Cell {
  ColumnRole role;
  std::size_t index;
  double factor;
  bool has_unit;  ///< In the header, other than s, m or rad.
};

std::optional<std::size_t> named_cell(ColumnRole role, const TableRow& header,
                                      const ColumnNames& names) {
  const ColumnNames found = columns_in(header.cells, names);
  const auto named = std::ranges::find(found, role, &NamedColumn::role);
  for (std::size_t i = 0; named != found.end() && i < header.cells.size(); ++i)
    if (is_named(*named, header.cells[i], i)) return i;
  return std::nullopt;
}

bool is_of_motion(ColumnRole role) {
  return role == ColumnRole::kDistance || role == ColumnRole::kHeadingChange ||
         role == ColumnRole::kSideways;
}

/// @throws IoError for a speed or a rate of turning.
void require_increment(std::string_view cell, const std::string& source,
                       const std::string& location) {
  if (names_rate(cell))
    throw IoError(
        source, location,
        fmt::format("{} is a speed or a rate of turning; odometry is the way [m] and the "
                    "heading change [rad] since the row before. With dt between the rows: "
                    "dheading = w dt, ddist = v dt cos(dheading / 2), dside = v dt "
                    "sin(dheading / 2)",
                    in_quotes(cell)));
}

/// @throws IoError for a table of motions that has speeds or poses in their place.
void require_motions(const TableRow& header, const std::string& source,
                     const std::string& location) {
  bool has_x = false, has_y = false;
  for (const std::string_view cell : header.cells) {
    require_increment(cell, source, location);
    has_x = has_x || column_heading(cell, 0, {}).role == ColumnRole::kX;
    has_y = has_y || column_heading(cell, 0, {}).role == ColumnRole::kY;
  }
  if (has_x && has_y)
    throw IoError(
        source, location,
        "holds poses (x, y); odometry is the way [m] and the heading change [rad] since "
        "the row before. Of the differences dx, dy and dheading to the row before, with its "
        "heading h: ddist = dx cos h + dy sin h, dside = dy cos h - dx sin h");
}

/// @throws IoError if the column is needed but not there, or there twice.
std::optional<Cell> cell_of(const RangeColumn& column, const TableRow& header,
                            const std::string& source, const ColumnNames& names) {
  const std::string location = fmt::format("line {}", header.line);
  if (const auto named = named_cell(column.role, header, names)) {
    if (std::ranges::count(columns_in(header.cells, names), column.role, &NamedColumn::role) > 1)
      throw IoError(source, location,
                    fmt::format("--columns names two of its columns for {}", name(column.role)));
    if (is_of_motion(column.role)) require_increment(header.cells[*named], source, location);
    if (!column_heading(header.cells[*named], *named, names).unknown_unit.empty())
      throw IoError(source, location,
                    fmt::format("{}: {} in that unit are not known",
                                in_quotes(header.cells[*named]), column.label));
    const double factor = named_column_factor(header.cells[*named], column.role);
    return Cell{column.role, *named, factor, factor != 1.0};
  }
  std::optional<Cell> found;
  for (std::size_t i = 0; i < header.cells.size(); ++i) {
    const std::optional<double> factor = factor_of(column, header.cells[i], location, source);
    if (!factor) continue;
    if (found)
      throw IoError(source, location,
                    fmt::format("two columns of {}: --columns {}=HEADER names the one to read",
                                column.label, name(column.role)));
    found = Cell{column.role, i, *factor, *factor != 1.0};
  }
  if (found || !column.is_needed) return found;
  require_named(column.role, header, source, names);
  if (is_of_motion(column.role)) require_motions(header, source, location);
  throw IoError(source, location,
                fmt::format("no column of {}: expected {} in the header; --columns {}=HEADER "
                            "names another",
                            column.label, usual_headers(column.role), name(column.role)));
}

/// In the unit of the column. @param is_time  A date does as well.
double number_at(const TableRow& row, std::size_t cell, bool is_time, const std::string& source) {
  const std::optional<double> value =
      is_time ? time_in(row.cells[cell]) : number_in(row.cells[cell]);
  if (!value || !std::isfinite(*value))
    throw IoError(source, fmt::format("line {}", row.line),
                  is_time ? time_problem(row.cells[cell]) : number_problem(row.cells[cell]));
  return *value;
}

std::string name_at(const TableRow& row, std::size_t cell, const std::string& source) {
  const std::string_view name = row.cells[cell];
  if (name.empty() || name.size() > kLongestName)
    throw IoError(source, fmt::format("line {}", row.line),
                  name.empty() ? "a landmark without a name" : "a name that is too long");
  return std::string(name);
}

/// Brings times to seconds whose size shows another unit, and adds the nanoseconds in the last
/// column.
void scale_times(const std::vector<Cell>& cells, Eigen::MatrixXd& values) {
  if (cells.empty() || cells[0].role != ColumnRole::kTime || values.rows() == 0) return;
  if (!cells[0].has_unit) {
    const Eigen::VectorXd times = values.col(0);
    values.col(0) *= time_scale({times.data(), static_cast<std::size_t>(times.size())}).seconds;
  }
  if (cells.back().role != ColumnRole::kNanoseconds) return;
  values.col(0) += 1e-9 * values.rightCols(1);
  values.conservativeResize(values.rows(), values.cols() - 1);
}

}  // namespace

void require_named(ColumnRole role, const TableRow& header, const std::string& source,
                   const ColumnNames& names) {
  const auto named = std::ranges::find(names, role, &NamedColumn::role);
  if (named != names.end()) require_columns(header.cells, {{named->role, named->header}}, source);
}

std::vector<ColumnRole> missing_columns(const TableRow& header,
                                        const std::vector<RangeColumn>& columns,
                                        const ColumnNames& names) {
  std::vector<std::optional<ColumnRole>> roles;
  for (const std::string_view cell : header.cells)
    roles.push_back(column_heading(cell, 0, {}).role);
  std::vector<ColumnRole> missing;
  for (const RangeColumn& column : columns) {
    const auto has_word = [&](std::string_view cell) {
      return column_factor(cell, column.role, column.words).has_value();
    };
    if (column.is_needed && std::ranges::find(roles, column.role) == roles.end() &&
        !named_cell(column.role, header, names) && std::ranges::none_of(header.cells, has_word))
      missing.push_back(column.role);
  }
  return missing;
}

std::vector<ColumnRole> missing_range_columns(const TableRow& header, const ColumnNames& names) {
  return missing_columns(
      header, {{ColumnRole::kTime, "", {}}, kLandmark, {ColumnRole::kRange, "", {}}}, names);
}

NumberTable read_range_columns(ByteSource& input, const std::vector<RangeColumn>& numbers,
                               bool landmarks, const ColumnNames& names) {
  input.take_text();
  const std::string bytes = input.rest();
  const std::string& source = input.name();
  TableReader reader(checked_text(bytes, source), source);
  TableRow row;
  if (!reader.next(row)) throw IoError(source, "is empty");
  const std::size_t width = row.cells.size();
  std::vector<Cell> cells;
  for (const RangeColumn& column : numbers)
    if (const auto cell = cell_of(column, row, source, names)) cells.push_back(*cell);
  if (!cells.empty() && cells[0].role == ColumnRole::kTime)
    if (const auto cell = cell_of(kNanoseconds, row, source, names)) cells.push_back(*cell);
  const auto name_cell = landmarks ? cell_of(kLandmark, row, source, names) : std::optional<Cell>();

  NumberTable table{.source = source, .separator = reader.separator()};
  for (const Cell& cell : cells) table.columns.emplace_back(name(cell.role), row.cells[cell.index]);
  if (name_cell) table.columns.emplace_back(name(name_cell->role), row.cells[name_cell->index]);
  std::vector<double> values;
  while (reader.next(row)) {
    if (row.cells.size() != width)
      throw IoError(source, fmt::format("line {}", row.line),
                    fmt::format("has {} cells, expected {}", row.cells.size(), width));
    if (table.rows.size() == kMostSteps)
      throw IoError(source, fmt::format("more than {} rows", kMostSteps));
    const auto is_unmeasured = [&](const Cell& cell) {
      return cell.role == ColumnRole::kRange && is_missing(row.cells[cell.index]);
    };
    if (std::ranges::any_of(cells, is_unmeasured)) {
      ++table.left_out;
      continue;
    }
    table.rows.push_back(row.line);
    for (const Cell& cell : cells)
      values.push_back(cell.factor *
                       number_at(row, cell.index, cell.role == ColumnRole::kTime, source));
    if (name_cell) table.names.push_back(name_at(row, name_cell->index, source));
  }
  table.set_values(values, std::ssize(cells));
  scale_times(cells, table.values);
  return table;
}

}  // namespace mapproof
