#include "core/records/studies/results_study_json.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/json/record_reader.hpp"
#include "core/json/record_writer.hpp"
#include "core/json/text_input.hpp"
#include "core/records/evaluations/pose_errors_csv.hpp"
#include "core/records/maps/map_csv.hpp"
#include "core/records/observations/trajectories.hpp"
#include "core/records/studies/results_table.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/records/studies/study_store.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// How many poses of the one lie within the time of the other.
Eigen::Index poses_within(const Trajectory& ground_truth, const Trajectory& path) {
  const auto is_within = ground_truth.time_s.array() >= path.time_s(0) &&
                         ground_truth.time_s.array() <= path.time_s(path.size() - 1);
  return is_within.count();
}

constexpr std::string_view kGroundTruth = ".groundtruth";

/// The files with that extension in a folder, or all if it is empty, in ascending order; none if
/// the folder is not there.
std::vector<fs::path> files_in(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (extension.empty() || entry->path().extension() == extension) files.push_back(entry->path());
  std::ranges::sort(files);
  return files;
}

constexpr const char* kErrors = "errors";

/// errors/RUN, hidden ones left out.
std::vector<fs::path> error_folders(const fs::path& folder) {
  std::vector<fs::path> folders;
  for (const fs::path& run : files_in(folder / kErrors, ""))
    if (fs::is_directory(run) && !run.filename().string().starts_with('.')) folders.push_back(run);
  return folders;
}

std::vector<fs::path> error_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::path& run : error_folders(folder))
    for (const fs::path& file : files_in(run, ".csv")) files.push_back(file);
  return files;
}

std::string not_read(const fs::path& below, const fs::path& file, std::string_view read) {
  return fmt::format("{}/{}: is not read: {}", below.generic_string(),
                     printable(file.filename().string()), read);
}

bool is_hidden(const fs::path& file) { return file.filename().string().starts_with('.'); }

}  // namespace

ResultsStudy parse_results_study(std::string_view text, const std::string& source) {
  return from_json_text<ResultsHead>(text, source).study;
}

ResultsStudy read_results_study(const fs::path& folder) {
  require_study(folder);
  const std::string head = (folder / "study.json").string();
  const std::string table = (folder / "results.csv").string();
  ResultsStudy study = parse_results_study(read_file(head), head);
  study.results.rows = read_results_csv(table, study.results.quantities);
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
  const Alignment alignment =
      alignment_of(from_json_text<ResultsHead>(read_file(head), head).alignment);
  for (const fs::path& file : files_in(folder / "paths", ".tum")) {
    std::error_code error;
    const fs::path stem = file.parent_path() / file.stem();
    if (stem.extension() == kGroundTruth) {
      const std::string path = fs::path(stem).replace_extension().string() + ".tum";
      if (!fs::exists(path, error)) throw IoError(file.string(), "there is no path " + path);
      continue;
    }
    GivenPath path{.id = file.stem().string(),
                   .path = parse_trajectory_tum(read_file(file), file.string())};
    const fs::path ground_truth = stem.string() + std::string(kGroundTruth) + ".tum";
    if (fs::exists(ground_truth, error)) {
      path.ground_truth = parse_trajectory_tum(read_file(ground_truth), ground_truth.string());
      path.alignment = alignment;
      if (alignment != Alignment::kNone && poses_within(*path.ground_truth, path.path) < 2)
        throw IoError(file.string(),
                      "cannot be aligned: fewer than 2 poses of its ground truth are of its time");
    }
    paths.push_back(std::move(path));
  }
  return paths;
}

std::vector<PathErrors> read_path_errors(const fs::path& folder) {
  std::vector<PathErrors> all;
  for (const fs::path& file : error_files(folder)) {
    const std::string text = read_file(file);
    all.push_back(
        {.run = file.parent_path().filename().string(),
         .method = file.stem().string(),
         .poses = parse_pose_errors_csv(checked_text(text, file.string()), file.string())});
  }
  return all;
}

std::string results_study_json(const ResultsStudy& study) {
  ResultsHead head;
  head.study = study;
  return to_json_text(head);
}

std::vector<fs::path> results_study_files(const fs::path& folder) {
  std::vector<fs::path> files = {"study.json", "results.csv"};
  for (const auto& [below, extension] : {std::pair("maps", ".csv"), std::pair("paths", ".tum")})
    for (const fs::path& file : files_in(folder / below, extension))
      files.push_back(below / file.filename());
  for (const fs::path& file : error_files(folder))
    files.push_back(kErrors / file.parent_path().filename() / file.filename());
  return files;
}

std::vector<std::string> passed_over_files(const fs::path& folder) {
  std::vector<std::string> remarks;
  for (const auto& [below, extension, read] :
       {std::tuple("maps", ".csv", "a map is maps/NAME.csv"),
        std::tuple("paths", ".tum", "a path is paths/NAME.tum")})
    for (const fs::path& file : files_in(folder / below, ""))
      if (file.extension() != extension && !is_hidden(file))
        remarks.push_back(not_read(below, file, read));
  constexpr std::string_view kRead = "errors of poses are errors/RUN/METHOD.csv";
  for (const fs::path& run : files_in(folder / kErrors, ""))
    if (!fs::is_directory(run) && !is_hidden(run)) remarks.push_back(not_read(kErrors, run, kRead));
  for (const fs::path& run : error_folders(folder))
    for (const fs::path& file : files_in(run, ""))
      if (file.extension() != ".csv" && !is_hidden(file))
        remarks.push_back(not_read(kErrors / run.filename(), file, kRead));
  return remarks;
}

bool is_results_study(const fs::path& folder) { return study_schema(folder) == kResultsStudy; }

}  // namespace mapproof
