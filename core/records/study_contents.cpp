#include "core/records/study_contents.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/json/json_cursor.hpp"
#include "core/records/results_of.hpp"
#include "core/records/results_study_json.hpp"
#include "core/records/run_json.hpp"
#include "core/records/slam_store.hpp"
#include "core/records/study_files.hpp"
#include "core/records/study_store.hpp"
#include "core/records/trial_json.hpp"
#include "core/records/trial_store.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

PlacedPoints placed(const MapRecord& map) {
  return {.quantity = map.frame == Frame::kTruth ? "landmark_m" : "landmark_shape",
          .frame = map.frame,
          .names = map.names,
          .points = map.estimate,
          .truth = map.truth_m};
}

PlacedPoints placed_path(const Points& positions_m) {
  return {.quantity = "path_m",
          .frame = Frame::kTruth,
          .names = {},
          .points = positions_m,
          .truth = std::nullopt};
}

/// Runs `read`; where reading keeps on, trouble with the file is noted.
template <typename Read>
void try_file(StudyContents& contents, const fs::path& folder, const fs::path& file,
              const ContentsAsked& asked, Read read) {
  try {
    read();
  } catch (const IoError& error) {
    if (!asked.keeps_on) throw;
    contents.problems.push_back({file.lexically_relative(folder).generic_string(), error.what()});
  }
}

Run read_run(const fs::path& file, const RunId& id) {
  Run run = parse_run(read_file(file), file.string());
  if (run.id != id) throw IoError(file.string(), "/run", "says that it is " + slug(run.id));
  return run;
}

void add_world(StudyContents& contents, const Run& run) {
  const std::string id = slug(run.id);
  contents.runs[id] = fmt::format("layout-{}", run.id.layout);
  contents.worlds[id].points = run.world.landmarks_m;
  for (const Eigen::Index anchor : run.anchors) contents.anchors[id] += fmt::format(" {}", anchor);
}

void read_mapping(const fs::path& folder, const std::string& text, const ContentsAsked& asked,
                  StudyContents& contents) {
  const StudyFiles files{folder};
  Study study = parse_study(text, files.study().string());
  contents.provenance = study.provenance;
  for (const RunId& id : files.listed_runs()) {
    contents.runs[slug(id)] = "";
    try_file(contents, folder, files.run(id), asked, [&] {
      if (!asked.keeps_on && !contains(study.experiment, id))
        throw IoError(files.run(id).string(), "is no run of the experiment");
      study.runs.push_back(read_run(files.run(id), id));
      add_world(contents, study.runs.back());
    });
    std::error_code error;
    if (asked.maps && fs::exists(files.map(id), error) && asked.maps(files.map(id)))
      try_file(contents, folder, files.map(id), asked, [&] {
        for (const MapRecord& map : parse_maps(read_file(files.map(id)), files.map(id)).maps)
          contents.points[map.id] = placed(map);
      });
  }
  contents.results = results_of(study);
  if (asked.seconds) contents.seconds = seconds_of(read_timings(folder));
}

void add_log(StudyContents& contents, const SlamRun& run) {
  contents.runs[run.id] = run.id;
  for (const SlamRecord& record : run.records) {
    const std::string id =
        record_name(condition(run.id), std::string(info(record.method).name), run.id);
    contents.points[id] = {.quantity = "landmark_m",
                           .frame = Frame::kTruth,
                           .names = run.log.landmarks,
                           .points = record.estimate.landmarks_m,
                           .truth = run.log.true_landmarks};
    contents.points[id + "/path"] = placed_path(record.estimate.path.positions_m);
  }
  if (run.log.truth) contents.worlds[run.id] = placed_path(run.log.truth->positions_m);
}

void read_ranges(const fs::path& folder, const std::string&, const ContentsAsked& asked,
                 StudyContents& contents) {
  const SlamStudy study = read_slam_study(folder);
  contents.provenance = study.provenance;
  for (const SlamRun& run : study.runs) add_log(contents, run);
  if (study.histories)
    for (const RangeHistoryMap& map : study.histories->maps)
      contents.points[record_name(condition(map.squared ? "histories/squared" : "histories/range"),
                                  map.setting ? slug(*map.setting) : "spectral", "")] = {
          .quantity = "landmark_m",
          .frame = Frame::kTruth,
          .names = {},
          .points = map.positions_m,
          .truth = study.histories->landmarks_m};
  contents.results = results_of(study);
  if (asked.seconds) contents.seconds = seconds_of(read_slam_timings(folder));
}

/// The parts' files in the folder, whatever their order.
std::vector<fs::path> part_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder / "parts", error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == ".json") files.push_back(entry->path());
  std::ranges::sort(files);
  return files;
}

void read_trials(const fs::path& folder, const std::string& text, const ContentsAsked& asked,
                 StudyContents& contents) {
  TrialStudy study = parse_trial_study(text, (folder / "study.json").string());
  contents.provenance = study.provenance;
  for (const fs::path& path : part_files(folder)) {
    contents.runs[path.stem().string()] = "";
    try_file(contents, folder, path, asked, [&] {
      TrialPart part = parse_trial_part(read_file(path), path.string(), &study.design).part;
      if (part.id != path.stem().string())
        throw IoError(path.string(), "/id", "says that it is " + part.id);
      contents.runs[part.id] = part.run ? fmt::format("layout-{}", part.run->layout) : part.id;
      if (asked.maps && asked.maps(path))
        for (const TrialMap& map : part.maps)
          contents.points[part.id + "/" + map.id] = placed(map.map);
      study.parts.push_back(std::move(part));
    });
  }
  contents.results = results_of(study);
  if (asked.seconds) contents.seconds = seconds_of(read_trial_study(folder));
}

void read_table(const fs::path& folder, const std::string&, const ContentsAsked& asked,
                StudyContents& contents) {
  ResultsStudy study = read_results_study(folder);
  for (const Result& row : study.results.rows) contents.runs[row.run] = row.group;
  contents.results = std::move(study.results);
  if (!asked.maps) return;
  try_file(contents, folder, folder / "maps", asked, [&] {
    for (const MapRecord& map : read_given_maps(folder))
      contents.points["maps/" + map.id] = placed(map);
  });
  try_file(contents, folder, folder / "paths", asked, [&] {
    for (const GivenPath& path : read_given_paths(folder))
      contents.points["paths/" + path.id] = placed_path(path.path.positions_m);
  });
}

/// One kind of study: the schema of its study.json, and what reads it.
struct StudyKind {
  std::string_view schema;
  void (*read)(const fs::path& folder, const std::string& text, const ContentsAsked& asked,
               StudyContents& contents);
};

constexpr std::array kKinds = {
    StudyKind{"mapproof.study", read_mapping}, StudyKind{"mapproof.slam_study", read_ranges},
    StudyKind{"mapproof.trial_study", read_trials}, StudyKind{kResultsStudy, read_table}};

}  // namespace

StudyContents read_study_contents(const fs::path& folder, const ContentsAsked& asked) {
  const std::string source = (folder / "study.json").string();
  const std::string text = read_file(source);
  StudyContents contents;
  contents.kind = schema_of(parse_json(text, source).cursor()).name;
  const auto kind = std::ranges::find(kKinds, contents.kind, &StudyKind::schema);
  if (kind == kKinds.end())
    throw IoError(source, "/schema/name", "is no study: \"" + printable(contents.kind) + "\"");
  kind->read(folder, text, asked, contents);
  return contents;
}

StudyContents contents_of(const MapRecord& map) {
  StudyContents contents;
  contents.kind = "mapproof.map";
  contents.results = results_of(map);
  contents.runs[""] = "";
  contents.points[map.id] = placed(map);
  return contents;
}

StudyContents contents_of(const SlamRun& run) {
  StudyContents contents;
  contents.kind = "mapproof.slam_run";
  contents.results = results_of(run);
  add_log(contents, run);
  return contents;
}

}  // namespace mapproof
