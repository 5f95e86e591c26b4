#include "core/records/detections/detection_rows.hpp"

#include <algorithm>
#include <cmath>

#include "core/json/text_input.hpp"

namespace mapproof {

bool DetectionRows::begin(const TableRow& first) {
  const bool is_header = is_long_header(first, format_.columns) ||
                         (!starts_detection_list(first) &&
                          std::ranges::none_of(first.cells, [](std::string_view cell) {
                            return number_in(cell).has_value();
                          }));
  scans_.set_columns(is_header ? detection_columns(first, source_, format_.columns)
                               : usual_detection_columns(first, source_, format_.columns));
  return is_header;
}

Detection DetectionRows::detection_of(const TableRow& row) {
  const std::string_view label = scans_.label(row);
  if (label.empty())
    scans_.fail(
        row.line,
        "a detection without a landmark ID: the data association of scans is not estimated; "
        "leave such rows out");
  if (label == kUnassociatedMark)
    scans_.fail(
        row.line,
        "a measurement without a landmark ID (?): the data association is estimated for long "
        "tables of one sensor's values, up to some 64 MB");
  Detection seen;
  seen.landmark = static_cast<int>(names_.find_or_add(label, row.line));
  const DetectionColumns& columns = scans_.columns();
  if (columns[ColumnRole::kRange])
    seen.range_m = scans_.value(row, ColumnRole::kRange, Sensor::kRange);
  if (columns[ColumnRole::kBearing])
    seen.bearing_rad = scans_.value(row, ColumnRole::kBearing, Sensor::kBearing);
  if (columns.has_position()) take_position(row, seen);
  if (columns[ColumnRole::kValue]) take_value(row, seen);
  return seen;
}

/// Of a position in the robot's frame; a range or bearing of its own is more precise.
void DetectionRows::take_position(const TableRow& row, Detection& seen) const {
  const bool is_left = scans_.columns()[ColumnRole::kY].has_value();
  const double x = scans_.coordinate(row, ColumnRole::kX);
  const double y = is_left ? scans_.coordinate(row, ColumnRole::kY)
                           : -scans_.coordinate(row, ColumnRole::kRight);
  if (!scans_.columns()[ColumnRole::kRange]) seen.range_m = std::hypot(x, y);
  if (!scans_.columns()[ColumnRole::kBearing]) seen.bearing_rad = std::atan2(y, x);
}

/// The caller gave what the column `value` holds.
void DetectionRows::take_value(const TableRow& row, Detection& seen) const {
  if (!format_.value)
    scans_.fail(row.line, "a column of values does not state what they are: range or bearing?");
  if (*format_.value == Sensor::kRange)
    seen.range_m = scans_.value(row, ColumnRole::kValue, Sensor::kRange);
  else if (*format_.value == Sensor::kBearing)
    seen.bearing_rad = scans_.value(row, ColumnRole::kValue, Sensor::kBearing);
  else if (row.cells[*scans_.columns()[ColumnRole::kValue]] != "1")
    scans_.fail(row.line, "a table of detections lists what was seen: a visibility of 1");
}

}  // namespace mapproof
