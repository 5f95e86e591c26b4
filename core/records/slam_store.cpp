#include "core/records/slam_store.hpp"

#include <mutex>
#include <system_error>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/json/json_text.hpp"
#include "core/records/folder_lock.hpp"
#include "core/records/slam_experiment_json.hpp"
#include "core/records/slam_files.hpp"
#include "core/records/slam_run_json.hpp"
#include "core/records/slam_values.hpp"
#include "core/records/space_run_json.hpp"
#include "core/records/study_folder.hpp"
#include "core/records/timings_jsonl.hpp"
#include "core/records/trajectory_files.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

StudyHead read_slam_head(const std::string& text, const std::string& source) {
  const SlamOrder order = parse_slam_study(text, source);
  return {.experiment = slam_experiment_value(order.experiment),
          .solver_digest = order.provenance.solver_digest};
}

/// Whether a file can be read as what it should be.
template <typename Check>
bool is_whole(const fs::path& path, Check check) {
  try {
    return check(read_file(path), path.string());
  } catch (const IoError&) {
    return false;
  }
}

void write_path(const Trajectory& path, const fs::path& folder, std::string_view name) {
  write_file(folder / (std::string(name) + ".tum"), trajectory_tum(path));
  write_file(folder / (std::string(name) + ".csv"), trajectory_csv(path));
}

template <typename Item>
std::string lines_of(std::span<const Item> items) {
  std::string lines;
  for (const Item& item : items) lines += timing_line(item);
  return lines;
}

}  // namespace

struct SlamStore::State {
  explicit State(const fs::path& folder) : files{folder}, lock(folder) {}

  void append(const std::string& lines) {
    const std::lock_guard guard(mutex);
    append_file(files.timings(), lines);
  }

  SlamFiles files;
  FolderLock lock;
  bool is_redone = false;
  std::mutex mutex;
};

SlamStore::SlamStore(std::unique_ptr<State> state) : state_(std::move(state)) {}
SlamStore::SlamStore(SlamStore&&) noexcept = default;
SlamStore& SlamStore::operator=(SlamStore&&) noexcept = default;
SlamStore::~SlamStore() = default;

SlamStore SlamStore::open(const fs::path& folder, const SlamExperiment& experiment,
                          const Provenance& provenance) {
  make_folder(folder);
  auto state = std::make_unique<State>(folder);
  const SlamFiles& files = state->files;
  state->is_redone = take_up_study(folder, slam_study_json(experiment, provenance), read_slam_head,
                                   {files.runs(), files.paths(), files.curves(), files.histories(),
                                    files.space(), files.timings(), files.results()});
  return SlamStore(std::move(state));
}

bool SlamStore::redone() const { return state_->is_redone; }

bool SlamStore::has_run(const std::string& id, const RangeLog& log) const {
  return is_whole(state_->files.run(id), [&](const std::string& text, const std::string& source) {
    const SlamRun run = parse_slam_run(text, source);
    return run.id == id && range_log_value(run.log) == range_log_value(log);
  });
}

bool SlamStore::has_run(const std::string& id) const {
  return is_whole(state_->files.run(id), [&](const std::string& text, const std::string& source) {
    return parse_slam_run(text, source).id == id;
  });
}

bool SlamStore::has_convergence(const std::string& id) const {
  return is_whole(state_->files.curve(id), [&](const std::string& text, const std::string& source) {
    return parse_convergence(text, source).id == id;
  });
}

bool SlamStore::has_histories() const {
  return is_whole(state_->files.histories(),
                  [](const std::string& text, const std::string& source) {
                    parse_range_histories(text, source);
                    return true;
                  });
}

bool SlamStore::has_space() const {
  return is_whole(state_->files.space(), [](const std::string& text, const std::string& source) {
    parse_space_run(text, source);
    return true;
  });
}

void SlamStore::write(const SlamRun& run, std::span<const SlamTiming> timings) {
  write_paths(run, state_->files.paths(run.id));
  write_file(state_->files.run(run.id), slam_run_json(run));
  state_->append(lines_of(timings));
}

void SlamStore::write(const ConvergenceCurve& curve) {
  write_file(state_->files.curve(curve.id), convergence_json(curve));
}

void SlamStore::write(const RangeHistoryStudy& histories) {
  write_file(state_->files.histories(), range_histories_json(histories));
}

void SlamStore::write(const SpaceRun& space) {
  write_file(state_->files.space(), space_run_json(space));
}

void SlamStore::write(std::span<const FactorizationCost> costs) { state_->append(lines_of(costs)); }

void SlamStore::write_session(const Session& session) { state_->append(session_line(session)); }

void write_paths(const SlamRun& run, const fs::path& folder) {
  // A method that gives no path now may have given one before.
  std::error_code error;
  fs::remove_all(folder, error);
  if (error) throw IoError(folder.string(), "cannot be removed: " + error.message());
  if (run.log.truth) write_path(*run.log.truth, folder, "truth");
  for (const SlamRecord& record : run.records)
    if (record.estimate.path.size() > 0)
      write_path(record.estimate.path, folder, info(record.method).name);
}

}  // namespace mapproof
