#include "core/records/observations/scan_rows.hpp"

#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/records/observations/detection_values.hpp"

namespace mapproof {

void ScanRows::fail(std::size_t line, const std::string& what) const {
  throw IoError(source_, fmt::format("line {}", line), what);
}

ScanKey ScanRows::scan_of(const TableRow& row) {
  if (row.cells.size() != columns_.width)
    fail(row.line, fmt::format("has {} cells, expected {}", row.cells.size(), columns_.width));
  ScanKey scan;
  if (const auto cell = columns_[DetectionColumn::kRobot])
    scan.robot = static_cast<int>(robots_.find_or_add(row.cells[*cell], row.line));
  const std::string_view cell =
      row.cells[*columns_[is_timed() ? DetectionColumn::kTime : DetectionColumn::kStep]];
  const std::optional<double> key = number_in(cell);
  if (!key || !std::isfinite(*key))
    fail(row.line, fmt::format("{}: {}", is_timed() ? "time" : "step", number_problem(cell)));
  scan.key = *key;
  return scan;
}

double ScanRows::value(const TableRow& row, DetectionColumn column, Sensor sensor,
                       AngleUnit unit) const {
  const std::string_view cell = row.cells[*columns_[column]];
  const std::optional<double> value = detection_value(cell, sensor, unit);
  if (!value) fail(row.line, detection_problem(cell, sensor, unit));
  return *value;
}

std::string ScanRows::words(double key) const {
  return fmt::format("{} {:.15g}", is_timed() ? "time" : "step", key);
}

std::vector<std::string> ScanRows::remarks() const {
  if (columns_.unread.empty()) return {};
  return {fmt::format("Columns that are not read: {}", fmt::join(columns_.unread, ", "))};
}

}  // namespace mapproof
