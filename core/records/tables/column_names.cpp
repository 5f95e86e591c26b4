#include "core/records/tables/column_names.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/text/ascii.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

struct Word {
  std::string_view word;
  ColumnRole role;
};

/// Words of headers without blanks, dots and underscores.
constexpr Word kWords[] = {
    {"step", ColumnRole::kStep},
    {"scan", ColumnRole::kStep},
    {"frame", ColumnRole::kStep},
    {"seq", ColumnRole::kStep},
    {"timestep", ColumnRole::kStep},
    {"time", ColumnRole::kTime},
    {"timestamp", ColumnRole::kTime},
    {"stamp", ColumnRole::kTime},
    {"t", ColumnRole::kTime},
    {"datetime", ColumnRole::kTime},
    {"date", ColumnRole::kTime},
    {"%time", ColumnRole::kTime},
    {"zeit", ColumnRole::kTime},
    {"zeitstempel", ColumnRole::kTime},
    {"temps", ColumnRole::kTime},
    {"horodatage", ColumnRole::kTime},
    {"heure", ColumnRole::kTime},
    {"tiempo", ColumnRole::kTime},
    {"fecha", ColumnRole::kTime},
    {"hora", ColumnRole::kTime},
    {"sec", ColumnRole::kTime},
    {"stampsec", ColumnRole::kTime},
    {"stampsecs", ColumnRole::kTime},
    {"headerstamp", ColumnRole::kTime},
    {"headerstampsec", ColumnRole::kTime},
    {"headerstampsecs", ColumnRole::kTime},
    {"nanosec", ColumnRole::kNanoseconds},
    {"nsec", ColumnRole::kNanoseconds},
    {"stampnanosec", ColumnRole::kNanoseconds},
    {"stampnsecs", ColumnRole::kNanoseconds},
    {"headerstampnanosec", ColumnRole::kNanoseconds},
    {"headerstampnsecs", ColumnRole::kNanoseconds},
    {"robot", ColumnRole::kRobot},
    {"landmark", ColumnRole::kLandmark},
    {"name", ColumnRole::kLandmark},
    {"object", ColumnRole::kLandmark},
    {"id", ColumnRole::kLandmark},
    {"tag", ColumnRole::kLandmark},
    {"marker", ColumnRole::kLandmark},
    {"subject", ColumnRole::kLandmark},
    {"beacon", ColumnRole::kLandmark},
    {"bake", ColumnRole::kLandmark},
    {"objekt", ColumnRole::kLandmark},
    {"landmarke", ColumnRole::kLandmark},
    {"anchor", ColumnRole::kLandmark},
    {"anker", ColumnRole::kLandmark},
    {"fiducial", ColumnRole::kLandmark},
    {"apriltag", ColumnRole::kLandmark},
    {"node", ColumnRole::kLandmark},
    {"variable", ColumnRole::kLandmark},  // As pandas melts a table of landmarks and times.
    {"balise", ColumnRole::kLandmark},
    {"ancre", ColumnRole::kLandmark},
    {"amer", ColumnRole::kLandmark},
    {"repère", ColumnRole::kLandmark},
    {"étiquette", ColumnRole::kLandmark},
    {"Étiquette", ColumnRole::kLandmark},  // Capitals beyond ASCII stay as they are.
    {"objet", ColumnRole::kLandmark},
    {"nom", ColumnRole::kLandmark},
    {"baliza", ColumnRole::kLandmark},
    {"objeto", ColumnRole::kLandmark},
    {"tree", ColumnRole::kLandmark},
    {"baum", ColumnRole::kLandmark},
    {"range", ColumnRole::kRange},
    {"distance", ColumnRole::kRange},
    {"dist", ColumnRole::kRange},
    {"r", ColumnRole::kRange},
    {"entfernung", ColumnRole::kRange},
    {"abstand", ColumnRole::kRange},
    {"distanz", ColumnRole::kRange},
    {"distancia", ColumnRole::kRange},
    {"bearing", ColumnRole::kBearing},
    {"angle", ColumnRole::kBearing},
    {"theta", ColumnRole::kBearing},
    {"azimuth", ColumnRole::kBearing},
    {"peilung", ColumnRole::kBearing},
    {"winkel", ColumnRole::kBearing},
    {"gisement", ColumnRole::kBearing},
    {"azimut", ColumnRole::kBearing},
    {"ángulo", ColumnRole::kBearing},
    {"Ángulo", ColumnRole::kBearing},
    {"value", ColumnRole::kValue},
    {"x", ColumnRole::kX},
    {"y", ColumnRole::kY},
    {"tvecz", ColumnRole::kX},  // OpenCV's camera looks along z, and x is to the right.
    {"tvec2", ColumnRole::kX},
    {"tvecx", ColumnRole::kRight},
    {"tvec0", ColumnRole::kRight},
};

/// What may follow a landmark's or a step's word: "tag_id", "Frame No".
constexpr std::string_view kSuffixes[] = {"id", "name", "nr", "no", "number", "index", "label"};

/// The kind of a unit.
enum class Kind { kTime, kLength, kAngle };

struct Unit {
  std::string_view word;
  Kind kind;
  double factor = 1.0;
  AngleUnit angle = AngleUnit::kRadians;
};

constexpr Unit kUnits[] = {
    {"s", Kind::kTime},
    {"sec", Kind::kTime},
    {"seconds", Kind::kTime},
    {"ms", Kind::kTime, 1e-3},
    {"us", Kind::kTime, 1e-6},
    {"µs", Kind::kTime, 1e-6},
    {"ns", Kind::kTime, 1e-9},
    {"min", Kind::kTime, 60.0},
    {"h", Kind::kTime, 3600.0},
    {"d", Kind::kTime, 86400.0},
    {"days", Kind::kTime, 86400.0},
    {"m", Kind::kLength},
    {"metres", Kind::kLength},
    {"meters", Kind::kLength},
    {"cm", Kind::kLength, 1e-2},
    {"mm", Kind::kLength, 1e-3},
    {"km", Kind::kLength, 1e3},
    {"ft", Kind::kLength, 0.3048},
    {"feet", Kind::kLength, 0.3048},
    {"pieds", Kind::kLength, 0.3048},
    {"inch", Kind::kLength, 0.0254},
    {"inches", Kind::kLength, 0.0254},
    {"rad", Kind::kAngle},
    {"radians", Kind::kAngle},
    {"deg", Kind::kAngle, 1.0, AngleUnit::kDegrees},
    {"degrees", Kind::kAngle, 1.0, AngleUnit::kDegrees},
    {"grad", Kind::kAngle, 1.0, AngleUnit::kDegrees},
    {"°", Kind::kAngle, 1.0, AngleUnit::kDegrees},
};

std::optional<Kind> unit_kind(ColumnRole role) {
  switch (role) {
    case ColumnRole::kTime:
      return Kind::kTime;
    case ColumnRole::kRange:
    case ColumnRole::kX:
    case ColumnRole::kY:
    case ColumnRole::kRight:
    case ColumnRole::kDistance:
    case ColumnRole::kSideways:
      return Kind::kLength;
    case ColumnRole::kBearing:
    case ColumnRole::kHeading:
    case ColumnRole::kHeadingChange:
      return Kind::kAngle;
    default:
      return std::nullopt;
  }
}

/// Without the characters that words of a header are joined by.
std::string joined(std::string_view text) {
  std::string word;
  for (const char c : text)
    if (std::string_view(" ._-/[](){}").find(c) == std::string_view::npos) word += c;
  return word;
}

constexpr std::string_view kBeforeUnit = "[({_ .";  ///< What may separate a word from its unit.

std::optional<ColumnRole> role_of(std::string_view word) {
  const Word* found = std::ranges::find(kWords, word, &Word::word);
  if (found != std::end(kWords)) return found->role;
  for (const std::string_view suffix : kSuffixes) {
    if (!word.ends_with(suffix) || word.size() == suffix.size()) continue;
    const std::optional<ColumnRole> role = role_of(word.substr(0, word.size() - suffix.size()));
    if (role == ColumnRole::kLandmark ||
        (role == ColumnRole::kStep && suffix != "id" && suffix != "name") ||
        role == ColumnRole::kRobot)
      return role;
  }
  return std::nullopt;
}

/// Takes a unit in. False: it is none of such a column.
bool take_unit(std::string_view unit, ColumnHeading& heading) {
  const std::optional<Kind> kind = unit_kind(*heading.role);
  const auto known = std::ranges::find_if(
      kUnits, [&](const Unit& one) { return one.word == unit && one.kind == kind; });
  if (known == std::end(kUnits)) return false;
  heading.factor = known->factor;
  if (known->kind == Kind::kAngle) heading.unit = known->angle;
  return true;
}

/// "Range [cm]" as "range" and "cm"; "range_cm" and "Range cm" too.
ColumnHeading understood(std::string_view cell) {
  // A row may have a million numbers, none of which is a word.
  const std::size_t first = cell.find_first_not_of(" -+.");
  if (first != std::string_view::npos && cell[first] >= '0' && cell[first] <= '9')
    return {.role = std::nullopt};
  std::string text = lower_case(trimmed(cell));
  // rostopic calls the members of a message "field.range".
  if (constexpr std::string_view kField = "field."; text.starts_with(kField))
    text.erase(0, kField.size());
  ColumnHeading heading{.role = role_of(joined(text))};
  if (heading.role) return heading;
  const std::size_t open = text.find_first_of("[({");
  const std::size_t end = open != std::string::npos ? open : text.find_last_of("_ .");
  if (end == std::string::npos) return heading;
  heading.role = role_of(joined(text.substr(0, end)));
  const std::string unit = joined(text.substr(end));
  if (!heading.role || unit.empty() || take_unit(unit, heading)) return heading;
  // A unit in brackets is one; a further word makes it a column of another kind.
  if (open != std::string::npos && unit_kind(*heading.role))
    heading.unknown_unit = unit;
  else
    heading.role = std::nullopt;
  return heading;
}

/// Whether a header ends in a unit of angles: "winkel_deg".
bool has_angle_unit(std::string_view text) {
  const std::size_t open = text.find_first_of("[({_ ");
  ColumnHeading heading{.role = ColumnRole::kBearing};
  return open != std::string_view::npos && take_unit(joined(text.substr(open)), heading);
}

double factor_of(const ColumnHeading& heading) {
  return heading.unit == AngleUnit::kDegrees ? std::numbers::pi / 180.0 : heading.factor;
}

/// Whether a column is named by its number.
bool is_column_number(const NamedColumn& column) {
  return std::ranges::all_of(column.header, is_digit);
}

bool is_number(std::string_view text, std::size_t number) {
  std::size_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && stop == text.data() + text.size() && value == number;
}

constexpr std::array<std::string_view, kColumnRoles> kRoleNames = {
    "step", "time", "nanoseconds", "robot",   "landmark", "range",          "bearing", "value",
    "x",    "y",    "right",       "heading", "distance", "heading_change", "sideways"};

}  // namespace

std::string_view name(ColumnRole role) { return kRoleNames[static_cast<std::size_t>(role)]; }

ColumnNames column_names(const std::vector<std::string>& parts, std::span<const ColumnRole> roles) {
  ColumnNames columns;
  for (const std::string& part : parts) {
    const std::size_t sign = part.find('=');
    const std::string_view role = std::string_view(part).substr(0, sign);
    const auto found = std::ranges::find(roles, role, [](ColumnRole known) { return name(known); });
    if (sign == std::string::npos || sign + 1 == part.size() || found == roles.end()) {
      std::vector<std::string_view> known;
      for (const ColumnRole one : roles) known.push_back(name(one));
      throw InvalidInput(fmt::format("--columns: {:?} is not ROLE=HEADER; the roles are {}",
                                     printable(part), fmt::join(known, ", ")));
    }
    const NamedColumn column{*found, part.substr(sign + 1)};
    const auto is_repeated = [&](const NamedColumn& other) {
      return other.role == column.role && (lower_case(other.header) == lower_case(column.header) ||
                                           (is_column_number(other) && is_column_number(column)));
    };
    if (std::ranges::any_of(columns, is_repeated))
      throw InvalidInput(fmt::format(
          "--columns: {} is given twice; a second header is for another file, and a number counts "
          "in every file",
          role));
    columns.push_back(column);
  }
  return columns;
}

ColumnNames columns_in(HeaderCells header, const ColumnNames& names) {
  ColumnNames columns;
  const auto is_in_header = [&](const NamedColumn& column) {
    for (std::size_t i = 0; i < header.size(); ++i)
      if (is_named(column, header[i], i)) return true;
    return false;
  };
  std::ranges::copy_if(names, std::back_inserter(columns), is_in_header);
  // A number counts in the tables that have no header of that role.
  const ColumnNames found = columns;
  std::erase_if(columns, [&](const NamedColumn& column) {
    return is_column_number(column) &&
           std::ranges::count(found, column.role, &NamedColumn::role) > 1;
  });
  return columns;
}

void require_columns(HeaderCells header, const ColumnNames& names, const std::string& source) {
  const ColumnNames found = columns_in(header, names);
  for (const NamedColumn& column : names) {
    if (column.is_elsewhere || std::ranges::find(found, column) != found.end()) continue;
    if (header.empty())
      throw IoError(source, fmt::format("is not a table: --columns {}=... has no effect on it",
                                        name(column.role)));
    constexpr std::size_t kMost = 20;
    std::vector<std::string> cells;
    for (const std::string_view cell : header.first(std::min(header.size(), kMost)))
      cells.push_back(in_quotes(cell));
    throw IoError(source,
                  fmt::format("no column {}, which --columns names for {}; there are {}{}",
                              in_quotes(column.header), name(column.role), fmt::join(cells, ", "),
                              header.size() > kMost ? ", ..." : ""));
  }
}

ColumnHeading column_heading(std::string_view cell, std::size_t number,
                             const ColumnNames& columns) {
  const auto asked = std::ranges::find_if(
      columns, [&](const NamedColumn& column) { return is_named(column, cell, number); });
  ColumnHeading heading = understood(cell);
  if (asked != columns.end()) {
    const std::string text = lower_case(trimmed(cell));
    const bool is_length = unit_kind(asked->role) == Kind::kLength;
    const bool is_angle = heading.role == ColumnRole::kBearing;
    heading = {.role = asked->role};
    const std::size_t open = text.find_first_of("[({_ ");
    if (open != std::string::npos) take_unit(joined(text.substr(open)), heading);
    if (is_length && (is_angle || has_angle_unit(text))) heading.unknown_unit = "angle";
    return heading;
  }
  // A column that the user names otherwise is not sought by its usual words. What is to the right
  // stands in place of y.
  const auto is_asked_for = [&](ColumnRole role) {
    return std::ranges::find(columns, role, &NamedColumn::role) != columns.end();
  };
  if (heading.role && (is_asked_for(*heading.role) ||
                       (heading.role == ColumnRole::kY && is_asked_for(ColumnRole::kRight))))
    return {.role = std::nullopt};
  return heading;
}

bool is_named(const NamedColumn& column, std::string_view cell, std::size_t number) {
  // A number counts columns: without a header, the first row may hold it as an ID.
  if (is_column_number(column)) return is_number(column.header, number + 1);
  return lower_case(trimmed(column.header)) == lower_case(trimmed(cell));
}

std::optional<double> column_factor(std::string_view cell, ColumnRole role,
                                    std::span<const std::string_view> words) {
  const std::string text = lower_case(trimmed(cell));
  const auto is_word = [&](std::string_view part) {
    return std::ranges::find(words, joined(part)) != words.end();
  };
  if (is_word(text)) return 1.0;
  const std::size_t open = text.find_first_of("[({");
  const std::size_t end = open != std::string::npos ? open : text.find_last_of("_ .");
  if (end == std::string::npos || !is_word(text.substr(0, end))) return std::nullopt;
  ColumnHeading heading{.role = role};
  if (!take_unit(joined(text.substr(end)), heading)) return std::nullopt;
  return factor_of(heading);
}

double named_column_factor(std::string_view cell, ColumnRole role) {
  const std::string text = lower_case(trimmed(cell));
  ColumnHeading heading{.role = role};
  if (const std::size_t open = text.find_first_of("[({_ "); open != std::string::npos)
    take_unit(joined(text.substr(open)), heading);
  return factor_of(heading);
}

bool names_steps(std::string_view cell, const ColumnNames& columns) {
  const std::optional<ColumnRole> role = column_heading(cell, 0, columns).role;
  return role == ColumnRole::kStep || role == ColumnRole::kTime;
}

bool names_rate(std::string_view cell) {
  static constexpr std::string_view kRateWords[] = {
      "v",        "vx",   "vel",    "velocity",        "speed",        "geschwindigkeit",
      "omega",    "wz",   "omegaz", "angularvelocity", "yawrate",      "turnrate",
      "drehrate", "gyro", "gyroz",  "twistlinearx",    "twistangularz"};
  // Joined as headers are: "m/s", "m_s" and "m s-1".
  static constexpr std::string_view kRateUnits[] = {
      "m/s",  "ms",    "mps",   "ms1",   "cm/s", "mm/s",  "km/h", "kmh", "kph", "rad/s",
      "rads", "rads1", "radps", "deg/s", "degs", "degps", "dps",  "°/s", "rpm"};
  const std::string text = lower_case(trimmed(cell));
  const auto is_word = [](std::string_view part) {
    return std::ranges::find(kRateWords, joined(part)) != std::end(kRateWords);
  };
  const auto is_unit = [](std::string_view part) {
    return std::ranges::any_of(
        kRateUnits, [part](std::string_view unit) { return joined(part) == joined(unit); });
  };
  if (is_word(text)) return true;
  for (std::size_t at = text.find_first_of(kBeforeUnit); at != std::string::npos;
       at = text.find_first_of(kBeforeUnit, at + 1))
    if (is_word(text.substr(0, at)) || is_unit(text.substr(at))) return true;
  return false;
}

bool is_geographic(std::string_view heading) {
  const std::string word = lower_case(trimmed(heading));
  return word.starts_with("lat") || word.starts_with("lon");
}

}  // namespace mapproof
