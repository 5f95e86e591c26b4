#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/model/detection_log.hpp"
#include "core/records/observations/name_list.hpp"
#include "core/records/observations/sources.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {

/// What a column of a long table of detections holds.
enum class DetectionColumn { kStep, kTime, kRobot, kLandmark, kRange, kBearing, kValue };

/// Which cell of a row holds what.
struct DetectionColumns {
  std::array<std::optional<std::size_t>, 7> cell;  ///< By DetectionColumn.
  std::size_t width = 0;                           ///< Cells of a row.
  std::optional<AngleUnit> unit;                   ///< Of the bearings, if the header states it.
  std::vector<std::string> unread;                 ///< Columns of other names.

  std::optional<std::size_t> operator[](DetectionColumn column) const {
    return cell[static_cast<std::size_t>(column)];
  }
};

/// Whether a row names columns of such a table: a landmark and something measured, by the words
/// that are known for them, whatever their case and units ("Range [m]", "bearing_deg").
bool names_detection_columns(const TableRow& row);

/// Whether a row names columns of a long table of observations: a landmark and a value.
bool names_value_columns(const TableRow& row);

/// Whether a table's first row is its header: one cell names a column, and none is a number.
bool is_long_header(const TableRow& row);

/// @throws IoError at the header's line if two columns are the same, one that is needed is not
///         there, or a unit is not known.
DetectionColumns detection_columns(const TableRow& header, const std::string& source);

/// Of a table without a header: step, landmark, range, bearing. @throws IoError if the first row
/// has another number of cells.
DetectionColumns usual_detection_columns(const TableRow& first, const std::string& source);

/// What the rows of every long table have in common: each is one landmark in one scan, and the
/// columns determine which scan that is.
class ScanRows {
 public:
  /// @param source  What to call the table in errors; must outlive the object.
  explicit ScanRows(const std::string& source) : source_(source), robots_(source) {}

  const std::string& source() const { return source_; }

  void set_columns(DetectionColumns columns) { columns_ = std::move(columns); }
  const DetectionColumns& columns() const { return columns_; }

  /// @throws IoError with the line for a row of another width, or whose scan is not a number.
  ScanKey scan_of(const TableRow& row);

  /// What a cell holds in metres or radians, or 0 and 1; NaN if it is missing.
  /// @throws IoError with the line for anything else.
  double value(const TableRow& row, DetectionColumn column, Sensor sensor, AngleUnit unit) const;

  /// The landmark's ID. @pre After scan_of() of the row.
  std::string_view label(const TableRow& row) const {
    return row.cells[*columns_[DetectionColumn::kLandmark]];
  }

  bool is_timed() const { return !columns_[DetectionColumn::kStep]; }
  /// Names of the robots, by ScanKey::robot; none if no column distinguishes them.
  const std::vector<std::string>& robots() const { return robots_.names(); }

  /// "step 3" or "time 3.5", as errors name a scan.
  std::string words(double key) const;

  /// Remarks on the columns, a sentence each.
  std::vector<std::string> remarks() const;

  [[noreturn]] void fail(std::size_t line, const std::string& what) const;

 private:
  const std::string& source_;
  DetectionColumns columns_;
  NameList robots_;
};

}  // namespace mapproof
