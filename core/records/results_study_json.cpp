#include "core/records/results_study_json.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/text_input.hpp"
#include "core/records/map_csv.hpp"
#include "core/records/quantity_values.hpp"
#include "core/records/results_table.hpp"
#include "core/records/study_store.hpp"
#include "core/records/trajectory_files.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostLabels = 10'000;  ///< Quantities, setups, methods, factors.
constexpr std::size_t kLongestStudyName = 100;

bool is_study_name(std::string_view name) {
  const auto is_in = [&](std::string_view known) {
    return name.find_first_not_of(known) == std::string_view::npos;
  };
  return !name.empty() && name.front() >= 'a' && name.front() <= 'z' &&
         is_in("abcdefghijklmnopqrstuvwxyz0123456789-");
}

std::vector<Label> read_labels(const JsonCursor& list, bool has_unit) {
  std::vector<Label> labels;
  std::set<std::string> ids;
  for (const JsonCursor& value : list.elements(0, kMostLabels)) {
    if (has_unit)
      value.allow_only({"id", "label", "unit"});
    else
      value.allow_only({"id", "label"});
    Label label{.id = value.at("id").text(1000), .label = value.at("label").text(1000)};
    if (label.label.empty()) value.at("label").fail("is empty");
    if (const auto unit = value.find("unit")) label.unit = unit->text(kLongestStudyName);
    if (!ids.insert(label.id).second) value.at("id").fail("is there twice");
    labels.push_back(std::move(label));
  }
  return labels;
}

void read_quantities(const JsonCursor& list, ResultsStudy& study) {
  for (const JsonCursor& value : list.elements(0, kMostLabels)) {
    const Quantity quantity = read_quantity(value);
    if (std::ranges::find(study.quantities, quantity.id) != study.quantities.end())
      value.at("id").fail("is there twice");
    study.quantities.push_back(quantity.id);
    study.results.quantities.declare(quantity);
  }
}

/// How paths are aligned to their ground truths.
Alignment read_alignment(const JsonCursor& paths) {
  paths.allow_only({"align"});
  const auto alignment = alignment_named(paths.at("align").text());
  if (!alignment || *alignment == Alignment::kRigidWithReflection)
    paths.at("align").fail("expected none, rigid or similarity");
  return *alignment;
}

/// How many poses of the one lie within the time of the other.
Eigen::Index poses_within(const Trajectory& truth, const Trajectory& path) {
  const auto is_within = truth.time_s.array() >= path.time_s(0) &&
                         truth.time_s.array() <= path.time_s(path.size() - 1);
  return is_within.count();
}

constexpr std::string_view kTruth = ".truth";

/// The files with that extension in a folder, in ascending order; none if it is not there.
std::vector<fs::path> files_in(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == extension) files.push_back(entry->path());
  std::ranges::sort(files);
  return files;
}

}  // namespace

ResultsStudy parse_results_study(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  const JsonCursor value = document.cursor();
  expect_schema(value, kResultsStudy);
  value.allow_only({"schema", "name", "title", "question", "command", "quantities", "setups",
                    "methods", "factors", "runs_are_repeats", "paths"});
  ResultsStudy study;
  study.name = "results";
  if (const auto name = value.find("name")) {
    study.name = name->text(kLongestStudyName);
    if (!is_study_name(study.name))
      name->fail("expected lower-case letters, digits and '-', a letter first");
  }
  study.title = value.at("title").text(1000);
  if (study.title.empty()) value.at("title").fail("is empty");
  if (const auto question = value.find("question")) study.question = question->text();
  if (const auto command = value.find("command")) study.command = command->text();
  if (const auto list = value.find("quantities")) read_quantities(*list, study);
  if (const auto list = value.find("setups")) study.setups = read_labels(*list, false);
  if (const auto list = value.find("methods")) study.methods = read_labels(*list, false);
  if (const auto list = value.find("factors")) study.factors = read_labels(*list, true);
  if (const auto paths = value.find("paths")) read_alignment(*paths);
  study.results.are_repeats = true;
  if (const auto repeats = value.find("runs_are_repeats"))
    study.results.are_repeats = repeats->boolean();
  return study;
}

ResultsStudy read_results_study(const fs::path& folder) {
  if (!is_study(folder)) throw IoError(folder.string(), "holds no study: study.json is missing");
  const std::string head = (folder / "study.json").string();
  const std::string table = (folder / "results.csv").string();
  ResultsStudy study = parse_results_study(read_file(head), head);
  study.results.rows = parse_results_csv(read_file(table), table, study.results.quantities);
  if (study.results.rows.empty()) throw IoError(table, "has no row");
  if (const std::string unused = complete(study); !unused.empty())
    throw IoError(head, fmt::format("{}: results.csv has no row of it", unused));
  return study;
}

std::vector<MapRecord> read_given_maps(const fs::path& folder) {
  std::vector<MapRecord> maps;
  for (const fs::path& file : files_in(folder / "maps", ".csv")) {
    const std::string text = read_file(file);
    MapRecord map = parse_map_csv(checked_text(text, file.string()), file.string());
    map.id = file.stem().string();
    maps.push_back(std::move(map));
  }
  return maps;
}

std::vector<GivenPath> read_given_paths(const fs::path& folder) {
  std::vector<GivenPath> paths;
  const std::string head = (folder / "study.json").string();
  const JsonDocument study = parse_json(read_file(head), head);
  const auto asked = study.cursor().find("paths");
  const Alignment alignment = asked ? read_alignment(*asked) : Alignment::kNone;
  for (const fs::path& file : files_in(folder / "paths", ".tum")) {
    std::error_code error;
    const fs::path stem = file.parent_path() / file.stem();
    if (stem.extension() == kTruth) {
      const std::string path = fs::path(stem).replace_extension().string() + ".tum";
      if (!fs::exists(path, error)) throw IoError(file.string(), "there is no path " + path);
      continue;
    }
    GivenPath path{.id = file.stem().string(),
                   .path = parse_trajectory_tum(read_file(file), file.string())};
    const fs::path truth = stem.string() + std::string(kTruth) + ".tum";
    if (fs::exists(truth, error)) {
      path.truth = parse_trajectory_tum(read_file(truth), truth.string());
      path.alignment = alignment;
      if (alignment != Alignment::kNone && poses_within(*path.truth, path.path) < 2)
        throw IoError(file.string(),
                      "cannot be aligned: fewer than 2 poses of its ground truth are of its time");
    }
    paths.push_back(std::move(path));
  }
  return paths;
}

std::vector<fs::path> results_study_files(const fs::path& folder) {
  std::vector<fs::path> files = {"study.json", "results.csv"};
  for (const auto& [below, extension] : {std::pair("maps", ".csv"), std::pair("paths", ".tum")})
    for (const fs::path& file : files_in(folder / below, extension))
      files.push_back(below / file.filename());
  return files;
}

bool is_results_study(const fs::path& folder) { return study_schema(folder) == kResultsStudy; }

}  // namespace mapproof
