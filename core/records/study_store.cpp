#include "core/records/study_store.hpp"

#include <algorithm>
#include <mutex>
#include <system_error>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/records/experiment_json.hpp"
#include "core/records/experiment_values.hpp"
#include "core/records/folder_lock.hpp"
#include "core/records/run_json.hpp"
#include "core/records/study_files.hpp"
#include "core/records/timings_jsonl.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// "/seed is 2007 there and 2008 here": the first of the differences.
std::string difference(const Experiment& there, const Experiment& here) {
  const nlohmann::json old_value = experiment_value(there);
  const nlohmann::json new_value = experiment_value(here);
  const nlohmann::json patch = nlohmann::json::diff(old_value, new_value);
  const nlohmann::json::json_pointer place(patch.at(0).at("path").get<std::string>());
  const auto shown = [&](const nlohmann::json& value) {
    return value.contains(place) ? printable(value[place].dump(), 60) : "missing";
  };
  return fmt::format("{} is {} there and {} here", place.to_string(), shown(old_value),
                     shown(new_value));
}

void remove_tree(const fs::path& path) {
  std::error_code error;
  fs::remove_all(path, error);
  if (error) throw IoError(path.string(), "cannot be removed: " + error.message());
}

/// The runs first: until study.json is replaced, a kill in between leaves the old study's start.
void remove_runs(const StudyFiles& files) {
  remove_tree(files.runs());
  remove_tree(files.maps());
  remove_tree(files.details());
  remove_tree(files.timings());
}

void check_is_new(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (!is_leftover(entry->path()))
      throw IoError(folder.string(), "is not empty and holds no study; choose another folder");
  if (error) throw IoError(folder.string(), "cannot be listed: " + error.message());
}

/// Whether the run's files are all there, whole, and of that run.
bool is_whole(const StudyFiles& files, const RunId& id) {
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

}  // namespace

struct StudyStore::State {
  State(const fs::path& folder, const Experiment& study)
      : files{folder}, experiment(study), lock(folder) {}

  StudyFiles files;
  Experiment experiment;
  FolderLock lock;
  bool is_redone = false;
  std::mutex timings_mutex;
};

StudyStore::StudyStore(std::unique_ptr<State> state) : state_(std::move(state)) {}
StudyStore::StudyStore(StudyStore&&) noexcept = default;
StudyStore& StudyStore::operator=(StudyStore&&) noexcept = default;
StudyStore::~StudyStore() = default;

StudyStore StudyStore::open(const fs::path& folder, const Experiment& experiment,
                            const Provenance& provenance) {
  make_folder(folder);
  auto state = std::make_unique<State>(folder, experiment);
  const StudyFiles& files = state->files;
  const std::string text = study_json(experiment, provenance);
  if (!is_study(folder)) {
    check_is_new(folder);
    remove_leftovers(folder);
    write_file(files.study(), text);
    start_lines(files.timings());
    return StudyStore(std::move(state));
  }
  remove_leftovers(folder);
  const std::string old_text = read_file(files.study());
  const Study old = parse_study(old_text, files.study().string());
  if (experiment_json(old.experiment) != experiment_json(experiment))
    throw IoError(folder.string(),
                  fmt::format("holds another experiment ({}); choose another folder or remove it",
                              difference(old.experiment, experiment)));
  if (old.provenance.solver_digest != provenance.solver_digest) {
    remove_runs(files);
    state->is_redone = true;
  }
  if (old_text != text) write_file(files.study(), text);
  mend_lines(files.timings());
  start_lines(files.timings());
  return StudyStore(std::move(state));
}

bool StudyStore::redone() const { return state_->is_redone; }

std::vector<RunId> StudyStore::finished() const {
  std::vector<RunId> runs = state_->files.listed_runs();
  std::erase_if(runs, [&](const RunId& id) {
    return !contains(state_->experiment, id) || !is_whole(state_->files, id);
  });
  return runs;
}

void StudyStore::write(const RunResult& result) {
  const RunId id = result.run.id;
  if (!contains(state_->experiment, id))
    throw InvalidInput(
        fmt::format("{} is no run of the experiment {}", slug(id), state_->experiment.name));
  write_file(state_->files.map(id), maps_json({.run = id, .maps = result.maps}));
  write_file(state_->files.detail(id), details_json(result.details));
  write_file(state_->files.run(id), run_json(result.run));
  std::string lines;
  for (const Timing& timing : result.timings) lines += timing_line(timing);
  const std::lock_guard guard(state_->timings_mutex);
  append_file(state_->files.timings(), lines);
}

void StudyStore::write_session(const Session& session) {
  const std::lock_guard guard(state_->timings_mutex);
  append_file(state_->files.timings(), session_line(session));
}

}  // namespace mapproof
