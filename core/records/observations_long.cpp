#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/name_list.hpp"
#include "core/records/observation_values.hpp"
#include "core/records/sighting_columns.hpp"
#include "core/records/sighting_values.hpp"
#include "core/records/table_reader.hpp"

namespace mapproof {
namespace {

/// One look: what one robot saw at one step or time.
struct Look {
  Eigen::Index robot = 0;
  double key = 0.0;
  auto operator<=>(const Look&) const = default;
};

struct Entry {
  Eigen::Index landmark;  ///< -1: without a label.
  Look look;
  std::size_t line;
  double value;
};

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

SightingColumn key_column(const SightingColumns& columns) {
  return columns[SightingColumn::kStep] ? SightingColumn::kStep : SightingColumn::kTime;
}

/// Reads the rows of a table, whose looks are told as those of sightings are.
class LongValues {
 public:
  LongValues(const std::string& source, Sensor sensor, AngleUnit unit)
      : source_(source), sensor_(sensor), unit_(unit), names_(source), robots_(source) {}

  void read_header(const TableRow& row) {
    columns_ = sighting_columns(row, source_);
    if (!columns_[SightingColumn::kValue]) fail(row.line, "no column is named value");
  }

  Entry entry(const TableRow& row) {
    if (row.cells.size() != columns_.width)
      fail(row.line, fmt::format("has {} cells, expected {}", row.cells.size(), columns_.width));
    const std::string_view cell = row.cells[*columns_[SightingColumn::kValue]];
    const std::optional<double> value = sighting_value(cell, sensor_, unit_);
    if (!value) fail(row.line, sighting_problem(cell, sensor_, unit_));
    const std::string_view name = row.cells[*columns_[SightingColumn::kLandmark]];
    return {.landmark = name == kUnlabelledMark ? -1 : names_.find_or_add(name, row.line),
            .look = look_of(row),
            .line = row.line,
            .value = *value};
  }

  const NameList& names() const { return names_; }

  /// How a look is named in an error.
  std::string words(const Look& look) const {
    return fmt::format("{} {:.15g}",
                       key_column(columns_) == SightingColumn::kStep ? "step" : "time", look.key);
  }

  std::vector<std::string> remarks() const {
    if (columns_.unread.empty()) return {};
    return {fmt::format("Columns that are not read: {}", fmt::join(columns_.unread, ", "))};
  }

 private:
  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw IoError(source_, fmt::format("line {}", line), what);
  }

  Look look_of(const TableRow& row) {
    Look look;
    if (const auto cell = columns_[SightingColumn::kRobot])
      look.robot = robots_.find_or_add(row.cells[*cell], row.line);
    const std::string_view cell = row.cells[*columns_[key_column(columns_)]];
    const std::optional<double> key = number_in(cell);
    if (!key || !std::isfinite(*key))
      fail(row.line,
           fmt::format("{}: {}", key_column(columns_) == SightingColumn::kStep ? "step" : "time",
                       number_problem(cell)));
    look.key = *key;
    return look;
  }

  const std::string& source_;
  Sensor sensor_;
  AngleUnit unit_;
  SightingColumns columns_ = usual_columns();
  NameList names_;
  NameList robots_;
};

/// Ascending. Rows mostly come step by step, so that little is left to sort.
std::vector<Look> distinct_looks(const std::vector<Entry>& entries) {
  std::vector<Look> steps;
  for (const Entry& entry : entries)
    if (steps.empty() || steps.back() != entry.look) steps.push_back(entry.look);
  std::ranges::sort(steps);
  const auto rest = std::ranges::unique(steps);
  steps.erase(rest.begin(), rest.end());
  return steps;
}

[[noreturn]] void refuse_repeat(const Entry& repeat, const std::vector<Entry>& entries,
                                const LongValues& reader, const std::string& source) {
  const auto first = std::ranges::find_if(entries, [&](const Entry& entry) {
    return entry.landmark == repeat.landmark && entry.look == repeat.look;
  });
  const std::string& name = reader.names().names()[static_cast<std::size_t>(repeat.landmark)];
  throw IoError(source, fmt::format("line {}", repeat.line),
                fmt::format("landmark {} at {} is already on line {}", in_quotes(name),
                            reader.words(repeat.look), first->line));
}

/// @param others  What stands where nothing is listed.
Eigen::MatrixXd arrange(const std::vector<Entry>& entries, const LongValues& reader, double others,
                        const std::string& source) {
  const std::vector<Look> steps = distinct_looks(entries);
  const std::size_t count = reader.names().names().size();
  check_size(source, "as a whole", count, steps.size());
  const auto landmarks = static_cast<Eigen::Index>(count);
  Eigen::MatrixXd values =
      Eigen::MatrixXd::Constant(landmarks, static_cast<Eigen::Index>(steps.size()), others);
  std::vector<bool> is_set(static_cast<std::size_t>(values.size()));
  std::size_t column = 0;
  for (const Entry& entry : entries) {
    if (entry.landmark < 0) continue;
    if (steps[column] != entry.look)
      column =
          static_cast<std::size_t>(std::ranges::lower_bound(steps, entry.look) - steps.begin());
    auto is_repeated = is_set[column * count + static_cast<std::size_t>(entry.landmark)];
    if (is_repeated) refuse_repeat(entry, entries, reader, source);
    is_repeated = true;
    values(entry.landmark, static_cast<Eigen::Index>(column)) = entry.value;
  }
  return values;
}

std::vector<UnlabelledReading> unlabelled_in(const std::vector<Entry>& entries) {
  std::vector<UnlabelledReading> readings;
  if (std::ranges::none_of(entries, [](const Entry& entry) { return entry.landmark < 0; }))
    return readings;
  const std::vector<Look> looks = distinct_looks(entries);
  for (const Entry& entry : entries)
    if (entry.landmark < 0)
      readings.push_back({.step = std::ranges::lower_bound(looks, entry.look) - looks.begin(),
                          .number = entry.look.key,
                          .value = entry.value,
                          .line = entry.line});
  return readings;
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
  LongValues values(source, sensor, unit);
  std::vector<Entry> entries;
  for (bool is_first = true; reader.next(row); is_first = false) {
    if (is_first && is_long_header(row)) {
      values.read_header(row);
      continue;
    }
    entries.push_back(values.entry(row));
    if (static_cast<double>(entries.size()) > kMostEntries)
      throw IoError(source, fmt::format("more than {:.0f} rows", kMostEntries));
  }
  if (entries.empty()) throw IoError(source, "holds no observations");
  const bool lists_sightings =
      sensor == Sensor::kVisibility &&
      std::ranges::all_of(entries, [](const Entry& entry) { return entry.value == 1.0; });
  const double others = lists_sightings ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  ObservationSource result{.history = {.sensor = sensor,
                                       .names = values.names().names(),
                                       .values = arrange(entries, values, others, source)},
                           .truth_m = std::nullopt,
                           .remarks = values.remarks(),
                           .places = values.names().places(),
                           .path = source,
                           .unlabelled = unlabelled_in(entries)};
  if (lists_sightings)
    result.remarks.push_back("Only sightings are listed: all other entries are taken as not seen");
  return result;
}

}  // namespace mapproof
