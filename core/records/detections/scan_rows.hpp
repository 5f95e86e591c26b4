#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/model/detection_log.hpp"
#include "core/records/observations/name_list.hpp"
#include "core/records/observations/sources.hpp"
#include "core/records/tables/column_names.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {

/// Which cell of a row holds what.
struct DetectionColumns {
  std::array<std::optional<std::size_t>, kColumnRoles> cell;  ///< By ColumnRole.
  std::array<double, kColumnRoles> factor;  ///< Metres or seconds of one unit, by ColumnRole.
  std::size_t width = 0;                    ///< Cells of a row.
  std::optional<AngleUnit> unit;            ///< Of the bearings, if the header states it.
  std::vector<std::string> unread;          ///< Columns of other names.
  /// Role and header of those that are read.
  std::vector<std::pair<std::string, std::string>> read;

  DetectionColumns() { factor.fill(1.0); }

  std::optional<std::size_t> operator[](ColumnRole column) const {
    return cell[static_cast<std::size_t>(column)];
  }

  /// Whether they hold a position in the robot's frame.
  bool has_position() const {
    return (*this)[ColumnRole::kX] && ((*this)[ColumnRole::kY] || (*this)[ColumnRole::kRight]);
  }

  /// Whether they hold what the sensor measures, or may: the user states what a value is.
  bool measure(Sensor sensor) const {
    return sensor == Sensor::kVisibility || has_position() || (*this)[ColumnRole::kValue] ||
           (*this)[sensor == Sensor::kRange ? ColumnRole::kRange : ColumnRole::kBearing];
  }
};

/// Whether a row names columns of such a table: a landmark and something measured, by the words
/// that are known for them, whatever their case and units ("Range [m]", "bearing_deg"); or a step
/// or time and a landmark, and nothing else.
bool names_detection_columns(const TableRow& row, const ColumnNames& names = {});

/// Whether a row names columns of a long table of observations: a landmark and a value.
bool names_value_columns(const TableRow& row, const ColumnNames& names = {});

/// Whether the header names at most the steps of a long table, as Series.to_csv() of a frame that
/// pandas stacked: "time,,0".
bool is_stacked_header(const TableRow& row);

/// Whether a table's first row is its header: no cell is a number or a date.
bool is_long_header(const TableRow& row, const ColumnNames& names = {});

/// Whether a table without a header lists detections: a number or date, then the name of a landmark,
/// which must be other than a number; and nothing else, or range and bearing.
bool starts_detection_list(const TableRow& row);

/// What the columns of detections measure: range, bearing, both, or nothing, visibility.
struct MeasuredColumns {
  bool range = false;
  bool bearing = false;
};
MeasuredColumns measured_columns(const TableRow& row, const ColumnNames& names = {});

/// @throws IoError at the header's line if two columns are the same, one that is needed is not
///         there, or a unit is not known.
DetectionColumns detection_columns(const TableRow& header, const std::string& source,
                                   const ColumnNames& names = {});

/// Of a table without a header: as the user numbers them, or step, landmark, range, bearing, of
/// which the last two may be missing. @throws IoError if the first row has another number of cells.
DetectionColumns usual_detection_columns(const TableRow& first, const std::string& source,
                                         const ColumnNames& names = {});

/// What the rows of every long table have in common: each is one landmark in one scan, and the
/// columns determine which scan that is.
class ScanRows {
 public:
  /// @param source  What to call the table in errors; must outlive the object.
  ScanRows(const std::string& source, const TableFormat& format)
      : source_(source), format_(format), robots_(source) {}

  const std::string& source() const { return source_; }

  void set_columns(DetectionColumns columns) { columns_ = std::move(columns); }
  const DetectionColumns& columns() const { return columns_; }

  /// @throws IoError with the line for a row of another width, or whose scan is not a number.
  ScanKey scan_of(const TableRow& row);

  /// What a cell holds in metres or radians, or 0 and 1; NaN if it is missing.
  /// @throws IoError with the line for anything else.
  double value(const TableRow& row, ColumnRole column, Sensor sensor) const;

  /// The same of a coordinate in metres, which may be negative.
  double coordinate(const TableRow& row, ColumnRole column) const;

  /// The landmark's ID. @pre After scan_of() of the row.
  std::string_view label(const TableRow& row) const {
    return row.cells[*columns_[ColumnRole::kLandmark]];
  }

  bool is_timed() const { return !columns_[ColumnRole::kStep]; }
  /// Names of the robots, by ScanKey::robot; none if no column distinguishes them.
  const std::vector<std::string>& robots() const { return robots_.names(); }

  /// "step 3" or "time 3.5", as errors name a scan.
  std::string words(double key) const;

  /// What was understood of the columns.
  TableReading reading() const;

  /// Remarks on the columns, a sentence each.
  std::vector<std::string> remarks() const;

  [[noreturn]] void fail(std::size_t line, const std::string& what) const;

 private:
  double key_of(const TableRow& row);
  void skip_row_names();

  const std::string& source_;
  TableFormat format_;
  DetectionColumns columns_;
  NameList robots_;
  bool has_dates_ = false;
  bool is_begun_ = false;  ///< A row was read.
};

}  // namespace mapproof
