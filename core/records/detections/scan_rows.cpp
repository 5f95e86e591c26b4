#include "core/records/detections/scan_rows.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/tables/cells.hpp"
#include "core/records/tables/time_text.hpp"

namespace mapproof {
namespace {

/// A heading that says what its column is of no use if it is an index without a name.
bool is_index(std::string_view cell) {
  const std::string word = lower_case(trimmed(cell));
  return word.empty() || word == "index" || word.starts_with("unnamed");
}

/// Which roles a row of headings names.
class NamedRoles {
 public:
  NamedRoles(const TableRow& row, const ColumnNames& names) {
    const ColumnNames columns = columns_in(row.cells, names);
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      const std::optional<ColumnRole> role = column_heading(row.cells[i], i, columns).role;
      if (role) has_[static_cast<std::size_t>(*role)] = true;
    }
  }

  bool operator()(ColumnRole role) const { return has_[static_cast<std::size_t>(role)]; }
  bool has_scan() const { return (*this)(ColumnRole::kStep) || (*this)(ColumnRole::kTime); }
  bool has_position() const {
    return (*this)(ColumnRole::kX) && ((*this)(ColumnRole::kY) || (*this)(ColumnRole::kRight)) &&
           has_scan();
  }
  bool has_measurement() const {
    return (*this)(ColumnRole::kRange) || (*this)(ColumnRole::kBearing) || has_position();
  }

 private:
  std::array<bool, kColumnRoles> has_{};
};

bool is_time_cell(std::string_view cell) {
  return number_in(cell).has_value() || date_in(cell).has_value();
}

/// The columns that a table without a header may have.
constexpr ColumnRole kUsual[] = {ColumnRole::kStep, ColumnRole::kLandmark, ColumnRole::kRange,
                                 ColumnRole::kBearing};

void set_column(DetectionColumns& columns, ColumnRole role, std::size_t cell,
                const std::string& header) {
  columns.cell[static_cast<std::size_t>(role)] = cell;
  columns.read.emplace_back(name(role), header);
}

/// @throws IoError if too little is there.
void require_detections(const DetectionColumns& columns, const std::string& source,
                        const std::string& location) {
  std::string others = columns.unread.empty()
                           ? ""
                           : fmt::format("; there is {}: --columns ROLE=HEADER names them",
                                         fmt::join(columns.unread, ", "));
  const auto ends_in_z = [](const std::string& header) { return header.ends_with(".z\""); };
  if (std::ranges::any_of(columns.unread, ends_in_z))
    others += " (in a camera's frame, which is along z: x=...z,right=...x)";
  if (!columns[ColumnRole::kLandmark])
    throw IoError(source, location, "no column is named landmark" + others);
  if (!columns[ColumnRole::kStep] && !columns[ColumnRole::kTime])
    throw IoError(source, location,
                  "no column is named step or time: which rows are one scan?" + others);
  if (!columns.measure(Sensor::kRange) && !columns.measure(Sensor::kBearing) &&
      !columns.unread.empty())
    throw IoError(source, location,
                  "no column is named range or bearing" + others +
                      "; a list of times and landmarks alone is read as visibility");
}

}  // namespace

bool names_detection_columns(const TableRow& row, const ColumnNames& names) {
  const NamedRoles roles(row, names);
  // Without a landmark, the message names the columns.
  if (!roles(ColumnRole::kLandmark))
    return roles.has_scan() && (roles(ColumnRole::kRange) || roles(ColumnRole::kBearing));
  // Beside times and landmarks, columns of unknown names are measurements, not landmarks.
  return roles.has_measurement() || (roles.has_scan() && !roles(ColumnRole::kValue));
}

bool is_stacked_header(const TableRow& row) {
  return row.cells.size() == 3 && (row.cells[0].empty() || names_steps(row.cells[0])) &&
         (row.cells[1].empty() || row.cells[1] == "level_1") &&
         (row.cells[2].empty() || row.cells[2] == "0");
}

bool names_value_columns(const TableRow& row, const ColumnNames& names) {
  const NamedRoles roles(row, names);
  return roles(ColumnRole::kLandmark) && roles(ColumnRole::kValue);
}

bool is_long_header(const TableRow& row, const ColumnNames& names) {
  bool is_known = false;
  const ColumnNames named = columns_in(row.cells, names);
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    if (is_time_cell(row.cells[i])) return false;
    is_known = is_known || column_heading(row.cells[i], i, named).role;
  }
  return is_known;
}

bool starts_detection_list(const TableRow& row) {
  const auto is_measured = [](std::string_view cell) {
    return is_missing(cell) || number_in(cell);
  };
  const std::size_t width = row.cells.size();
  return (width == 2 || (width == 4 && is_measured(row.cells[2]) && is_measured(row.cells[3]))) &&
         is_time_cell(row.cells[0]) && !row.cells[1].empty() && !is_missing(row.cells[1]) &&
         !number_in(row.cells[1]);
}

MeasuredColumns measured_columns(const TableRow& row, const ColumnNames& names) {
  if (starts_detection_list(row)) {
    const bool is_measured = row.cells.size() > 2;
    return {.range = is_measured, .bearing = is_measured};
  }
  const NamedRoles roles(row, names);
  return {.range = roles(ColumnRole::kRange) || roles.has_position(),
          .bearing = roles(ColumnRole::kBearing) || roles.has_position()};
}

DetectionColumns detection_columns(const TableRow& header, const std::string& source,
                                   const ColumnNames& names) {
  const std::string location = fmt::format("line {}", header.line);
  require_columns(header.cells, names, source);
  const ColumnNames named = columns_in(header.cells, names);
  DetectionColumns columns;
  columns.width = header.cells.size();
  for (std::size_t i = 0; i < header.cells.size(); ++i) {
    const ColumnHeading heading = column_heading(header.cells[i], i, named);
    if (!heading.role) {
      if (!is_index(header.cells[i])) columns.unread.push_back(in_quotes(header.cells[i]));
      continue;
    }
    if (columns[*heading.role])
      throw IoError(source, location,
                    fmt::format("two columns hold a {}: --columns {}=HEADER names the one to read",
                                name(*heading.role), name(*heading.role)));
    if (!heading.unknown_unit.empty())
      throw IoError(source, location,
                    fmt::format("{}: a {} in that unit is not known; m, cm, mm, km, ft, inch, s, "
                                "ms, us, ns, min, h, d, rad or deg",
                                in_quotes(header.cells[i]), name(*heading.role)));
    set_column(columns, *heading.role, i, std::string(header.cells[i]));
    columns.factor[static_cast<std::size_t>(*heading.role)] = heading.factor;
    if (heading.unit) columns.unit = heading.unit;
  }
  require_detections(columns, source, location);
  return columns;
}

DetectionColumns usual_detection_columns(const TableRow& first, const std::string& source,
                                         const ColumnNames& names) {
  require_columns(first.cells, names, source);
  if (!columns_in(first.cells, names).empty()) {
    DetectionColumns columns = detection_columns(first, source, names);
    // The first row is data, not a header.
    columns.unread.clear();
    for (auto& [role, header] : columns.read)
      for (std::size_t k = 0; k < kColumnRoles; ++k)
        if (name(static_cast<ColumnRole>(k)) == role && columns.cell[k])
          header = fmt::format("column {}", *columns.cell[k] + 1);
    return columns;
  }
  const std::size_t width = first.cells.size();
  if (width != 4 && width != 2)
    throw IoError(source, fmt::format("line {}", first.line),
                  fmt::format("has {} cells; a table of detections has a header, or the columns "
                              "step, landmark, range, bearing; --columns names others",
                              width));
  DetectionColumns columns;
  columns.width = width;
  for (std::size_t i = 0; i < width; ++i) set_column(columns, kUsual[i], i, "");
  return columns;
}

void ScanRows::fail(std::size_t line, const std::string& what) const {
  throw IoError(source_, fmt::format("line {}", line), what);
}

/// Tables of R have a row's name in front of each row, which the header does not name.
void ScanRows::skip_row_names() {
  for (std::optional<std::size_t>& cell : columns_.cell)
    if (cell) ++*cell;
  ++columns_.width;
}

double ScanRows::key_of(const TableRow& row) {
  const ColumnRole role = is_timed() ? ColumnRole::kTime : ColumnRole::kStep;
  const std::string_view cell = row.cells[*columns_[role]];
  std::optional<double> key = number_in(cell);
  if (key) {
    *key *= columns_.factor[static_cast<std::size_t>(role)];
  } else {
    key = date_in(cell);
    has_dates_ = has_dates_ || key;
  }
  if (!key || !std::isfinite(*key))
    fail(row.line,
         fmt::format("{}: {}", name(role), is_timed() ? time_problem(cell) : number_problem(cell)));
  if (const auto nanoseconds = columns_[ColumnRole::kNanoseconds]; nanoseconds && is_timed()) {
    const std::optional<double> part = number_in(row.cells[*nanoseconds]);
    if (!part || !std::isfinite(*part))
      fail(row.line, "nanoseconds: " + number_problem(row.cells[*nanoseconds]));
    *key += *part * 1e-9;
  }
  return *key;
}

ScanKey ScanRows::scan_of(const TableRow& row) {
  if (!std::exchange(is_begun_, true) && row.cells.size() == columns_.width + 1 && row.line > 1)
    skip_row_names();
  if (row.cells.size() != columns_.width)
    fail(row.line, fmt::format("has {} cells, expected {}", row.cells.size(), columns_.width));
  ScanKey scan;
  if (const auto cell = columns_[ColumnRole::kRobot])
    scan.robot = static_cast<int>(robots_.find_or_add(row.cells[*cell], row.line));
  scan.key = key_of(row);
  return scan;
}

double ScanRows::value(const TableRow& row, ColumnRole column, Sensor sensor) const {
  const std::string_view cell = row.cells[*columns_[column]];
  const ValueForm form{.unit = columns_.unit.value_or(format_.unit),
                       .factor = columns_.factor[static_cast<std::size_t>(column)],
                       .is_clockwise = is_clockwise(format_.convention)};
  const std::optional<double> value = detection_value(cell, sensor, form);
  if (!value) fail(row.line, detection_problem(cell, sensor, form));
  return *value;
}

double ScanRows::coordinate(const TableRow& row, ColumnRole column) const {
  const std::string_view cell = row.cells[*columns_[column]];
  if (is_missing(cell)) return kNaN;
  const std::optional<double> value = number_in(cell);
  if (!value || !(std::abs(*value) <= kLongestRange_m))
    fail(row.line, fmt::format("{}: {}", name(column),
                               value && std::isfinite(*value)
                                   ? fmt::format("{} m is beyond any sensor", *value)
                                   : number_problem(cell)));
  return *value * columns_.factor[static_cast<std::size_t>(column)];
}

TableReading ScanRows::reading() const {
  return {.form = {},
          .columns = columns_.read,
          .times = has_dates_ ? "dates" : "",
          .unit = columns_.unit.value_or(format_.unit),
          .convention = format_.convention};
}

std::string ScanRows::words(double key) const {
  return fmt::format("{} {:.15g}", is_timed() ? "time" : "step", key);
}

std::vector<std::string> ScanRows::remarks() const {
  if (columns_.unread.empty()) return {};
  return {fmt::format("Columns that are not read: {}", fmt::join(columns_.unread, ", "))};
}

}  // namespace mapproof
