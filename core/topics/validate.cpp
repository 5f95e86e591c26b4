#include "core/topics/validate.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/files/input_file.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/text_input.hpp"
#include "core/records/detections/detections.hpp"
#include "core/records/detections/detections_long.hpp"
#include "core/records/detections/mrclam.hpp"
#include "core/records/detections/scan_rows.hpp"
#include "core/records/maps/map_csv.hpp"
#include "core/records/maps/map_json.hpp"
#include "core/records/observations/input_kind.hpp"
#include "core/records/observations/landmarks_csv.hpp"
#include "core/records/observations/observation_json.hpp"
#include "core/records/observations/observations.hpp"
#include "core/records/ranges/range_logs.hpp"
#include "core/records/studies/folder_lock.hpp"
#include "core/records/studies/results_table.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/records/studies/timings_jsonl.hpp"
#include "core/records/tables/cells.hpp"
#include "core/records/tables/table_stream.hpp"
#include "core/topics/study_kind.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

using Reader = ObservationSource (*)(std::string_view, const std::string&, Sensor, AngleUnit);

/// Of the three sensors the bearings' error is the most helpful: values that fit none are often
/// degrees.
void check_observations(std::string_view text, const std::string& source, Reader reader) {
  for (const Sensor sensor : {Sensor::kVisibility, Sensor::kRange}) {
    try {
      reader(text, source, sensor, AngleUnit::kRadians);
      return;
    } catch (const IoError&) {
    }
  }
  reader(text, source, Sensor::kBearing, AngleUnit::kRadians);
}

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

/// Reads a table of any kind that mapproof knows: long or wide observations, landmarks with
/// positions, a map. The header decides which, or the rows if there is none. What the values of
/// observations are is not determined by a table: visibility, bearing and range are tried.
/// @param kind  Set to what it was taken for, before anything is thrown.
/// @throws IoError if it is none, or is broken.
void check_table(ByteSource& input, std::string& kind) {
  const std::string& source = input.name();
  if (is_part_of_mrclam(input.path()))
    throw IoError(source, "is one file of an MRCLAM data set: check the folder");
  if (first_row_is(input, is_results_table))
    throw IoError(source, "is a table of results without its study.json: check the study's folder");
  if (first_row_is(input, names_detection_columns)) {
    kind = "detections";
    read_long_detections(input, {});
    return;
  }
  const std::string bytes = input.rest();
  const std::string_view text = checked_text(bytes, source);
  TableReader reader(text, source);
  TableRow first;
  if (reader.next(first) && is_map(first)) {
    kind = "map CSV";
    parse_map_csv(text, source);
    return;
  }
  if (has_long_header(text, source) || starts_as_long(text, source)) {
    kind = "long CSV observations";
    return check_observations(text, source,
                              [](auto rows, const auto& name, auto sensor, auto unit) {
                                return read_long(rows, name, sensor, unit);
                              });
  }
  if (is_landmarks_table(text, source)) {
    kind = "landmarks with positions";
    parse_landmarks(text, source);
    return;
  }
  kind = "wide CSV observations";
  check_observations(text, source, read_wide);
}

/// Files that are of no study's kind.
constexpr std::array kOtherFiles = {
    StudyFile{"mapproof.map", [](auto text, auto& source) { parse_map(text, source); }},
    StudyFile{"mapproof.observations",
              [](auto text, auto& source) { parse_observations(text, source, std::nullopt); }},
    StudyFile{"mapproof.detections",
              [](auto text, auto& source) { parse_detections(text, source); }},
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

void check_json(std::string_view text, const ForeignReader& foreign, Finding& finding) {
  const JsonDocument document = parse_json(text, finding.path);
  const SchemaId schema = schema_of(document.cursor());
  finding.kind = printable(fmt::format("{} {}", schema.name, schema.version));
  if (const StudyFile* known = file_of(schema.name))
    known->check(text, finding.path);
  else if (foreign && foreign(schema.name, text, finding.path))
    return;
  else if (!schema.name.starts_with("mapproof."))
    document.cursor().at("schema").at("name").fail("unknown schema " + in_quotes(schema.name));
}

/// Whether a name is one that tables have: of their endings, or none at all.
bool may_be_table(const fs::path& path) {
  constexpr std::array<std::string_view, 5> kExtensions = {"", ".csv", ".tsv", ".txt", ".dat"};
  return std::ranges::find(kExtensions, unpacked_name(path).extension()) != kExtensions.end();
}

/// Lines of JSON: a file of many values.
bool is_timings(ByteSource& source) {
  return source.path().filename() == "timings.jsonl" ||
         (is_json(source) && json_schema(source) == "mapproof.timings");
}

void check_source(ByteSource& source, const ForeignReader& foreign, Finding& finding) {
  if (is_range_log(source)) {
    finding.kind = "range log";
    read_range_log(source);
  } else if (is_timings(source)) {
    finding.kind = "timings";
    parse_timings(source.rest(), finding.path);
  } else if (unpacked_name(source.path()).filename() == "results.csv") {
    finding.kind = "results";
    const StudyContents study =
        read_study_contents(source.path().parent_path(), {.keeps_on = true});
    const std::string text = source.rest();
    parse_results_csv(text, source.name(), study.results.quantities);
    // Of our own studies the table is made from the records.
    const StudyKind* kind = kind_of_study(source.path().parent_path());
    if (kind != nullptr && !kind->experiment.empty() && study.problems.empty() &&
        text != results_csv(study.results.rows))
      throw IoError(finding.path, "differs from the records of its study; `mapproof run` makes it");
  } else if (is_json(source)) {
    check_json(source.rest(), foreign, finding);
  } else if (may_be_table(source.path())) {
    check_table(source, finding.kind);
  } else {
    throw IoError(finding.path, "is not a file that mapproof reads or writes");
  }
}

Finding check(const fs::path& path, const ForeignReader& foreign) {
  try {
    ByteSource source(path);
    return validate(source, foreign);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return {.path = input_name(path), .kind = {}, .problem = error.what()};
  }
}

/// What is read again of a study's or a map's folder; figures and pages are of other kinds.
std::vector<fs::path> our_files(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    const bool is_ours = entry->path().extension() == ".json" ||
                         entry->path().filename() == "timings.jsonl" ||
                         entry->path().filename() == "map.csv" ||
                         entry->path().filename() == "results.csv" || is_leftover(entry->path());
    if (is_ours && entry->is_regular_file(ignored)) paths.push_back(entry->path());
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

std::vector<Finding> check_folder(const fs::path& folder, const ForeignReader& foreign) {
  std::vector<Finding> findings;
  std::error_code error;
  if (is_study(folder)) findings.push_back(check_study(folder));
  const std::vector<fs::path> studies = studies_below(folder);
  for (const fs::path& study : studies) findings.push_back(check_study(study));
  if (is_study(folder) || !studies.empty() || fs::is_regular_file(folder / "map.json", error) ||
      fs::is_regular_file(folder / "slam.json", error)) {
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
  if (is_range_log_folder(folder))
    return {check_as("range log", folder, [&] { read_range_log(folder); })};
  if (is_mrclam(folder))
    return {
        check_as("MRCLAM observations", folder, [&] { read_mrclam(folder, Sensor::kVisibility); })};
  throw IoError(folder.string(),
                "is a folder with no study, no map, no range log and no MRCLAM data in it");
}

}  // namespace

Finding validate(ByteSource& source, const ForeignReader& foreign) {
  Finding finding{.path = source.name(), .kind = {}, .problem = {}};
  try {
    check_source(source, foreign, finding);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    finding.problem = error.what();
  }
  return finding;
}

std::vector<Finding> validate(const fs::path& path, const ForeignReader& foreign) {
  if (!is_folder(path)) return {check(path, foreign)};
  try {
    return check_folder(path, foreign);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& problem) {
    return {{.path = path.string(), .kind = {}, .problem = problem.what()}};
  }
}

}  // namespace mapproof
