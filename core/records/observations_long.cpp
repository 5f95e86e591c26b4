#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/name_list.hpp"
#include "core/records/observation_values.hpp"
#include "core/records/sighting_values.hpp"
#include "core/records/table_reader.hpp"

namespace mapproof {
namespace {

/// Which cell of a row holds what.
struct Columns {
  std::size_t step = 0;
  std::size_t landmark = 1;
  std::size_t value = 2;
};

struct Entry {
  Eigen::Index landmark;
  double step;
  std::size_t line;
  double value;
};

constexpr std::array<std::string_view, 3> kWords = {"step", "landmark", "value"};

bool names_columns(const TableRow& row) {
  return std::ranges::any_of(row.cells, [](std::string_view cell) {
    return std::ranges::find(kWords, lower_case(cell)) != kWords.end();
  });
}

Columns columns_of(const TableRow& header, const std::string& source) {
  const std::string place = fmt::format("line {}", header.line);
  std::array<std::size_t, 3> found;
  found.fill(header.cells.size());
  for (std::size_t i = 0; i < header.cells.size(); ++i) {
    const auto word = std::ranges::find(kWords, lower_case(header.cells[i]));
    if (word == kWords.end())
      throw IoError(
          source, place,
          fmt::format(
              "expected the columns step, landmark, value; got {}{}", in_quotes(header.cells[i]),
              lower_case(header.cells[i]) == "time" ? ": number the looks 0, 1, 2, ..." : ""));
    std::size_t& column = found[static_cast<std::size_t>(word - kWords.begin())];
    if (column != header.cells.size())
      throw IoError(source, place, fmt::format("two columns are named {}", *word));
    column = i;
  }
  for (std::size_t i = 0; i < kWords.size(); ++i)
    if (found[i] == header.cells.size())
      throw IoError(source, place, fmt::format("no column is named {}", kWords[i]));
  return {.step = found[0], .landmark = found[1], .value = found[2]};
}

double read_step(std::string_view cell, const std::string& source, const std::string& place) {
  const std::optional<double> step = number_in(cell);
  if (!step) throw IoError(source, place, "step: " + number_problem(cell));
  if (!(*step >= 0.0 && *step <= 0x1p53))
    throw IoError(source, place, "a step is an integer from 0, got " + in_quotes(cell));
  if (*step != std::trunc(*step))
    throw IoError(source, place,
                  "a step is an integer, " + in_quotes(cell) +
                      " looks like a time: number the looks 0, 1, 2, ...");
  return *step;
}

Entry read_entry(const TableRow& row, const Columns& columns, Sensor sensor, AngleUnit unit,
                 const std::string& source, NameList& names) {
  const auto place = [&] { return fmt::format("line {}", row.line); };
  if (row.cells.size() != kWords.size())
    throw IoError(source, place(),
                  fmt::format("has {} cells, expected step, landmark, value", row.cells.size()));
  const std::optional<double> step = number_in(row.cells[columns.step]);
  const bool is_step = step && *step >= 0.0 && *step <= 0x1p53 && *step == std::trunc(*step);
  const std::optional<double> value = sighting_value(row.cells[columns.value], sensor, unit);
  if (!value)
    throw IoError(source, place(), sighting_problem(row.cells[columns.value], sensor, unit));
  return {.landmark = names.find_or_add(row.cells[columns.landmark], row.line),
          .step = is_step ? *step : read_step(row.cells[columns.step], source, place()),
          .line = row.line,
          .value = *value};
}

/// Ascending. Rows mostly come step by step, so that little is left to sort.
std::vector<double> distinct_steps(const std::vector<Entry>& entries) {
  std::vector<double> steps;
  for (const Entry& entry : entries)
    if (steps.empty() || steps.back() != entry.step) steps.push_back(entry.step);
  std::ranges::sort(steps);
  const auto rest = std::ranges::unique(steps);
  steps.erase(rest.begin(), rest.end());
  return steps;
}

[[noreturn]] void refuse_repeat(const Entry& repeat, const std::vector<Entry>& entries,
                                const NameList& names, const std::string& source) {
  const auto first = std::ranges::find_if(entries, [&](const Entry& entry) {
    return entry.landmark == repeat.landmark && entry.step == repeat.step;
  });
  throw IoError(source, fmt::format("line {}", repeat.line),
                fmt::format("landmark {} at step {:.0f} is already on line {}",
                            in_quotes(names.names()[static_cast<std::size_t>(repeat.landmark)]),
                            repeat.step, first->line));
}

/// @param others  What stands where nothing is listed.
Eigen::MatrixXd arrange(const std::vector<Entry>& entries, const NameList& names, double others,
                        const std::string& source) {
  const std::vector<double> steps = distinct_steps(entries);
  check_size(source, "as a whole", names.names().size(), steps.size());
  const auto landmarks = static_cast<Eigen::Index>(names.names().size());
  Eigen::MatrixXd values =
      Eigen::MatrixXd::Constant(landmarks, static_cast<Eigen::Index>(steps.size()), others);
  std::vector<bool> is_set(static_cast<std::size_t>(values.size()));
  std::size_t column = 0;
  for (const Entry& entry : entries) {
    if (steps[column] != entry.step)
      column =
          static_cast<std::size_t>(std::ranges::lower_bound(steps, entry.step) - steps.begin());
    auto is_repeated =
        is_set[column * names.names().size() + static_cast<std::size_t>(entry.landmark)];
    if (is_repeated) refuse_repeat(entry, entries, names, source);
    is_repeated = true;
    values(entry.landmark, static_cast<Eigen::Index>(column)) = entry.value;
  }
  return values;
}

}  // namespace

bool has_long_header(std::string_view text, const std::string& source) {
  TableReader reader(text, source);
  TableRow row;
  if (!reader.next(row)) return false;
  const auto has = [&](std::string_view word) {
    return std::ranges::any_of(row.cells,
                               [&](std::string_view cell) { return lower_case(cell) == word; });
  };
  return has("landmark") && has("value");
}

bool starts_as_long(std::string_view text, const std::string& source) {
  TableReader reader(text, source);
  TableRow row;
  if (!reader.next(row) || row.cells.size() != kWords.size()) return false;
  const auto is_value = [](std::string_view cell) { return is_missing(cell) || number_in(cell); };
  return number_in(row.cells[0]) && !is_value(row.cells[1]) && is_value(row.cells[2]);
}

ObservationSource read_long(std::string_view text, const std::string& source, Sensor sensor,
                            AngleUnit unit) {
  TableReader reader(text, source);
  TableRow row;
  NameList names(source);
  std::vector<Entry> entries;
  Columns columns;
  for (bool is_first = true; reader.next(row); is_first = false) {
    if (is_first && names_columns(row)) {
      columns = columns_of(row, source);
      continue;
    }
    entries.push_back(read_entry(row, columns, sensor, unit, source, names));
    if (static_cast<double>(entries.size()) > kMostEntries)
      throw IoError(source, fmt::format("more than {:.0f} rows", kMostEntries));
  }
  if (entries.empty()) throw IoError(source, "holds no observations");
  const bool lists_sightings =
      sensor == Sensor::kVisibility &&
      std::ranges::all_of(entries, [](const Entry& entry) { return entry.value == 1.0; });
  const double others = lists_sightings ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  ObservationSource result{.history = {.sensor = sensor,
                                       .names = names.names(),
                                       .values = arrange(entries, names, others, source)},
                           .truth_m = std::nullopt,
                           .remarks = {},
                           .places = names.places(),
                           .path = source};
  if (lists_sightings)
    result.remarks.push_back("Only sightings are listed: all other entries are taken as not seen");
  return result;
}

}  // namespace mapproof
