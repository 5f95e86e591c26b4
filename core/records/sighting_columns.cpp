#include "core/records/sighting_columns.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

struct Word {
  std::string_view word;
  SightingColumn column;
};

constexpr Word kWords[] = {
    {"step", SightingColumn::kStep},       {"look", SightingColumn::kStep},
    {"frame", SightingColumn::kStep},      {"scan", SightingColumn::kStep},
    {"time", SightingColumn::kTime},       {"timestamp", SightingColumn::kTime},
    {"stamp", SightingColumn::kTime},      {"t", SightingColumn::kTime},
    {"robot", SightingColumn::kRobot},     {"landmark", SightingColumn::kLandmark},
    {"name", SightingColumn::kLandmark},   {"object", SightingColumn::kLandmark},
    {"id", SightingColumn::kLandmark},     {"tag", SightingColumn::kLandmark},
    {"marker", SightingColumn::kLandmark}, {"subject", SightingColumn::kLandmark},
    {"beacon", SightingColumn::kLandmark}, {"range", SightingColumn::kRange},
    {"distance", SightingColumn::kRange},  {"r", SightingColumn::kRange},
    {"bearing", SightingColumn::kBearing}, {"angle", SightingColumn::kBearing},
    {"theta", SightingColumn::kBearing},   {"value", SightingColumn::kValue},
};

struct Unit {
  std::string_view word;
  SightingColumn column;
  std::optional<AngleUnit> angle;
};

const Unit kUnits[] = {
    {"s", SightingColumn::kTime, {}},
    {"sec", SightingColumn::kTime, {}},
    {"seconds", SightingColumn::kTime, {}},
    {"m", SightingColumn::kRange, {}},
    {"metres", SightingColumn::kRange, {}},
    {"meters", SightingColumn::kRange, {}},
    {"rad", SightingColumn::kBearing, AngleUnit::kRadians},
    {"radians", SightingColumn::kBearing, AngleUnit::kRadians},
    {"deg", SightingColumn::kBearing, AngleUnit::kDegrees},
    {"degrees", SightingColumn::kBearing, AngleUnit::kDegrees},
    {"°", SightingColumn::kBearing, AngleUnit::kDegrees},
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

bool names(const TableRow& row, SightingColumn column) {
  return std::ranges::any_of(row.cells, [&](std::string_view cell) {
    const Word* word = word_of(heading_of(cell));
    return word != nullptr && word->column == column;
  });
}

const char* label(SightingColumn column) {
  constexpr std::array kLabels = {"step", "time", "robot", "landmark", "range", "bearing", "value"};
  return kLabels[static_cast<std::size_t>(column)];
}

/// Takes a column in, with its unit. False: its unit is none of such a column's.
bool take(SightingColumns& columns, SightingColumn column, const Heading& heading,
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

bool names_sighting_columns(const TableRow& row) {
  return names(row, SightingColumn::kLandmark) &&
         (names(row, SightingColumn::kRange) || names(row, SightingColumn::kBearing));
}

bool names_value_columns(const TableRow& row) {
  return names(row, SightingColumn::kLandmark) && names(row, SightingColumn::kValue);
}

bool is_long_header(const TableRow& row) {
  return std::ranges::any_of(row.cells,
                             [](auto cell) { return word_of(heading_of(cell)) != nullptr; }) &&
         std::ranges::none_of(row.cells, [](auto cell) { return number_in(cell).has_value(); });
}

SightingColumns sighting_columns(const TableRow& header, const std::string& source) {
  const std::string place = fmt::format("line {}", header.line);
  SightingColumns columns;
  columns.width = header.cells.size();
  for (std::size_t i = 0; i < header.cells.size(); ++i) {
    const Heading heading = heading_of(header.cells[i]);
    const Word* word = word_of(heading);
    if (word == nullptr) {
      columns.unread.push_back(in_quotes(header.cells[i]));
      continue;
    }
    if (columns[word->column])
      throw IoError(source, place, fmt::format("two columns hold a {}", label(word->column)));
    if (!take(columns, word->column, heading, i))
      throw IoError(source, place,
                    fmt::format("{}: a {} in that unit is not known; metres, seconds, rad or deg",
                                in_quotes(header.cells[i]), label(word->column)));
  }
  if (!columns[SightingColumn::kLandmark])
    throw IoError(source, place, "no column is named landmark");
  if (!columns[SightingColumn::kStep] && !columns[SightingColumn::kTime])
    throw IoError(source, place, "no column is named step or time: which rows are one look?");
  if (!columns[SightingColumn::kRange] && !columns[SightingColumn::kBearing] &&
      !columns[SightingColumn::kValue])
    throw IoError(source, place, "no column is named range or bearing");
  return columns;
}

SightingColumns usual_sighting_columns(const TableRow& first, const std::string& source) {
  if (first.cells.size() != 4)
    throw IoError(source, fmt::format("line {}", first.line),
                  fmt::format("has {} cells; a table of sightings has a header, or the columns "
                              "step, landmark, range, bearing",
                              first.cells.size()));
  SightingColumns columns;
  columns.width = 4;
  std::size_t cell = 0;
  for (const SightingColumn column : {SightingColumn::kStep, SightingColumn::kLandmark,
                                      SightingColumn::kRange, SightingColumn::kBearing})
    columns.cell[static_cast<std::size_t>(column)] = cell++;
  return columns;
}

}  // namespace mapproof
