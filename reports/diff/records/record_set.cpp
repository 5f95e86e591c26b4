#include "reports/diff/records/record_set.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/input_file.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_document.hpp"
#include "core/json/record_writer.hpp"
#include "core/records/maps/map_json.hpp"
#include "core/records/observations/input_kind.hpp"
#include "core/records/studies/slam_store.hpp"
#include "core/studies/study_kind.hpp"
#include "reports/model/label_text.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::array kParts = {"study.json",    "parts",    "runs",        "maps",
                               "details",       "paths",    "convergence", "histories.json",
                               "space.json",    "map.json", "map.csv",     "slam.json",
                               "landmarks.csv", "path.csv", "path.tum",    "results.csv"};

bool is_kept_in(const fs::path& file) {
  const fs::path extension = file.extension();
  return extension == ".json" || extension == ".csv" || extension == ".tum";
}

/// Reads up to `to.size()` bytes, fewer only at the end.
std::size_t read_block(const Descriptor& file, std::string& to, const std::string& name) {
  std::size_t count = 0;
  while (const std::size_t got = read_some(file, std::span(to).subspan(count), name)) count += got;
  return count;
}

/// Whether a study.json exists, readable or not.
bool has_study(const fs::path& folder) {
  std::error_code error;
  return fs::exists(fs::symlink_status(folder / "study.json", error));
}

/// The JSON file of a map or of one log's result: the path itself, or the file in its folder.
fs::path single_file(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return path;
  for (const char* name : {"map.json", "slam.json"})
    if (fs::is_regular_file(path / name, error)) return path / name;
  return {};
}

/// Whether a file is the JSON of a map or of one log's result, by its schema.
bool is_single(const fs::path& file) {
  try {
    ByteSource source(file);
    const std::string schema = is_json(source) ? json_schema(source) : "";
    return schema == "mapproof.map" || schema == "mapproof.slam_run";
  } catch (const IoError&) {
    return false;
  }
}

/// All values of a JSON document as text, by pointer; an array of plain values is one value.
void add_settings(RecordSet& set, const fs::path& study) {
  const nlohmann::json root = parse_json(read_file(study), study.string()).tree();
  for (auto& [pointer, text] : flattened(root.contains("experiment") ? root["experiment"] : root))
    set.settings[pointer] = std::move(text);
  const auto seed = set.settings.find("/seed");
  if (seed != set.settings.end()) set.seed = seed->second;
}

void add_family(RecordSet& set, const Results& results, const Result& row) {
  const auto family = results.families.find(row.method);
  if (family != results.families.end())
    set.families[series_name(row.at, row.method, row.subject)] = {
        series_name(row.at, family->second.name, row.subject), family->second.parameter};
}

std::string level_words(const StudyLabels& labels, const Level& level) {
  if (level.factor == kStepsFactor) return level_text(level) + " steps";
  return shown_level(labels, level.factor, level_text(level)).words();
}

/// series_name() in the words of figures.
SubjectLabel subject_label(const StudyContents& contents, const Result& row) {
  const auto setup = contents.labels.setups.find(row.at.setup);
  SubjectLabel label;
  const auto add = [&](const std::string& part) {
    if (!part.empty()) label.push_back(part);
  };
  add(setup == contents.labels.setups.end() ? std::string(row.at.setup) : setup->second);
  add(method_text(contents.labels, row.method));
  const std::vector<Level>& levels = row.at.levels;
  for (const Level& level : levels) add(level_words(contents.labels, level));
  add(row.subject);
  return label;
}

RecordSet set_of(StudyContents contents) {
  RecordSet set;
  const std::vector<Result>& rows = contents.results.rows;
  for (auto first = rows.begin(); first != rows.end();) {
    const auto end = std::find_if(first, rows.end(), [&](const Result& row) {
      return row.at != first->at || row.method != first->method ||
             row.quantity != first->quantity || row.subject != first->subject;
    });
    const std::string subject = series_name(first->at, first->method, first->subject);
    if (!set.labels.contains(subject)) set.labels[subject] = subject_label(contents, *first);
    ValuesByRun& values = set.values[{subject, first->quantity}];
    if (values.empty()) values.reserve(static_cast<std::size_t>(end - first));
    add_family(set, contents.results, *first);
    for (; first != end; ++first) values[run_in_name(first->at, first->run)] = first->value;
  }
  contents.results.rows = {};
  for (const RunOutcome& outcome : contents.results.outcomes)
    set.statuses[record_name(outcome.at, outcome.method, outcome.run)] =
        fmt::format("{}", fmt::join(outcome.codes, ", "));
  set.kind = std::move(contents.kind);
  set.provenance = std::move(contents.provenance);
  set.quantities = std::move(contents.results.quantities);
  set.repeats = contents.results.are_repeats;
  set.draws_groups = contents.draws_groups;
  set.runs = std::move(contents.runs);
  set.worlds = std::move(contents.worlds);
  set.anchors = std::move(contents.anchors);
  set.points = std::move(contents.points);
  set.problems = std::move(contents.problems);
  return set;
}

/// Below the two locations, or "" where they are files.
using EqualFiles = std::set<fs::path>;

/// Those that both sides have with equal bytes. Found once, so that both leave out the same: one
/// that could not be opened here is read on both.
EqualFiles equal_files(const fs::path& a, const fs::path& b) {
  EqualFiles equal;
  if (same_bytes(a, b)) equal.insert("");
  for (const fs::path& file : record_files(a))
    if (same_bytes(a / file, b / file)) equal.insert(file);
  return equal;
}

RecordSet read_study_set(const fs::path& folder, const EqualFiles& equal) {
  const auto differs = [&](const fs::path& file) {
    return !equal.contains(file.lexically_relative(folder));
  };
  RecordSet set = set_of(read_study_contents(folder, {.maps = differs, .keeps_on = true}));
  add_settings(set, folder / "study.json");
  return set;
}

RecordSet read_single(const fs::path& file) {
  const std::string text = read_input(file);
  const std::string source = file.string();
  const std::string schema = schema_of(parse_json(text, source).cursor()).name;
  if (schema == "mapproof.slam_run") return set_of(contents_of(parse_slam_run(text, source)));
  if (schema != "mapproof.map")
    throw IoError(source, "does not hold records; its schema is " + schema);
  const MapRecord map = parse_map(text, source);
  StudyContents contents = contents_of(map);
  // There is one map, whatever its input was: the number of steps is a setting.
  for (Result& row : contents.results.rows) row.at.levels = {};
  for (RunOutcome& outcome : contents.results.outcomes) outcome.at.levels = {};
  RecordSet set = set_of(std::move(contents));
  set.settings["/steps"] = std::to_string(map.step);
  set.called[map.id] = set.values.begin()->first.subject;
  set.settings["/method"] = method_label(map);
  return set;
}

/// Whether all content of a file is compared as settings, results and points.
bool is_compared(const fs::path& file) {
  return file == "study.json" || file == "results.csv" || file.parent_path() == "parts";
}

/// Lists the files that differ from those of the other side.
void add_others(RecordSet& set, const fs::path& folder, const EqualFiles& equal) {
  for (const fs::path& file : record_files(folder))
    if (!is_compared(file) && !equal.contains(file))
      set.others[file.generic_string()] = folder / file;
}

RecordSet read_side(const fs::path& path, const EqualFiles& equal) {
  std::error_code error;
  RecordSet set;
  if (has_study(path)) {
    set = read_study_set(path, equal);
  } else {
    const fs::path file = single_file(path);
    if (file.empty()) throw IoError(path.string(), "holds no records");
    set = read_single(file);
  }
  if (fs::is_directory(path, error))
    add_others(set, path, equal);
  else if (!equal.contains(""))
    set.others[""] = path;
  return set;
}

}  // namespace

std::string label_text(const SubjectLabel& label) {
  return fmt::format("{}", fmt::join(label, ", "));
}

std::optional<fs::path> folder_of_record(const fs::path& root, const fs::path& file) {
  for (fs::path folder = file.parent_path();; folder = folder.parent_path()) {
    const fs::path inner = folder.empty() ? file : file.lexically_relative(folder);
    if (std::ranges::find(kParts, *inner.begin()) != kParts.end() && holds_records(root / folder))
      return folder;
    if (folder.empty()) return std::nullopt;
  }
}

std::vector<fs::path> record_files(const fs::path& location) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const char* part : kParts) {
    const fs::path path = location / part;
    if (!fs::is_directory(path, error)) {
      if (fs::exists(fs::symlink_status(path, error))) files.emplace_back(part);
      continue;
    }
    for (fs::recursive_directory_iterator entry(path, error), end; !error && entry != end;
         entry.increment(error)) {
      std::error_code unknown;
      if (!entry->is_directory(unknown) && is_kept_in(entry->path()))
        files.push_back(entry->path().lexically_relative(location));
    }
    if (error) throw IoError(path.string(), "cannot be listed: " + error.message());
  }
  std::ranges::sort(files);
  return files;
}

bool same_bytes(const fs::path& a, const fs::path& b) {
  std::error_code error;
  const auto size = fs::file_size(a, error);
  if (error || size != fs::file_size(b, error) || error) return false;
  try {
    const Descriptor first = open_input(a), second = open_input(b);
    std::string block(1 << 16, '\0'), other(1 << 16, '\0');
    for (std::size_t count = block.size(); count == block.size();) {
      count = read_block(first, block, a.string());
      if (read_block(second, other, b.string()) != count ||
          block.compare(0, count, other, 0, count) != 0)
        return false;
    }
    return true;
  } catch (const IoError&) {
    return false;  // Measured it reports the reason.
  }
}

bool holds_records(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return has_study(path) || !single_file(path).empty();
  return is_single(path);
}

RecordSets read_records(const fs::path& baseline, const fs::path& current) {
  const EqualFiles equal = equal_files(baseline, current);
  return {.baseline = read_side(baseline, equal), .current = read_side(current, equal)};
}

}  // namespace mapproof
