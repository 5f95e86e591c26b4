#include "app/understood.hpp"

#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/table_options.hpp"
#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {
namespace {

const char* separator_words(char separator) {
  switch (separator) {
    case '\0':
      return "";
    case ',':
      return "separated by commas";
    case ';':
      return "separated by semicolons";
    case '\t':
      return "separated by tabs";
    case '|':
      return "separated by bars";
    case TableReader::kBlanks:
      return "separated by blanks";
    default:
      return "separated as the first line states";
  }
}

std::string unit_words(const InputSummary& summary) {
  const char* zero = "counter-clockwise from the heading";
  switch (summary.reading.convention) {
    case BearingConvention::kCounterclockwise:
      break;
    case BearingConvention::kClockwise:
      zero = "clockwise from the heading";
      break;
    case BearingConvention::kCompass:
      zero = "clockwise from north";
      break;
    case BearingConvention::kEast:
      zero = "counter-clockwise from the x axis";
      break;
  }
  const char* unit = summary.reading.unit == AngleUnit::kDegrees ? "deg" : "rad";
  if (summary.sensor == "bearing") return fmt::format("bearing [{}, {}]", unit, zero);
  if (summary.sensor == "range") return "range [m]";
  if (summary.sensor == "visibility") return "visibility [0 or 1]";
  return fmt::format("range [m] and bearing [{}, {}]", unit, zero);
}

/// "time = Zeit, landmark = Objekt"; a column without a header by its role alone.
std::string column_words(const std::vector<std::pair<std::string, std::string>>& columns) {
  std::vector<std::string> words;
  for (const auto& [role, header] : columns)
    words.push_back(header.empty() || lower_case(header) == role
                        ? role
                        : fmt::format("{} = {}", role, printable(header, 40)));
  return words.empty() ? "" : fmt::format("columns {}", fmt::join(words, ", "));
}

/// Odometry, a path or positions in numbers.
std::vector<std::string> companion_facts(const CompanionSummary& summary) {
  const std::string duration =
      summary.duration_s > 0.0 ? fmt::format("{:.4g} s", summary.duration_s) : "";
  const std::string extent =
      fmt::format("{:.4g} m x {:.4g} m", summary.extent_m.x(), summary.extent_m.y());
  std::vector<std::string> facts;
  switch (summary.companion) {
    case Companion::kOdometry:
      facts = {counted(summary.rows, "motion"), duration,
               fmt::format("a way of {:.4g} m", summary.way_m),
               fmt::format("heading changes of {:.4g} rad in all", summary.turned_rad)};
      break;
    case Companion::kPath:
      facts = {counted(summary.rows, "pose"), duration};
      if (summary.way_m > 0.0)
        facts.push_back(fmt::format("a way of {:.4g} m within {}", summary.way_m, extent));
      facts.emplace_back(summary.has_headings ? "with headings" : "");
      break;
    case Companion::kLandmarks:
      facts = {counted(summary.rows, "landmark"), "within " + extent};
      break;
  }
  std::erase(facts, "");
  return facts;
}

nlohmann::ordered_json columns_json(
    const std::vector<std::pair<std::string, std::string>>& columns) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (const auto& [role, header] : columns) object[role] = header;
  return object;
}

}  // namespace

std::string understood_line(const std::string& name, const CompanionSummary& summary) {
  const std::string columns = column_words(summary.columns);
  return fmt::format("{}: {}{}{}", printable(name, 300), fmt::join(companion_facts(summary), ", "),
                     columns.empty() ? "" : "; ", columns);
}

std::string understood_line(const RangeLog& log) {
  std::vector<std::string> table = {column_words(log.columns), separator_words(log.separator)};
  std::erase(table, "");
  return fmt::format(
      "{}: {}, {} [m], {} of odometry [m, rad], ground truth of the path: "
      "{}{}{}",
      log.name, counted(std::ssize(log.landmarks), "landmark"),
      counted(std::ssize(log.ranges), "range"), counted(std::ssize(log.odometry), "motion"),
      log.ground_truth ? "yes" : "no", table.empty() ? "" : "; ", fmt::join(table, ", "));
}

nlohmann::ordered_json understood_json(const CompanionSummary& summary) {
  nlohmann::ordered_json object{{"rows", summary.rows}};
  if (summary.companion != Companion::kLandmarks) {
    object["duration_s"] = summary.duration_s;
    object["way_m"] = summary.way_m;
  }
  if (summary.companion == Companion::kOdometry)
    object["turned_rad"] = summary.turned_rad;
  else
    object["extent_m"] = {summary.extent_m.x(), summary.extent_m.y()};
  object["columns"] = columns_json(summary.columns);
  return object;
}

std::string understood_line(const std::string& name, const InputSummary& summary) {
  const TableReading& reading = summary.reading;
  std::vector<std::string> facts = {fmt::format("{} x {}", counted(summary.landmarks, "landmark"),
                                                counted(summary.steps, "time step")),
                                    unit_words(summary)};
  if (summary.detections > 0) facts.push_back(counted(summary.detections, "detection"));
  // In a list of what was seen the rest was not seen: nothing is missing.
  if (summary.detections == 0 || summary.sensor != "visibility")
    facts.push_back(fmt::format("{:.1f} % missing", 100.0 * summary.missing_share));
  std::vector<std::string> form;
  if (!reading.form.empty()) form.push_back(reading.form);
  if (const std::string words = column_words(reading.columns); !words.empty())
    form.push_back(words);
  if (const std::string words = separator_words(reading.separator); !words.empty())
    form.push_back(words);
  if (!reading.packing.empty()) form.push_back(reading.packing);
  if (reading.has_decimal_commas) form.emplace_back("decimal commas");
  if (!reading.times.empty()) form.push_back("times as " + reading.times);
  return fmt::format("{}: {}{}{}", printable(name, 300), fmt::join(facts, ", "),
                     form.empty() ? "" : "; ", fmt::join(form, ", "));
}

nlohmann::ordered_json understood_json(const InputSummary& summary) {
  const TableReading& reading = summary.reading;
  nlohmann::ordered_json object{
      {"landmarks", summary.landmarks},
      {"steps", summary.steps},
      {"sensor", summary.sensor},
      {"bearing_unit", reading.unit == AngleUnit::kDegrees ? "deg" : "rad"},
      {"bearing_convention", name(reading.convention)},
      {"missing_share", summary.missing_share},
      {"form", reading.form},
      {"columns", columns_json(reading.columns)},
      {"separator", reading.separator == '\0' ? "" : std::string(1, reading.separator)},
      {"decimal_commas", reading.has_decimal_commas},
      {"times", reading.times}};
  return object;
}

}  // namespace mapproof
