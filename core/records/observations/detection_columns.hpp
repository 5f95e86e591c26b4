#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/records/observations/detections.hpp"
#include "core/records/observations/table_reader.hpp"

namespace mapproof {

/// What a column of a long table of detections holds.
enum class DetectionColumn { kStep, kTime, kRobot, kLandmark, kRange, kBearing, kValue };

/// Which cell of a row holds what.
struct DetectionColumns {
  std::array<std::optional<std::size_t>, 7> cell;  ///< By DetectionColumn.
  std::size_t width = 0;                           ///< Cells of a row.
  std::optional<AngleUnit> unit;                   ///< Of the bearings, if the header says it.
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

}  // namespace mapproof
