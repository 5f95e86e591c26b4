#include "core/records/study_store.hpp"

#include <algorithm>
#include <mutex>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/records/experiment_values.hpp"
#include "core/records/folder_lock.hpp"
#include "core/records/run_json.hpp"
#include "core/records/study_files.hpp"
#include "core/records/study_folder.hpp"
#include "core/records/timings_jsonl.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

StudyHead read_study_head(const std::string& text, const std::string& source) {
  const Study study = parse_study(text, source);
  return {.experiment = experiment_value(study.experiment),
          .solver_digest = study.provenance.solver_digest};
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
  state->is_redone = take_up_study(
      folder, study_json(experiment, provenance), read_study_head,
      {files.runs(), files.maps(), files.details(), files.timings(), files.results()});
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
