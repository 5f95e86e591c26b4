#include "core/records/tables/value_rows.hpp"

namespace mapproof {
namespace {

/// Of a table without a header.
DetectionColumns usual_columns() {
  DetectionColumns columns;
  columns.width = 3;
  std::size_t cell = 0;
  for (const DetectionColumn column :
       {DetectionColumn::kStep, DetectionColumn::kLandmark, DetectionColumn::kValue})
    columns.cell[static_cast<std::size_t>(column)] = cell++;
  return columns;
}

}  // namespace

ValueRows::ValueRows(const std::string& source, Sensor sensor, AngleUnit unit)
    : sensor_(sensor), unit_(unit), scans_(source), names_(source) {
  scans_.set_columns(usual_columns());
}

bool ValueRows::begin(const TableRow& first) {
  if (!is_long_header(first)) return false;
  scans_.set_columns(detection_columns(first, scans_.source()));
  if (!scans_.columns()[DetectionColumn::kValue])
    scans_.fail(first.line, "no column is named value");
  return true;
}

ValueRows::Measured ValueRows::measured(const TableRow& row) {
  const ScanKey scan = scans_.scan_of(row);
  const double value = scans_.value(row, DetectionColumn::kValue, sensor_, unit_);
  const std::string_view label = scans_.label(row);
  return {.landmark = label == kUnassociatedMark ? -1 : names_.find_or_add(label, row.line),
          .scan = scan,
          .value = value,
          .line = row.line};
}

}  // namespace mapproof
