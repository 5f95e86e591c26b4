#include "core/records/detections/detection_rows.hpp"

#include <algorithm>

#include "core/json/text_input.hpp"

namespace mapproof {

bool DetectionRows::begin(const TableRow& first) {
  const bool is_header =
      !first.cells.empty() && std::ranges::none_of(first.cells, [](std::string_view cell) {
        return number_in(cell).has_value();
      });
  scans_.set_columns(is_header ? detection_columns(first, source_)
                               : usual_detection_columns(first, source_));
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
  if (columns[DetectionColumn::kRange])
    seen.range_m = value(row, DetectionColumn::kRange, Sensor::kRange);
  if (columns[DetectionColumn::kBearing])
    seen.bearing_rad = value(row, DetectionColumn::kBearing, Sensor::kBearing);
  if (columns[DetectionColumn::kValue]) take_value(row, seen);
  return seen;
}

double DetectionRows::value(const TableRow& row, DetectionColumn column, Sensor sensor) const {
  return scans_.value(row, column, sensor, scans_.columns().unit.value_or(format_.unit));
}

/// The caller gave what the column `value` holds.
void DetectionRows::take_value(const TableRow& row, Detection& seen) const {
  if (!format_.value)
    scans_.fail(row.line, "a column of values does not state what they are: range or bearing?");
  if (*format_.value == Sensor::kRange)
    seen.range_m = value(row, DetectionColumn::kValue, Sensor::kRange);
  else if (*format_.value == Sensor::kBearing)
    seen.bearing_rad = value(row, DetectionColumn::kValue, Sensor::kBearing);
  else if (row.cells[*scans_.columns()[DetectionColumn::kValue]] != "1")
    scans_.fail(row.line, "a table of detections lists what was seen: a visibility of 1");
}

}  // namespace mapproof
