#include "core/records/sighting_rows.hpp"

#include <algorithm>

#include "core/json/text_input.hpp"
#include "core/records/observations.hpp"

namespace mapproof {

bool SightingRows::begin(const TableRow& first) {
  const bool is_header =
      !first.cells.empty() && std::ranges::none_of(first.cells, [](std::string_view cell) {
        return number_in(cell).has_value();
      });
  looks_.set_columns(is_header ? sighting_columns(first, source_)
                               : usual_sighting_columns(first, source_));
  return is_header;
}

Sighting SightingRows::sighting_of(const TableRow& row) {
  const std::string_view label = looks_.label(row);
  if (label.empty())
    looks_.fail(row.line,
                "a sighting without a label: which landmark it shows is not told from looks; leave "
                "such rows out");
  if (label == kUnlabelledMark)
    looks_.fail(row.line,
                "a reading without a label (?): whose such are is estimated of long tables of one "
                "kind of value, up to some 64 MB");
  Sighting seen;
  seen.landmark = static_cast<int>(names_.find_or_add(label, row.line));
  const SightingColumns& columns = looks_.columns();
  if (columns[SightingColumn::kRange])
    seen.range_m = value(row, SightingColumn::kRange, Sensor::kRange);
  if (columns[SightingColumn::kBearing])
    seen.bearing_rad = value(row, SightingColumn::kBearing, Sensor::kBearing);
  if (columns[SightingColumn::kValue]) take_value(row, seen);
  return seen;
}

double SightingRows::value(const TableRow& row, SightingColumn column, Sensor sensor) const {
  return looks_.value(row, column, sensor, looks_.columns().unit.value_or(format_.unit));
}

/// What the column `value` holds was said beforehand.
void SightingRows::take_value(const TableRow& row, Sighting& seen) const {
  if (!format_.value)
    looks_.fail(row.line, "a column of values does not say what they are: range or bearing?");
  if (*format_.value == Sensor::kRange)
    seen.range_m = value(row, SightingColumn::kValue, Sensor::kRange);
  else if (*format_.value == Sensor::kBearing)
    seen.bearing_rad = value(row, SightingColumn::kValue, Sensor::kBearing);
  else if (row.cells[*looks_.columns()[SightingColumn::kValue]] != "1")
    looks_.fail(row.line, "a table of sightings lists what was seen: a visibility of 1");
}

}  // namespace mapproof
