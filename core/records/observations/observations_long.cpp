#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/observations/detection_columns.hpp"
#include "core/records/observations/observation_values.hpp"
#include "core/records/observations/table_reader.hpp"
#include "core/records/observations/value_rows.hpp"

namespace mapproof {
namespace {

using Reading = ValueRows::Reading;

/// Ascending. Rows mostly come step by step, so that little is left to sort.
std::vector<ScanKey> distinct_scans(const std::vector<Reading>& readings) {
  std::vector<ScanKey> steps;
  for (const Reading& reading : readings)
    if (steps.empty() || steps.back() != reading.scan) steps.push_back(reading.scan);
  std::ranges::sort(steps);
  const auto rest = std::ranges::unique(steps);
  steps.erase(rest.begin(), rest.end());
  return steps;
}

[[noreturn]] void refuse_repeat(const Reading& repeat, const std::vector<Reading>& readings,
                                const ValueRows& rows, const std::string& source) {
  const auto first = std::ranges::find_if(readings, [&](const Reading& reading) {
    return reading.landmark == repeat.landmark && reading.scan == repeat.scan;
  });
  const std::string& name = rows.names().names()[static_cast<std::size_t>(repeat.landmark)];
  throw IoError(source, fmt::format("line {}", repeat.line),
                fmt::format("landmark {} at {} is already on line {}", in_quotes(name),
                            rows.scans().words(repeat.scan.key), first->line));
}

/// @param others  What stands where nothing is listed.
Eigen::MatrixXd arrange(const std::vector<Reading>& readings, const ValueRows& rows, double others,
                        const std::string& source) {
  const std::vector<ScanKey> steps = distinct_scans(readings);
  const std::size_t count = rows.names().names().size();
  check_size(source, "as a whole", count, steps.size());
  const auto landmarks = static_cast<Eigen::Index>(count);
  Eigen::MatrixXd values =
      Eigen::MatrixXd::Constant(landmarks, static_cast<Eigen::Index>(steps.size()), others);
  std::vector<bool> is_set(static_cast<std::size_t>(values.size()));
  std::size_t column = 0;
  for (const Reading& reading : readings) {
    if (reading.landmark < 0) continue;
    if (steps[column] != reading.scan)
      column =
          static_cast<std::size_t>(std::ranges::lower_bound(steps, reading.scan) - steps.begin());
    auto is_repeated = is_set[column * count + static_cast<std::size_t>(reading.landmark)];
    if (is_repeated) refuse_repeat(reading, readings, rows, source);
    is_repeated = true;
    values(reading.landmark, static_cast<Eigen::Index>(column)) = reading.value;
  }
  return values;
}

std::vector<UnlabelledReading> unlabelled_in(const std::vector<Reading>& readings) {
  std::vector<UnlabelledReading> unlabelled;
  if (std::ranges::none_of(readings, [](const Reading& reading) { return reading.landmark < 0; }))
    return unlabelled;
  const std::vector<ScanKey> scans = distinct_scans(readings);
  for (const Reading& reading : readings)
    if (reading.landmark < 0)
      unlabelled.push_back({.step = std::ranges::lower_bound(scans, reading.scan) - scans.begin(),
                            .number = reading.scan.key,
                            .value = reading.value,
                            .line = reading.line});
  return unlabelled;
}

}  // namespace

bool has_long_header(std::string_view text, const std::string& source) {
  TableReader reader(text, source);
  TableRow row;
  if (!reader.next(row)) return false;
  return names_value_columns(row);
}

bool starts_as_long(std::string_view text, const std::string& source) {
  TableReader reader(text, source);
  TableRow row;
  if (!reader.next(row) || row.cells.size() != 3) return false;
  const auto is_value = [](std::string_view cell) { return is_missing(cell) || number_in(cell); };
  return number_in(row.cells[0]) && !is_value(row.cells[1]) && is_value(row.cells[2]);
}

ObservationSource read_long(std::string_view text, const std::string& source, Sensor sensor,
                            AngleUnit unit) {
  TableReader reader(text, source);
  TableRow row;
  ValueRows rows(source, sensor, unit);
  std::vector<Reading> readings;
  for (bool is_first = true; reader.next(row); is_first = false) {
    if (is_first && rows.begin(row)) continue;
    readings.push_back(rows.reading(row));
    if (static_cast<double>(readings.size()) > kMostEntries)
      throw IoError(source, fmt::format("more than {:.0f} rows", kMostEntries));
  }
  if (readings.empty()) throw IoError(source, "holds no observations");
  const bool lists_detections =
      sensor == Sensor::kVisibility &&
      std::ranges::all_of(readings, [](const Reading& reading) { return reading.value == 1.0; });
  const double others = lists_detections ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  ObservationSource result{.history = {.sensor = sensor,
                                       .names = rows.names().names(),
                                       .values = arrange(readings, rows, others, source)},
                           .truth_m = std::nullopt,
                           .remarks = rows.scans().remarks(),
                           .places = rows.names().places(),
                           .path = source,
                           .unlabelled = unlabelled_in(readings)};
  if (lists_detections)
    result.remarks.push_back(
        "Only detections are listed: all other readings are taken as not seen");
  return result;
}

}  // namespace mapproof
