#include <algorithm>
#include <charconv>
#include <system_error>
#include <tuple>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/json/json_cursor.hpp"
#include "core/records/run_json.hpp"
#include "core/records/study_files.hpp"
#include "core/records/study_store.hpp"
#include "core/records/timings_jsonl.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

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

std::optional<RunId> run_of_file(const fs::path& file) {
  const std::string name = file.filename().string();
  RunId run;
  const char* end = name.data() + name.size();
  constexpr std::string_view kLayout = "layout-";
  constexpr std::string_view kPose = "-pose-";
  if (!name.starts_with(kLayout)) return std::nullopt;
  const char* at = std::from_chars(name.data() + kLayout.size(), end, run.layout).ptr;
  if (!std::string_view(at, end).starts_with(kPose)) return std::nullopt;
  std::from_chars(at + kPose.size(), end, run.pose);
  if (name != slug(run) + ".json") return std::nullopt;
  return run;
}

bool contains(const Experiment& experiment, const RunId& run) {
  return run.layout >= 1 && run.layout <= experiment.layouts && run.pose >= 1 &&
         run.pose <= experiment.poses;
}

std::vector<RunId> StudyFiles::listed_runs() const {
  std::vector<RunId> listed;
  std::error_code error;
  if (!fs::exists(runs(), error)) return listed;
  for (fs::directory_iterator entry(runs(), error), end; !error && entry != end;
       entry.increment(error))
    if (const auto run = run_of_file(entry->path())) listed.push_back(*run);
  if (error) throw IoError(runs().string(), "cannot be listed: " + error.message());
  std::ranges::sort(listed);
  return listed;
}

bool is_study(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(StudyFiles{folder}.study(), error);
}

std::string study_schema(const fs::path& folder) {
  if (!is_study(folder)) return "";
  const fs::path path = StudyFiles{folder}.study();
  return schema_of(parse_json(read_file(path), path.string()).cursor()).name;
}

Study read_study(const fs::path& folder) {
  const StudyFiles files{folder};
  std::error_code error;
  if (!fs::exists(folder, error)) throw IoError(folder.string(), "does not exist");
  if (!is_study(folder)) throw IoError(folder.string(), "holds no study: study.json is missing");
  Study study = parse_study(read_file(files.study()), files.study().string());
  for (const RunId& id : files.listed_runs()) {
    const std::string path = files.run(id).string();
    if (!contains(study.experiment, id))
      throw IoError(path,
                    fmt::format("is no run of the experiment, which has {} layouts x {} poses",
                                study.experiment.layouts, study.experiment.poses));
    study.runs.push_back(parse_run(read_file(path), path));
    if (study.runs.back().id != id)
      throw IoError(path, "/run", "says that it is " + slug(study.runs.back().id));
  }
  return study;
}

std::optional<RunDetails> read_details(const fs::path& folder, const RunId& run) {
  const fs::path path = StudyFiles{folder}.detail(run);
  std::error_code error;
  if (!fs::exists(path, error)) return std::nullopt;
  RunDetails details = parse_details(read_file(path), path.string());
  if (details.id != run)
    throw IoError(path.string(), "/run", "says that it is " + slug(details.id));
  return details;
}

std::vector<MapRecord> read_maps(const fs::path& folder, const RunId& run) {
  const std::string path = StudyFiles{folder}.map(run).string();
  RunMaps maps = parse_maps(read_file(path), path);
  if (maps.run != run) throw IoError(path, "/run", "says that it is " + slug(maps.run));
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
