#include "core/records/trial_store.hpp"

#include <algorithm>
#include <mutex>
#include <system_error>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/records/folder_lock.hpp"
#include "core/records/study_folder.hpp"
#include "core/records/study_store.hpp"
#include "core/records/timings_jsonl.hpp"
#include "core/records/trial_experiment_json.hpp"
#include "core/records/trial_json.hpp"

namespace mapproof {

/// Where things stand in the folder of a study of trials.
struct TrialFiles {
  std::filesystem::path folder;

  std::filesystem::path study() const { return folder / "study.json"; }
  std::filesystem::path timings() const { return folder / "timings.jsonl"; }
  std::filesystem::path parts() const { return folder / "parts"; }
  std::filesystem::path part(const std::string& id) const { return parts() / (id + ".json"); }
};

namespace {

namespace fs = std::filesystem;

StudyHead read_trial_head(const std::string& text, const std::string& source) {
  const TrialStudy study = parse_trial_study(text, source);
  return {.experiment = trial_experiment_value(study.experiment),
          .solver_digest = study.provenance.solver_digest};
}

/// The parts that there can be, in their order.
std::vector<std::string> part_ids(const TrialExperiment& experiment) {
  std::vector<std::string> ids;
  if (!experiment.data.empty()) {
    for (const TrialDataSet& set : experiment.data) ids.push_back(set.id);
    return ids;
  }
  for (int layout = 1; layout <= experiment.layouts; ++layout)
    for (int pose = 1; pose <= experiment.poses; ++pose)
      ids.push_back(slug(RunId{.layout = layout, .pose = pose}));
  return ids;
}

/// Of a series timed twice on a part the later one.
void add_seconds(const fs::path& path, TrialStudy& study) {
  std::error_code error;
  if (!fs::exists(path, error)) return;
  for (const TrialSeconds& timing : parse_timings(read_file(path), path.string()).trials) {
    const auto part = std::ranges::find(study.parts, timing.part, &TrialPart::id);
    if (part == study.parts.end()) continue;
    const auto known = std::ranges::find(part->seconds, timing.series, &TrialSeconds::series);
    if (known == part->seconds.end())
      part->seconds.push_back(timing);
    else
      *known = timing;
  }
}

}  // namespace

struct TrialStore::State {
  State(const fs::path& folder, TrialDesign asked)
      : files{folder}, lock(folder), design(std::move(asked)) {}

  void append(const std::string& lines) {
    const std::lock_guard guard(mutex);
    append_file(files.timings(), lines);
  }

  TrialFiles files;
  FolderLock lock;
  TrialDesign design;
  bool is_redone = false;
  std::mutex mutex;
};

TrialStore::TrialStore(std::unique_ptr<State> state) : state_(std::move(state)) {}
TrialStore::TrialStore(TrialStore&&) noexcept = default;
TrialStore& TrialStore::operator=(TrialStore&&) noexcept = default;
TrialStore::~TrialStore() = default;

TrialStore TrialStore::open(const fs::path& folder, const TrialStudy& study) {
  make_folder(folder);
  auto state = std::make_unique<State>(folder, study.design);
  state->is_redone =
      take_up_study(folder, trial_study_json(study), read_trial_head,
                    {state->files.parts(), state->files.timings(), folder / "results.csv"});
  return TrialStore(std::move(state));
}

bool TrialStore::redone() const { return state_->is_redone; }

bool TrialStore::has(const std::string& part, const std::string& digest) const {
  const fs::path path = state_->files.part(part);
  try {
    const ReadTrialPart read = parse_trial_part(read_file(path), path.string(), &state_->design);
    return read.part.id == part && read.digest == digest;
  } catch (const IoError&) {
    return false;
  }
}

void TrialStore::write(const TrialPart& part, const std::string& digest) {
  make_folder(state_->files.parts());
  write_file(state_->files.part(part.id), trial_part_json(part, digest));
  std::string lines;
  for (const TrialSeconds& timing : part.seconds) lines += timing_line(timing);
  state_->append(lines);
}

void TrialStore::write_session(const Session& session) { state_->append(session_line(session)); }

bool is_trial_study(const fs::path& folder) {
  return study_schema(folder) == "mapproof.trial_study";
}

TrialStudy read_trial_study(const fs::path& folder) {
  const TrialFiles files{folder};
  if (!is_study(folder)) throw IoError(folder.string(), "holds no study: study.json is missing");
  TrialStudy study = parse_trial_study(read_file(files.study()), files.study().string());
  for (const std::string& id : part_ids(study.experiment)) {
    const fs::path path = files.part(id);
    std::error_code error;
    if (!fs::exists(path, error)) continue;
    study.parts.push_back(parse_trial_part(read_file(path), path.string(), &study.design).part);
    if (study.parts.back().id != id)
      throw IoError(path.string(), "/id", "says that it is " + study.parts.back().id);
  }
  add_seconds(files.timings(), study);
  return study;
}

}  // namespace mapproof
