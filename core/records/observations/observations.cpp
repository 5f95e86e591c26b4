#include "core/records/observations/observations.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/not_finite.hpp"
#include "core/json/text_input.hpp"
#include "core/records/detections/detections.hpp"
#include "core/records/detections/mrclam.hpp"
#include "core/records/detections/scan_grouping.hpp"
#include "core/records/limits.hpp"
#include "core/records/observations/grid_table.hpp"
#include "core/records/observations/input_kind.hpp"
#include "core/records/observations/observation_json.hpp"
#include "core/records/observations/sources.hpp"
#include "core/records/tables/cells.hpp"
#include "core/records/tables/respelling.hpp"
#include "core/records/tables/table_reader.hpp"
#include "core/records/tables/table_stream.hpp"
#include "core/records/tables/time_text.hpp"
#include "core/records/tables/value_rows.hpp"

namespace mapproof {
namespace {

using Measured = ValueRows::Measured;

/// Ascending. Rows mostly come step by step, so that little is left to sort.
std::vector<ScanKey> distinct_scans(const std::vector<Measured>& measurements) {
  std::vector<ScanKey> steps;
  for (const Measured& measured : measurements)
    if (steps.empty() || steps.back() != measured.scan) steps.push_back(measured.scan);
  std::ranges::sort(steps);
  const auto rest = std::ranges::unique(steps);
  steps.erase(rest.begin(), rest.end());
  return steps;
}

/// Groups the time stamps of rows into scans: each row gets the first stamp of its scan.
/// @return A remark; empty if every stamp is a scan.
std::string group_rows(std::vector<Measured>& measurements, std::optional<double> scan_window_s) {
  const std::vector<ScanKey> stamps = distinct_scans(measurements);
  const auto stamp_of = [&](const Measured& measured) {
    return static_cast<int>(std::ranges::lower_bound(stamps, measured.scan) - stamps.begin());
  };
  std::vector<Detection> seen;
  for (const Measured& measured : measurements)
    seen.push_back({.step = stamp_of(measured), .landmark = static_cast<int>(measured.landmark)});
  sort_detections(seen);
  const ScanGrouping grouping = group_stamps(stamps, seen, scan_window_s);
  for (Measured& measured : measurements) {
    const int scan = grouping.scan_of[static_cast<std::size_t>(stamp_of(measured))];
    measured.scan = grouping.scans[static_cast<std::size_t>(scan)];
  }
  return grouping_remark(grouping, stamps.size());
}

[[noreturn]] void refuse_repeat(const Measured& repeat, const std::vector<Measured>& measurements,
                                const ValueRows& rows, const std::string& source) {
  const auto first = std::ranges::find_if(measurements, [&](const Measured& measured) {
    return measured.landmark == repeat.landmark && measured.scan == repeat.scan;
  });
  const std::string& name = rows.names().names()[static_cast<std::size_t>(repeat.landmark)];
  throw IoError(source, fmt::format("line {}", repeat.line),
                fmt::format("landmark {} at {} is already on line {}", in_quotes(name),
                            rows.scans().words(repeat.scan.key), first->line));
}

/// @param others  The value where nothing is listed.
Eigen::MatrixXd arrange(const std::vector<Measured>& measurements, const ValueRows& rows,
                        double others, const std::string& source) {
  const std::vector<ScanKey> steps = distinct_scans(measurements);
  const std::size_t count = rows.names().names().size();
  check_size(source, "as a whole", count, steps.size());
  const auto landmarks = static_cast<Eigen::Index>(count);
  Eigen::MatrixXd values =
      Eigen::MatrixXd::Constant(landmarks, static_cast<Eigen::Index>(steps.size()), others);
  std::vector<bool> is_set(static_cast<std::size_t>(values.size()));
  std::size_t column = 0;
  for (const Measured& measured : measurements) {
    if (measured.landmark < 0) continue;
    if (steps[column] != measured.scan)
      column =
          static_cast<std::size_t>(std::ranges::lower_bound(steps, measured.scan) - steps.begin());
    auto is_repeated = is_set[column * count + static_cast<std::size_t>(measured.landmark)];
    if (is_repeated) refuse_repeat(measured, measurements, rows, source);
    is_repeated = true;
    values(measured.landmark, static_cast<Eigen::Index>(column)) = measured.value;
  }
  return values;
}

/// A step, a name that is not a number, and a value.
bool is_long_row(const TableRow& row) {
  if (row.cells.size() != 3) return false;
  const auto is_value = [](std::string_view cell) { return is_missing(cell) || number_in(cell); };
  return time_in(row.cells[0]) && !is_value(row.cells[1]) && is_value(row.cells[2]);
}

std::vector<UnassociatedMeasurement> unassociated_in(const std::vector<Measured>& measurements) {
  std::vector<UnassociatedMeasurement> unassociated;
  if (std::ranges::none_of(measurements,
                           [](const Measured& measured) { return measured.landmark < 0; }))
    return unassociated;
  const std::vector<ScanKey> scans = distinct_scans(measurements);
  for (const Measured& measured : measurements)
    if (measured.landmark < 0)
      unassociated.push_back(
          {.step = std::ranges::lower_bound(scans, measured.scan) - scans.begin(),
           .number = measured.scan.key,
           .value = measured.value,
           .line = measured.line});
  return unassociated;
}

}  // namespace

ObservationSource read_long(std::string_view text, const std::string& source, Sensor sensor,
                            const TableFormat& format) {
  TableReader reader(text, source);
  TableRow row;
  ValueRows rows(source, sensor, format);
  std::vector<Measured> measurements;
  for (bool is_first = true; reader.next(row); is_first = false) {
    if (is_first && rows.begin(row)) continue;
    measurements.push_back(rows.measured(row));
    if (static_cast<double>(measurements.size()) > kMostEntries)
      throw IoError(source, fmt::format("more than {:.0f} rows", kMostEntries));
  }
  if (measurements.empty()) throw IoError(source, "holds no observations");
  require_stamps(rows.scans(), format.scan_window_s);
  const std::string grouping =
      rows.scans().is_timed() ? group_rows(measurements, format.scan_window_s) : "";
  const bool lists_detections = sensor == Sensor::kVisibility &&
                                std::ranges::all_of(measurements, [](const Measured& measured) {
                                  return measured.value == 1.0;
                                });
  const double others = lists_detections ? 0.0 : kNaN;
  ObservationSource result{
      .history = ObservationHistory{.sensor = sensor,
                                    .names = rows.names().names(),
                                    .values = arrange(measurements, rows, others, source)},
      .ground_truth_m = std::nullopt,
      .remarks = rows.scans().remarks(),
      .locations = rows.names().locations(),
      .path = source,
      .unassociated = unassociated_in(measurements),
      .reading = rows.scans().reading()};
  result.reading.form = "long table";
  result.reading.separator = reader.separator();
  result.reading.has_decimal_commas = reader.has_decimal_commas();
  if (!grouping.empty()) result.remarks.push_back(grouping);
  if (lists_detections)
    result.remarks.push_back(
        "Only detections are listed: all other landmarks are taken as not seen");
  return result;
}

bool has_long_header(std::string_view text, const std::string& source, const ColumnNames& names) {
  TableReader reader(text, source);
  TableRow row;
  if (!reader.next(row)) return false;
  return names_value_columns(row, names) || is_stacked_header(row);
}

bool starts_as_long(std::string_view text, const std::string& source) {
  TableReader reader(text, source);
  TableRow row;
  return reader.next(row) && is_long_row(row);
}

bool is_grid_table(ByteSource& source, const TableFormat& format) {
  respell(source);
  if (format.layout == Layout::kLong || is_json(source)) return false;
  if (format.layout != Layout::kAuto) return true;
  return !is_detections(source, format) && !first_row_is(source, [&](const TableRow& row) {
    return names_value_columns(row, format.columns) || is_stacked_header(row) || is_long_row(row);
  });
}

ObservationSource read_observations(ByteSource& source, std::optional<Sensor> kind,
                                    const TableFormat& format) {
  respell(source);
  const std::string& name = source.name();
  if (format.layout == Layout::kAuto && is_detections(source, format)) {
    if (!kind)
      throw IoError(
          name,
          "holds detections: --sensor range-bearing, range, bearing or visibility states which");
    return observations_of(read_detections(source, format), *kind);
  }
  if (is_json(source)) {
    const std::string bytes = source.rest();
    const std::string_view text = checked_text(bytes, name);
    if (format.scan_window_s) refuse_window(name);
    require_columns({}, format.columns, name);
    return parse_observations(text, name, kind);
  }
  if (!kind)
    throw IoError(
        name,
        "does not state what its values are: --sensor bearing (radians, counter-clockwise "
        "from the heading; --degrees for degrees), range (metres) or visibility (0 or 1)");
  if (is_grid_table(source, format)) {
    if (format.scan_window_s) refuse_window(name);
    return unpacked(read_grid(source, *kind, format));
  }
  const std::string bytes = source.rest();
  const std::string_view text = checked_text(bytes, name);
  ObservationSource result = read_long(text, name, *kind, format);
  result.reading.packing = source.form();
  if (!source.original().empty()) result.reading.separator = '\0';
  if (is_cut_table(text)) result.remarks.emplace_back(kCutRemark);
  if (*kind == Sensor::kRange) remark_on_angles(result.history, result.remarks);
  return result;
}

ObservationSource read_observations(const std::filesystem::path& path, std::optional<Sensor> kind,
                                    const TableFormat& format) {
  if (is_folder(path))
    return read_mrclam(path, kind.value_or(Sensor::kVisibility), format.scan_window_s);
  ByteSource source(path);
  return read_observations(source, kind, format);
}

}  // namespace mapproof
