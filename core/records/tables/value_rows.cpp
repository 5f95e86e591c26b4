#include "core/records/tables/value_rows.hpp"

namespace mapproof {
namespace {

/// Of a table without a header.
DetectionColumns usual_columns() {
  DetectionColumns columns;
  columns.width = 3;
  columns.read = {{"step", ""}, {"landmark", ""}, {"value", ""}};
  std::size_t cell = 0;
  for (const ColumnRole column : {ColumnRole::kStep, ColumnRole::kLandmark, ColumnRole::kValue})
    columns.cell[static_cast<std::size_t>(column)] = cell++;
  return columns;
}

}  // namespace

ValueRows::ValueRows(const std::string& source, Sensor sensor, const TableFormat& format)
    : sensor_(sensor), columns_(format.columns), scans_(source, format), names_(source) {
  scans_.set_columns(usual_columns());
}

bool ValueRows::begin(const TableRow& first) {
  if (columns_.empty() && is_stacked_header(first)) return true;  // In the usual order.
  const bool is_header = is_long_header(first, columns_);
  require_columns(first.cells, columns_, scans_.source());
  if (!is_header && columns_in(first.cells, columns_).empty()) return false;
  scans_.set_columns(detection_columns(first, scans_.source(), columns_));
  if (!scans_.columns()[ColumnRole::kValue]) scans_.fail(first.line, "no column is named value");
  return is_header;
}

ValueRows::Measured ValueRows::measured(const TableRow& row) {
  const ScanKey scan = scans_.scan_of(row);
  const double value = scans_.value(row, ColumnRole::kValue, sensor_);
  const std::string_view label = scans_.label(row);
  return {.landmark = label == kUnassociatedMark ? -1 : names_.find_or_add(label, row.line),
          .scan = scan,
          .value = value,
          .line = row.line};
}

}  // namespace mapproof
