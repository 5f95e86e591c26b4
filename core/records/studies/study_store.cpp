#include "core/records/studies/study_store.hpp"

#include <algorithm>
#include <system_error>
#include <tuple>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/json/record_writer.hpp"
#include "core/records/experiments/experiment_json.hpp"
#include "core/records/studies/run_json.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/records/studies/timings_jsonl.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

StudyHead read_study_head(const std::string& text, const std::string& source) {
  const Study study = parse_study(text, source);
  return {.experiment = to_json_value(study.experiment).dump(),
          .solver_digest = study.provenance.solver_digest,
          .method_files = study.provenance.method_files};
}

Timings read_timings_file(const fs::path& folder) {
  const fs::path path = StudyFiles{folder}.timings();
  std::error_code error;
  if (!fs::exists(path, error)) return {};
  return parse_timings(read_file(path), path.string());
}

auto piece(const Timing& timing) {
  return std::tuple(timing.run, timing.sensor, timing.setting.method,
                    timing.setting.parameter.value_or(0.0), timing.step);
}

}  // namespace

StudyStart study_start(const Experiment& experiment, const Provenance& provenance) {
  return {.text = study_json(experiment, provenance),
          .read_head = read_study_head,
          .records = StudyFiles{}.records()};
}

StudyPart part_of(const RunResult& result) {
  const StudyFiles files{};
  const RunId& id = result.run.id;
  StudyPart part;
  part.files = {{files.map(id), maps_json({.run = id, .maps = result.maps})},
                {files.detail(id), details_json(result.details)},
                {files.run(id), run_json(result.run)}};
  for (const Timing& timing : result.timings) part.timings += timing_line(timing);
  return part;
}

bool holds_run(const fs::path& folder, const RunId& id) {
  const StudyFiles files{folder};
  try {
    const std::string run = files.run(id).string();
    const std::string maps = files.map(id).string();
    const std::string details = files.detail(id).string();
    return parse_run(read_file(run), run).id == id && parse_maps(read_file(maps), maps).run == id &&
           parse_details(read_file(details), details).id == id;
  } catch (const IoError&) {
    return false;
  }
}

Study read_study(const fs::path& folder) {
  const StudyFiles files{folder};
  require_study(folder);
  Study study = parse_study(read_file(files.study()), files.study().string());
  for (const RunId& id : files.listed_runs()) {
    const std::string path = files.run(id).string();
    if (!contains(study.experiment, id))
      throw IoError(path,
                    fmt::format("is not a run of the experiment, which has {} layouts x {} poses",
                                study.experiment.layouts, study.experiment.poses));
    study.runs.push_back(parse_run(read_file(path), path));
    if (study.runs.back().id != id)
      throw IoError(path, "/run", "states that it is " + slug(study.runs.back().id));
  }
  return study;
}

std::optional<RunDetails> read_details(const fs::path& folder, const RunId& run) {
  const fs::path path = StudyFiles{folder}.detail(run);
  std::error_code error;
  if (!fs::exists(path, error)) return std::nullopt;
  RunDetails details = parse_details(read_file(path), path.string());
  if (details.id != run)
    throw IoError(path.string(), "/run", "states that it is " + slug(details.id));
  return details;
}

std::vector<MapRecord> read_maps(const fs::path& folder, const RunId& run) {
  const std::string path = StudyFiles{folder}.map(run).string();
  RunMaps maps = parse_maps(read_file(path), path);
  if (maps.run != run) throw IoError(path, "/run", "states that it is " + slug(maps.run));
  return std::move(maps.maps);
}

std::vector<Timing> read_timings(const fs::path& folder) {
  std::vector<Timing> all = read_timings_file(folder).maps;
  std::ranges::stable_sort(all, {}, piece);
  std::vector<Timing> last;
  for (const Timing& timing : all) {
    if (!last.empty() && piece(last.back()) == piece(timing)) last.pop_back();
    last.push_back(timing);
  }
  return last;
}

std::vector<Session> read_sessions(const fs::path& folder) {
  return read_timings_file(folder).sessions;
}

}  // namespace mapproof
