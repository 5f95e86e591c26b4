#include "core/records/detections/scan_rows.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"
#include "core/records/tables/cells.hpp"

namespace mapproof {
namespace {

struct Word {
  std::string_view word;
  DetectionColumn column;
};

constexpr Word kWords[] = {
    {"step", DetectionColumn::kStep},
    {"scan", DetectionColumn::kStep},
    {"frame", DetectionColumn::kStep},
    {"time", DetectionColumn::kTime},
    {"timestamp", DetectionColumn::kTime},
    {"stamp", DetectionColumn::kTime},
    {"t", DetectionColumn::kTime},
    {"robot", DetectionColumn::kRobot},
    {"landmark", DetectionColumn::kLandmark},
    {"name", DetectionColumn::kLandmark},
    {"object", DetectionColumn::kLandmark},
    {"id", DetectionColumn::kLandmark},
    {"tag", DetectionColumn::kLandmark},
    {"marker", DetectionColumn::kLandmark},
    {"subject", DetectionColumn::kLandmark},
    {"beacon", DetectionColumn::kLandmark},
    {"range", DetectionColumn::kRange},
    {"distance", DetectionColumn::kRange},
    {"r", DetectionColumn::kRange},
    {"bearing", DetectionColumn::kBearing},
    {"angle", DetectionColumn::kBearing},
    {"theta", DetectionColumn::kBearing},
    {"value", DetectionColumn::kValue},
};

struct Unit {
  std::string_view word;
  DetectionColumn column;
  std::optional<AngleUnit> angle;
};

const Unit kUnits[] = {
    {"s", DetectionColumn::kTime, {}},
    {"sec", DetectionColumn::kTime, {}},
    {"seconds", DetectionColumn::kTime, {}},
    {"m", DetectionColumn::kRange, {}},
    {"metres", DetectionColumn::kRange, {}},
    {"meters", DetectionColumn::kRange, {}},
    {"rad", DetectionColumn::kBearing, AngleUnit::kRadians},
    {"radians", DetectionColumn::kBearing, AngleUnit::kRadians},
    {"deg", DetectionColumn::kBearing, AngleUnit::kDegrees},
    {"degrees", DetectionColumn::kBearing, AngleUnit::kDegrees},
    {"°", DetectionColumn::kBearing, AngleUnit::kDegrees},
};

/// "Range [m]" and "range_m" as "range" and "m".
struct Heading {
  std::string word;
  std::string unit;
};

Heading heading_of(std::string_view cell) {
  std::string text = lower_case(trimmed(cell));
  const std::size_t open = text.find_first_of("[(_ ");
  if (open == std::string::npos) return {text, {}};
  std::string unit = text.substr(open);
  std::erase_if(
      unit, [](char c) { return std::string_view("[](){}_ ").find(c) != std::string_view::npos; });
  return {text.substr(0, open), unit};
}

const Word* word_of(const Heading& heading) {
  const Word* word = std::ranges::find(kWords, heading.word, &Word::word);
  return word == std::end(kWords) ? nullptr : word;
}

bool names(const TableRow& row, DetectionColumn column) {
  return std::ranges::any_of(row.cells, [&](std::string_view cell) {
    const Word* word = word_of(heading_of(cell));
    return word != nullptr && word->column == column;
  });
}

const char* label(DetectionColumn column) {
  constexpr std::array kLabels = {"step", "time", "robot", "landmark", "range", "bearing", "value"};
  return kLabels[static_cast<std::size_t>(column)];
}

/// Takes a column in, with its unit. False: its unit is none of such a column's.
bool take(DetectionColumns& columns, DetectionColumn column, const Heading& heading,
          std::size_t cell) {
  if (!heading.unit.empty()) {
    const auto unit = std::ranges::find_if(kUnits, [&](const Unit& known) {
      return known.column == column && known.word == heading.unit;
    });
    if (unit == std::end(kUnits)) return false;
    if (unit->angle) columns.unit = unit->angle;
  }
  columns.cell[static_cast<std::size_t>(column)] = cell;
  return true;
}

}  // namespace

bool names_detection_columns(const TableRow& row) {
  return names(row, DetectionColumn::kLandmark) &&
         (names(row, DetectionColumn::kRange) || names(row, DetectionColumn::kBearing));
}

bool names_value_columns(const TableRow& row) {
  return names(row, DetectionColumn::kLandmark) && names(row, DetectionColumn::kValue);
}

bool is_long_header(const TableRow& row) {
  return std::ranges::any_of(row.cells,
                             [](auto cell) { return word_of(heading_of(cell)) != nullptr; }) &&
         std::ranges::none_of(row.cells, [](auto cell) { return number_in(cell).has_value(); });
}

DetectionColumns detection_columns(const TableRow& header, const std::string& source) {
  const std::string location = fmt::format("line {}", header.line);
  DetectionColumns columns;
  columns.width = header.cells.size();
  for (std::size_t i = 0; i < header.cells.size(); ++i) {
    const Heading heading = heading_of(header.cells[i]);
    const Word* word = word_of(heading);
    if (word == nullptr) {
      columns.unread.push_back(in_quotes(header.cells[i]));
      continue;
    }
    if (columns[word->column])
      throw IoError(source, location, fmt::format("two columns hold a {}", label(word->column)));
    if (!take(columns, word->column, heading, i))
      throw IoError(source, location,
                    fmt::format("{}: a {} in that unit is not known; metres, seconds, rad or deg",
                                in_quotes(header.cells[i]), label(word->column)));
  }
  if (!columns[DetectionColumn::kLandmark])
    throw IoError(source, location, "no column is named landmark");
  if (!columns[DetectionColumn::kStep] && !columns[DetectionColumn::kTime])
    throw IoError(source, location, "no column is named step or time: which rows are one scan?");
  if (!columns[DetectionColumn::kRange] && !columns[DetectionColumn::kBearing] &&
      !columns[DetectionColumn::kValue])
    throw IoError(source, location, "no column is named range or bearing");
  return columns;
}

DetectionColumns usual_detection_columns(const TableRow& first, const std::string& source) {
  if (first.cells.size() != 4)
    throw IoError(source, fmt::format("line {}", first.line),
                  fmt::format("has {} cells; a table of detections has a header, or the columns "
                              "step, landmark, range, bearing",
                              first.cells.size()));
  DetectionColumns columns;
  columns.width = 4;
  std::size_t cell = 0;
  for (const DetectionColumn column : {DetectionColumn::kStep, DetectionColumn::kLandmark,
                                       DetectionColumn::kRange, DetectionColumn::kBearing})
    columns.cell[static_cast<std::size_t>(column)] = cell++;
  return columns;
}

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
