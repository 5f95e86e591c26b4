#include "core/studies/validate.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/files/paths.hpp"
#include "core/base/text/words.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_document.hpp"
#include "core/json/text_input.hpp"
#include "core/records/detections/detections.hpp"
#include "core/records/detections/mrclam.hpp"
#include "core/records/detections/scan_rows.hpp"
#include "core/records/experiments/external_methods.hpp"
#include "core/records/maps/map_csv.hpp"
#include "core/records/maps/map_json.hpp"
#include "core/records/metrics/metrics_json.hpp"
#include "core/records/observations/input_kind.hpp"
#include "core/records/observations/landmarks_csv.hpp"
#include "core/records/observations/observation_json.hpp"
#include "core/records/observations/observations.hpp"
#include "core/records/ranges/range_columns.hpp"
#include "core/records/ranges/range_companions.hpp"
#include "core/records/ranges/range_logs.hpp"
#include "core/records/studies/folder_lock.hpp"
#include "core/records/studies/results_table.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/records/studies/study_page.hpp"
#include "core/records/studies/timings_jsonl.hpp"
#include "core/records/tables/respelling.hpp"
#include "core/records/tables/table_stream.hpp"
#include "core/studies/study_kind.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// A problem that is known in words.
class CheckedProblem : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

bool is_map(const TableRow& header) {
  return header.cells.size() >= 6 && header.cells[0] == "name" && header.cells[3] == "true_x_m" &&
         std::ranges::find(header.cells, "anchor") != header.cells.end();
}

bool is_results_table(const TableRow& header) {
  return header.cells.size() >= 3 && header.cells[0] == "setup" && header.cells[1] == "method" &&
         header.cells[2] == "quantity";
}

bool is_part_of_mrclam(const std::filesystem::path& path) {
  const std::string name = unpacked_name(path.filename()).string();
  return name == "Barcodes.dat" || name.ends_with("_Measurement.dat");
}

/// A table in memory as a source.
ByteSource memory_source(const std::string& name, const std::string& bytes) {
  return {name, [&bytes, at = std::size_t{0}](std::span<char> to) mutable {
            const std::size_t count = std::min(to.size(), bytes.size() - at);
            std::copy_n(bytes.data() + at, count, to.begin());
            at += count;
            return count;
          }};
}

/// What a table may hold where nobody states it, in this order.
struct Guess {
  Sensor sensor;
  AngleUnit unit;
};
constexpr std::array kGuesses = {
    Guess{Sensor::kVisibility, AngleUnit::kRadians}, Guess{Sensor::kRange, AngleUnit::kRadians},
    Guess{Sensor::kBearing, AngleUnit::kRadians}, Guess{Sensor::kBearing, AngleUnit::kDegrees}};

constexpr const char* kDegreesRemark = "The bearings are in degrees: `map` needs --degrees";

void take_observations(const ObservationSource& source, Finding& finding) {
  finding.input = summary_of(source);
  finding.remarks.insert(finding.remarks.end(), source.remarks.begin(), source.remarks.end());
}

/// Words of headers that are no landmarks: those of odometry, positions and paths, in any case.
constexpr std::string_view kMeasured[] = {
    "v",        "vx",       "vy",   "omega",   "w",   "speed",    "velocity",  "geschwindigkeit",
    "linear",   "angular",  "dist", "lat",     "lon", "latitude", "longitude", "alt",
    "z",        "qx",       "qy",   "qz",      "qw",  "yaw",      "heading",   "course",
    "kurs",     "richtung", "turn", "drehung", "weg", "east",     "north",     "easting",
    "northing", "ost",      "nord"};

/// The cells of a header that name what other tables than those of landmarks and steps hold; none
/// if most of them do not: a landmark may be called "x", too.
std::vector<std::string> other_quantities(std::string_view text, const std::string& name,
                                          const ColumnNames& columns) {
  constexpr std::array kOfScans = {ColumnRole::kStep,        ColumnRole::kTime,
                                   ColumnRole::kNanoseconds, ColumnRole::kLandmark,
                                   ColumnRole::kRobot,       ColumnRole::kValue};
  TableReader reader(text, name);
  TableRow header;
  std::vector<std::string> others;
  if (!reader.next(header)) return others;
  const ColumnNames named = columns_in(header.cells, columns);
  std::size_t unknown = 0;
  for (std::size_t i = 0; i < header.cells.size(); ++i) {
    const std::string cell = lower_case(trimmed(header.cells[i]));
    const std::string word = cell.substr(0, cell.find_first_of(" _[("));
    const std::optional<ColumnRole> role = column_heading(cell, i, named).role;
    if (role && std::ranges::find(kOfScans, *role) != kOfScans.end()) continue;
    if (role || std::ranges::find(kMeasured, word) != std::ranges::end(kMeasured))
      others.emplace_back(header.cells[i]);
    else
      ++unknown;
  }
  if (others.size() < unknown) others.clear();
  return others;
}

/// A table that may be anything is not taken for one of landmarks and steps if its header names
/// other quantities. @throws CheckedProblem with the ways out.
void refuse_other_quantities(std::string_view text, const std::string& name,
                             const ValidateOptions& options) {
  std::vector<std::string> others = other_quantities(text, name, options.format.columns);
  if (others.empty()) return;
  const bool has_degrees = std::ranges::any_of(others, is_geographic);
  for (std::string& cell : others) cell = in_quotes(cell);
  throw CheckedProblem(fmt::format(
      "{}: is neither odometry (time, distance, heading change), a path (time, x, y), positions "
      "(name, x, y) nor detections (time, landmark, range, bearing): its header has {}. {}",
      name, fmt::join(others, ", "),
      has_degrees ? "Latitudes and longitudes have to be projected to metres (UTM) first"
                  : "--columns ROLE=HEADER names its columns; --odometry, --anchors, "
                    "--ground-truth or --sensor state what it is"));
}

/// Reads a table of one sensor's values. Without a sensor that fits, the error about bearings is
/// the most helpful: values that fit none are often degrees.
void check_observations(const std::string& bytes, const std::string& name,
                        const ValidateOptions& options, Finding& finding) {
  if (options.sensor.empty() && options.format.layout == Layout::kAuto)
    refuse_other_quantities(bytes, name, options);
  const auto read = [&](Sensor sensor, const TableFormat& format) {
    ByteSource source = memory_source(name, bytes);
    return read_observations(source, sensor, format);
  };
  finding.kind = "observations";
  std::string problem;
  if (const auto sensor = sensor_named(options.sensor)) {
    take_observations(read(*sensor, options.format), finding);
  } else {
    for (const Guess& guess : kGuesses) {
      TableFormat format = options.format;
      if (guess.unit == AngleUnit::kDegrees) format.unit = guess.unit;
      try {
        take_observations(read(guess.sensor, format), finding);
        if (guess.unit != options.format.unit && guess.unit == AngleUnit::kDegrees)
          finding.remarks.emplace_back(kDegreesRemark);
        finding.remarks.push_back(
            fmt::format("The sensor is not stated: the values fit {}", finding.input->sensor));
        problem.clear();
        break;
      } catch (const IoError& error) {
        if (problem.empty() ||
            (guess.sensor == Sensor::kBearing && guess.unit == options.format.unit))
          problem = error.what();
      }
    }
    if (!problem.empty()) throw CheckedProblem(problem);
  }
  const std::string& form = finding.input->reading.form;
  finding.kind = form.substr(0, form.find(' ')) + " CSV observations";
}

void take_companion(CompanionSummary summary, Finding& finding) {
  finding.kind = summary.kind;
  finding.remarks = summary.remarks;
  finding.companion = std::move(summary);
}

void check_detections(ByteSource& source, const ValidateOptions& options, Finding& finding) {
  finding.kind = "detections";
  DetectionSource read = read_detections(source, options.format);
  const MeasuredColumns measured{
      .range = std::ranges::any_of(read.log.detections,
                                   [](const Detection& seen) { return !std::isnan(seen.range_m); }),
      .bearing = std::ranges::any_of(read.log.detections, [](const Detection& seen) {
        return !std::isnan(seen.bearing_rad);
      })};
  finding.input = summary_of(read, !options.sensor.empty()              ? options.sensor
                                   : measured.range && measured.bearing ? "range-bearing"
                                   : measured.range                     ? "range"
                                   : measured.bearing                   ? "bearing"
                                                                        : "visibility");
  finding.remarks = read.remarks;
}

/// Reads a table of any kind that mapproof knows, as `map` reads it: detections, long, wide or
/// transposed observations, landmarks with positions, a map.
/// @throws IoError if it is none, or is broken.
void check_table_once(const std::string& bytes, const std::string& name,
                      const ValidateOptions& options, Finding& finding) {
  const std::string_view text = checked_text(bytes, name);
  ByteSource source = memory_source(name, bytes);
  if (options.format.layout == Layout::kAuto && is_detections(source, options.format)) {
    try {
      return check_detections(source, options, finding);
    } catch (const IoError&) {
      ValidateOptions degrees = options;
      degrees.format.unit = AngleUnit::kDegrees;
      ByteSource again = memory_source(name, bytes);
      if (options.format.unit == AngleUnit::kDegrees) throw;
      try {
        check_detections(again, degrees, finding);
        finding.remarks.emplace_back(kDegreesRemark);
        return;
      } catch (const IoError&) {  // In degrees, it has a problem as well: the first is reported.
      }
      throw;
    }
  }
  TableReader reader(text, name);
  TableRow first;
  const ColumnNames& columns = options.format.columns;
  const bool is_stated = !options.sensor.empty() || options.format.layout != Layout::kAuto;
  if (!is_stated && reader.next(first) && is_map(first)) {
    finding.kind = "map CSV";
    parse_map_csv(text, name);
  } else if (!is_stated && is_landmarks_table(text, name, columns) &&
             !has_long_header(text, name, columns) && !starts_as_long(text, name)) {
    ByteSource positions = memory_source(name, bytes);
    take_companion(read_companion(positions, Companion::kLandmarks, columns), finding);
  } else {
    check_observations(bytes, name, options, finding);
  }
}

/// Makes a comment of the line that an error names, so that what follows it is checked, too.
/// @return False if it names none, or the first row.
bool leave_out_line(std::string& bytes, std::string_view error) {
  const std::size_t at = error.find(": line ");
  std::size_t line = 0;
  if (at == std::string_view::npos) return false;
  const std::string_view digits = error.substr(at + 7);
  std::from_chars(digits.data(), digits.data() + digits.size(), line);
  std::size_t begin = 0;
  bool is_first = true;
  for (std::size_t i = 1; i < line; ++i) {
    is_first = is_first && (bytes[begin] == '#' || bytes[begin] == '\n');
    begin = bytes.find('\n', begin);
    if (begin == std::string::npos) return false;
    ++begin;
    if (begin == bytes.size()) return false;
  }
  if (is_first || bytes[begin] == '#') return false;
  bytes.insert(begin, "#");
  return true;
}

/// Reads a table until it is fine, or ten problems are known: a line with a problem is left out.
void check_table(ByteSource& input, const ValidateOptions& options, Finding& finding) {
  constexpr std::size_t kLarge = 64'000'000, kMostProblems = 10;
  const std::string name = input.name();
  if (is_part_of_mrclam(input.path()))
    throw IoError(name, "is one file of an MRCLAM data set: check the folder");
  if (first_row_is(input, is_results_table))
    throw IoError(name, "is a table of results without its study.json: check the study's folder");
  if (input.holds_more_than(kLarge) && is_detections(input, options.format))
    return check_detections(input, options, finding);
  input.take_text();
  std::string bytes = input.rest();
  std::vector<std::string> problems;
  while (problems.size() < kMostProblems) {
    try {
      check_table_once(bytes, name, options, finding);
      break;
    } catch (const std::runtime_error& error) {
      const std::string problem = error.what();
      if (!problems.empty() && problem.find(": line ") == std::string::npos) break;
      problems.push_back(problem);
      if (!leave_out_line(bytes, problem)) break;
    }
  }
  if (problems.empty()) return;
  finding.input.reset();
  finding.companion.reset();
  finding.remarks.clear();
  finding.problem = problems.front();
  finding.further.assign(problems.begin() + 1, problems.end());
}

/// Files that are of no study's kind.
constexpr std::array kOtherFiles = {
    StudyFile{"mapproof.map", [](auto text, auto& source) { parse_map(text, source); }},
    StudyFile{"mapproof.observations",
              [](auto text, auto& source) { parse_observations(text, source, std::nullopt); }},
    StudyFile{"mapproof.detections",
              [](auto text, auto& source) { parse_detections(text, source); }},
    StudyFile{"mapproof.methods",
              [](auto text, auto& source) { parse_external_methods(text, source); }},
    StudyFile{kMetricsSchema,
              [](auto text, auto& source) { parse_metrics(text, source, Better::kLower); }},
    StudyFile{kPageSchema, [](auto text, auto& source) { parse_page_data(text, source); }},
};

/// Null if core has no such schema.
const StudyFile* file_of(std::string_view schema) {
  const auto find = [&](std::span<const StudyFile> files) -> const StudyFile* {
    const auto found = std::ranges::find(files, schema, &StudyFile::schema);
    return found == files.end() ? nullptr : &*found;
  };
  for (const StudyKind* kind : all_study_kinds())
    if (const StudyFile* file = find(kind->files)) return file;
  return find(kOtherFiles);
}

/// Whether it is a format that mapproof writes for others and never reads again.
bool is_only_written(const SchemaId& schema) {
  constexpr std::array<std::string_view, 3> kWritten = {"mapproof.diff", "mapproof.history",
                                                        "mapproof.nightly_run"};
  return schema.version == 1 && std::ranges::find(kWritten, schema.name) != kWritten.end();
}

void check_json(std::string_view text, const ForeignReader& foreign, Finding& finding) {
  // No second index of the text is held while its reader makes its own.
  const SchemaId schema = schema_of(parse_json(text, finding.path).cursor());
  finding.kind = printable(fmt::format("{} {}", schema.name, schema.version));
  if (const StudyFile* known = file_of(schema.name))
    known->check(text, finding.path);
  else if (foreign && foreign(schema.name, text, finding.path))
    return;
  else if (foreign ? !is_only_written(schema) : !schema.name.starts_with("mapproof."))
    parse_json(text, finding.path)
        .cursor()
        .at("schema")
        .at("name")
        .fail("unknown schema " + in_quotes(schema.name));
}

/// Lines of JSON: a file of many values.
bool is_timings(ByteSource& source) {
  return source.path().filename() == "timings.jsonl" ||
         (is_json(source) && json_schema(source) == "mapproof.timings");
}

/// What a range log holds, as a remark.
void take_range_log(const RangeLog& log, Finding& finding) {
  finding.kind = "range log";
  finding.remarks = {fmt::format(
      "{}, {}, {} of odometry", counted(std::ssize(log.landmarks), "landmark"),
      counted(std::ssize(log.ranges), "range"), counted(std::ssize(log.odometry), "motion"))};
}

/// A graph may hold a range log, or detections, as `slam` and `map` read them.
void check_range_log(ByteSource& source, const ValidateOptions& options, Finding& finding) {
  finding.kind = "range log";
  const std::string_view start = source.peek();
  if (!start.starts_with("VERTEX") && !start.starts_with("EDGE_")) {
    take_range_log(read_range_log(source, {.columns = options.format.columns}), finding);
    return;
  }
  const std::string bytes = source.rest(), name = source.name();
  try {
    ByteSource log = memory_source(name, bytes);
    take_range_log(read_range_log(log), finding);
  } catch (const IoError& error) {
    const std::string problem = error.what();
    try {
      ByteSource graph = memory_source(name, bytes);
      check_detections(graph, options, finding);
    } catch (const IoError&) {
      finding.kind = "range log";
      throw CheckedProblem(problem);
    }
  }
}

/// Reads a file as what it is stated to be.
void check_role(ByteSource& source, const ValidateOptions& options, Finding& finding) {
  const ColumnNames& columns = options.format.columns;
  const Companion companion = options.role == InputRole::kOdometry  ? Companion::kOdometry
                              : options.role == InputRole::kAnchors ? Companion::kLandmarks
                              : holds_landmarks(source, columns)    ? Companion::kLandmarks
                                                                    : Companion::kPath;
  take_companion(read_companion(source, companion, columns), finding);
  constexpr int kFewestAnchors = 3;
  if (options.role == InputRole::kAnchors && finding.companion->rows < kFewestAnchors)
    finding.remarks.push_back(
        fmt::format("A map is aligned to {} or more anchors", kFewestAnchors));
}

/// A table that detections' reader refuses may be one of ranges, which `slam` reads: a landmark may
/// come twice at one time there.
void check_table_or_ranges(ByteSource& source, const ValidateOptions& options, Finding& finding) {
  const ColumnNames& columns = options.format.columns;
  const bool may_be_ranges = options.sensor.empty() && options.format.layout == Layout::kAuto &&
                             !options.format.scan_window_s &&
                             first_row_is(source, [&](const TableRow& row) {
                               return missing_range_columns(row, columns).empty();
                             });
  if (!may_be_ranges) return check_table(source, options, finding);
  const std::string bytes = source.rest(), name = source.name();
  ByteSource table = memory_source(name, bytes);
  check_table(table, options, finding);
  if (finding.problem.empty()) return;
  try {
    ByteSource again = memory_source(name, bytes);
    const RangeLog log = read_range_log(again, {.columns = columns});
    finding = {.path = finding.path, .kind = "", .problem = ""};
    take_range_log(log, finding);
  } catch (const IoError&) {  // The problem as detections is reported.
  }
}

void check_source(ByteSource& source, const ForeignReader& foreign, const ValidateOptions& options,
                  Finding& finding) {
  const ColumnNames& columns = options.format.columns;
  const bool is_stated = !options.sensor.empty() || options.format.layout != Layout::kAuto ||
                         options.format.scan_window_s;
  const bool is_log =
      options.role == InputRole::kAny && !is_stated && is_range_log(source, columns);
  if (!is_log) require_columns(source, columns);
  if (options.role != InputRole::kAny) {
    check_role(source, options, finding);
  } else if (is_log) {
    check_range_log(source, options, finding);
  } else if (is_timings(source)) {
    finding.kind = "timings";
    parse_timings(source.rest(), finding.path);
  } else if (unpacked_name(source.path()).filename() == "results.csv") {
    finding.kind = "results";
    const StudyKind* kind = kind_of_study(source.path().parent_path());
    StudyContents study = read_study_contents(source.path().parent_path(), {.keeps_on = true});
    // Of our own studies the table is made from the records; of others it has just been read.
    const bool is_made = kind != nullptr && !kind->experiment.empty();
    if (is_made || source.path().filename() != kResultsFile) {
      const bool is_whole = is_made && study.problems.empty();
      const std::string made = is_whole ? results_csv(study.results.rows) : "";
      study.results.rows = {};  // They take more than their text, and are read again from it.
      const std::string text = source.rest();
      parse_results_csv(text, source.name(), study.results.quantities);
      if (is_whole && text != made)
        throw IoError(finding.path,
                      "differs from the records of its study; `mapproof run` makes it");
    }
  } else if (CompanionSummary companion =
                 is_stated ? CompanionSummary{} : read_companion(source, columns);
             !companion.kind.empty()) {
    take_companion(std::move(companion), finding);
  } else {
    const bool is_unstated_json = is_json(source) && json_schema(source).empty();
    respell(source);
    if (is_json(source))
      check_json(source.rest(), foreign, finding);
    else
      check_table_or_ranges(source, options, finding);
    if (is_unstated_json && !finding.problem.empty())
      finding.problem += fmt::format(
          "; if {} is not a table: it lacks the key \"schema\" with the name and version of its "
          "format",
          finding.path);
  }
}

Finding check(const fs::path& path, const ForeignReader& foreign,
              const ValidateOptions& options = {}) {
  try {
    ByteSource source(path);
    return validate(source, foreign, options);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return {.path = input_name(path), .kind = {}, .problem = error.what()};
  }
}

/// What is read again of a study's or a map's folder, and what stands in the place of such a file;
/// figures and pages are of other kinds.
std::vector<fs::path> our_files(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    const bool is_ours =
        entry->path().extension() == ".json" || entry->path().filename() == "timings.jsonl" ||
        entry->path().filename() == "map.csv" || entry->path().filename() == "results.csv" ||
        (is_leftover(entry->path()) && entry->is_regular_file(ignored));
    if (is_ours) paths.push_back(entry->path());
  }
  if (error) throw IoError(folder.string(), "cannot be searched: " + error.message());
  std::ranges::sort(paths);
  return paths;
}

Finding check_as(const std::string& kind, const fs::path& folder,
                 const std::function<void()>& read) {
  Finding finding{.path = folder.string(), .kind = kind, .problem = {}};
  try {
    read();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    finding.problem = error.what();
  }
  return finding;
}

Finding check_study(const fs::path& folder) {
  std::vector<std::string> remarks;
  Finding finding = check_as("study", folder, [&] {
    if (const StudyKind* kind = kind_of_study(folder)) remarks = kind->check(folder);
  });
  finding.remarks = std::move(remarks);
  return finding;
}

/// The studies right below a folder that holds none itself.
std::vector<fs::path> studies_below(const fs::path& folder) {
  std::vector<fs::path> studies;
  std::error_code error;
  if (is_study(folder)) return studies;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (is_study(entry->path())) studies.push_back(entry->path());
  std::ranges::sort(studies);
  return studies;
}

std::vector<Finding> check_folder(const fs::path& folder, const ForeignReader& foreign,
                                  const ValidateOptions& options) {
  std::vector<Finding> findings;
  const std::vector<fs::path> studies = studies_below(folder);
  const bool is_ours = is_study(folder) || !studies.empty() || is_there(folder / "map.json") ||
                       is_there(folder / "slam.json");
  if (is_ours) refuse_links_out(folder);
  if (is_study(folder)) findings.push_back(check_study(folder));
  for (const fs::path& study : studies) findings.push_back(check_study(study));
  if (is_ours) {
    for (const fs::path& path : our_files(folder)) {
      findings.push_back(check(path, foreign));
      if (is_leftover(path))
        findings.back().problem = findings.back().path + ": left by a killed process";
      // What is wrong with a file is wrong with its study and its table: it is reported once.
      const std::string problem = findings.back().problem;
      const auto last = std::prev(findings.end());
      if (!problem.empty())
        findings.erase(
            std::remove_if(findings.begin(), last,
                           [&](const Finding& finding) { return finding.problem == problem; }),
            last);
    }
    return findings;
  }
  if (is_range_log_folder(folder)) {
    RangeLog log;
    Finding finding = check_as("range log", folder, [&] {
      log = read_range_log(folder, {.columns = options.format.columns});
    });
    if (finding.problem.empty()) take_range_log(log, finding);
    return {finding};
  }
  if (is_mrclam(folder))
    return {check_as("MRCLAM observations", folder, [&] {
      read_mrclam(folder, Sensor::kVisibility, options.format.scan_window_s);
    })};
  throw IoError(folder.string(),
                "is a folder with no study, no map, no range log and no MRCLAM data in it");
}

/// What the table was before it was made a text.
void take_form(const ByteSource& source, Finding& finding) {
  finding.input->reading.packing = source.form();
  if (source.original().empty()) return;
  finding.input->reading.separator = '\0';
  if (const std::size_t at = finding.kind.find(" CSV"); at != std::string::npos)
    finding.kind.erase(at, 4);
}

}  // namespace

Finding validate(ByteSource& source, const ForeignReader& foreign, const ValidateOptions& options) {
  Finding finding{.path = source.name(), .kind = {}, .problem = {}};
  try {
    check_source(source, foreign, options, finding);
    if (finding.input && finding.input->reading.packing.empty()) take_form(source, finding);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    finding.problem = error.what();
  }
  return finding;
}

std::vector<Finding> validate(const fs::path& path, const ForeignReader& foreign,
                              const ValidateOptions& options) {
  if (!is_folder(path)) return {check(path, foreign, options)};
  try {
    return check_folder(path, foreign, options);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& problem) {
    return {{.path = path.string(), .kind = {}, .problem = problem.what()}};
  }
}

}  // namespace mapproof
