#include "core/records/value_rows.hpp"

#include "core/records/observations.hpp"

namespace mapproof {
namespace {

/// Of a table without a header.
SightingColumns usual_columns() {
  SightingColumns columns;
  columns.width = 3;
  std::size_t cell = 0;
  for (const SightingColumn column :
       {SightingColumn::kStep, SightingColumn::kLandmark, SightingColumn::kValue})
    columns.cell[static_cast<std::size_t>(column)] = cell++;
  return columns;
}

}  // namespace

ValueRows::ValueRows(const std::string& source, Sensor sensor, AngleUnit unit)
    : sensor_(sensor), unit_(unit), looks_(source), names_(source) {
  looks_.set_columns(usual_columns());
}

bool ValueRows::begin(const TableRow& first) {
  if (!is_long_header(first)) return false;
  looks_.set_columns(sighting_columns(first, looks_.source()));
  if (!looks_.columns()[SightingColumn::kValue])
    looks_.fail(first.line, "no column is named value");
  return true;
}

ValueRows::Reading ValueRows::reading(const TableRow& row) {
  const LookKey look = looks_.look_of(row);
  const double value = looks_.value(row, SightingColumn::kValue, sensor_, unit_);
  const std::string_view label = looks_.label(row);
  return {.landmark = label == kUnlabelledMark ? -1 : names_.find_or_add(label, row.line),
          .look = look,
          .value = value,
          .line = row.line};
}

}  // namespace mapproof
