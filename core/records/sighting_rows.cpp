#include "core/records/sighting_rows.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/records/observations.hpp"
#include "core/records/sighting_values.hpp"

namespace mapproof {

void SightingRows::fail(const TableRow& row, const std::string& what) const {
  throw IoError(source_, fmt::format("line {}", row.line), what);
}

bool SightingRows::begin(const TableRow& first) {
  const bool is_header =
      !first.cells.empty() && std::ranges::none_of(first.cells, [](std::string_view cell) {
        return number_in(cell).has_value();
      });
  columns_ = is_header ? sighting_columns(first, source_) : usual_sighting_columns(first, source_);
  return is_header;
}

LookKey SightingRows::look_of(const TableRow& row) {
  if (row.cells.size() != columns_.width)
    fail(row, fmt::format("has {} cells, expected {}", row.cells.size(), columns_.width));
  LookKey look;
  if (const auto cell = columns_[SightingColumn::kRobot])
    look.robot = static_cast<int>(robots_.find_or_add(row.cells[*cell], row.line));
  const std::string_view cell =
      row.cells[*columns_[is_timed() ? SightingColumn::kTime : SightingColumn::kStep]];
  const std::optional<double> key = number_in(cell);
  if (!key || !std::isfinite(*key))
    fail(row, fmt::format("{}: {}", is_timed() ? "time" : "step", number_problem(cell)));
  look.key = *key;
  return look;
}

Sighting SightingRows::sighting_of(const TableRow& row) {
  const std::string_view label = row.cells[*columns_[SightingColumn::kLandmark]];
  if (label.empty())
    fail(row,
         "a sighting without a label: which landmark it shows is not told from looks; leave such "
         "rows out");
  if (label == kUnlabelledMark)
    fail(row,
         "a reading without a label (?): whose such are is estimated of long tables of one kind of "
         "value, up to some 64 MB");
  Sighting seen;
  seen.landmark = static_cast<int>(names_.find_or_add(label, row.line));
  if (const auto cell = columns_[SightingColumn::kRange])
    seen.range_m = value(row, *cell, Sensor::kRange);
  if (const auto cell = columns_[SightingColumn::kBearing])
    seen.bearing_rad = value(row, *cell, Sensor::kBearing);
  if (const auto cell = columns_[SightingColumn::kValue]) take_value(row, *cell, seen);
  return seen;
}

double SightingRows::value(const TableRow& row, std::size_t cell, Sensor sensor) const {
  const AngleUnit unit = columns_.unit.value_or(format_.unit);
  const std::optional<double> value = sighting_value(row.cells[cell], sensor, unit);
  if (!value) fail(row, sighting_problem(row.cells[cell], sensor, unit));
  return *value;
}

/// What the column `value` holds was said beforehand.
void SightingRows::take_value(const TableRow& row, std::size_t cell, Sighting& seen) const {
  if (!format_.value) fail(row, "a column of values does not say what they are: range or bearing?");
  if (*format_.value == Sensor::kRange)
    seen.range_m = value(row, cell, Sensor::kRange);
  else if (*format_.value == Sensor::kBearing)
    seen.bearing_rad = value(row, cell, Sensor::kBearing);
  else if (row.cells[cell] != "1")
    fail(row, "a table of sightings lists what was seen: a visibility of 1");
}

std::vector<std::string> SightingRows::remarks() const {
  if (columns_.unread.empty()) return {};
  return {fmt::format("Columns that are not read: {}", fmt::join(columns_.unread, ", "))};
}

}  // namespace mapproof
