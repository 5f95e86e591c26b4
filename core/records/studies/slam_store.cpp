#include "core/records/studies/slam_store.hpp"

#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/paths.hpp"
#include "core/json/record_reader.hpp"
#include "core/json/record_writer.hpp"
#include "core/records/experiments/slam_experiment_json.hpp"
#include "core/records/observations/trajectories.hpp"
#include "core/records/studies/slam_fields.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/records/studies/timings_jsonl.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

StudyHead read_slam_head(const std::string& text, const std::string& source) {
  const SlamStudyStart start = parse_slam_study(text, source);
  return {.experiment = to_json_value(start.experiment).dump(),
          .solver_digest = start.provenance.solver_digest};
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

/// Each path of a run, the true one among them, as NAME.tum and NAME.csv.
std::vector<PartFile> path_files(const SlamRun& run, const fs::path& folder) {
  std::vector<PartFile> files;
  const auto add = [&](const Trajectory& path, std::string_view name) {
    files.push_back({folder / (std::string(name) + ".tum"), trajectory_tum(path)});
    files.push_back({folder / (std::string(name) + ".csv"), trajectory_csv(path)});
  };
  if (run.log.ground_truth) add(*run.log.ground_truth, "groundtruth");
  for (const SlamRecord& record : run.records)
    if (record.estimate.path.size() > 0) add(record.estimate.path, info(record.method).name);
  return files;
}

template <typename Item>
std::string lines_of(std::span<const Item> items) {
  std::string lines;
  for (const Item& item : items) lines += timing_line(item);
  return lines;
}

/// The run of that id, if it was made. @throws IoError if it is damaged.
std::optional<SlamRun> read_slam_run(const SlamFiles& files, const std::string& id) {
  const fs::path path = files.run(id);
  if (!is_there(path)) return std::nullopt;
  SlamRun run = parse_slam_run(read_file(path), path.string());
  if (run.id != id) throw IoError(path.string(), "/id", "states that it is " + run.id);
  return run;
}

void read_runs(const SlamFiles& files, SlamStudy& study) {
  if (const auto& example = study.experiment.example)
    if (auto run = read_slam_run(files, example->noise.id)) study.runs.push_back(*std::move(run));
  for (const SlamDataSet& set : study.experiment.data)
    if (auto run = read_slam_run(files, set.id)) study.runs.push_back(*std::move(run));
}

void read_convergence(const SlamFiles& files, SlamStudy& study) {
  const auto& convergence = study.experiment.convergence;
  if (!convergence) return;
  for (const RangeNoiseModel& noise : convergence->noises) {
    const fs::path path = files.curve(noise.id);
    if (!is_there(path)) continue;
    study.convergence.push_back(parse_convergence(read_file(path), path.string()));
    if (study.convergence.back().id != noise.id)
      throw IoError(path.string(), "/id", "states that it is " + study.convergence.back().id);
  }
}

}  // namespace

std::string slam_run_json(const SlamRun& run) { return to_json_text(run); }

SlamRun parse_slam_run(std::string_view text, const std::string& source) {
  return from_json_text<SlamRun>(text, source);
}

std::string convergence_json(const ConvergenceCurve& curve) { return to_json_text(curve); }

ConvergenceCurve parse_convergence(std::string_view text, const std::string& source) {
  return from_json_text<ConvergenceCurve>(text, source);
}

std::string range_histories_json(const RangeHistoryStudy& histories) {
  return to_json_text(histories);
}

RangeHistoryStudy parse_range_histories(std::string_view text, const std::string& source) {
  return from_json_text<RangeHistoryStudy>(text, source);
}

std::string space_run_json(const SpaceRun& run) { return to_json_text(run); }

SpaceRun parse_space_run(std::string_view text, const std::string& source) {
  return from_json_text<SpaceRun>(text, source);
}

StudyStart study_start(const SlamExperiment& experiment, const Provenance& provenance) {
  return {.text = slam_study_json(experiment, provenance),
          .read_head = read_slam_head,
          .records = SlamFiles{}.records()};
}

StudyPart part_of(const SlamRun& run, std::span<const SlamTiming> timings) {
  const SlamFiles files{};
  // A method that gives no path now may have given one before.
  StudyPart part{.files = path_files(run, files.paths(run.id)),
                 .timings = lines_of(timings),
                 .emptied = files.paths(run.id)};
  part.files.push_back({files.run(run.id), slam_run_json(run)});
  return part;
}

StudyPart part_of(const ConvergenceCurve& curve) {
  return {.files = {{SlamFiles{}.curve(curve.id), convergence_json(curve)}}};
}

StudyPart part_of(const RangeHistoryStudy& histories) {
  return {.files = {{SlamFiles{}.histories(), range_histories_json(histories)}}};
}

StudyPart part_of(const SpaceRun& space) {
  return {.files = {{SlamFiles{}.space(), space_run_json(space)}}};
}

StudyPart part_of(std::span<const FactorizationCost> costs) { return {.timings = lines_of(costs)}; }

bool holds_run(const fs::path& folder, const std::string& id, const RangeLog& log) {
  return is_whole(SlamFiles{folder}.run(id), [&](const auto& text, const auto& source) {
    const SlamRun run = parse_slam_run(text, source);
    return run.id == id && to_json_value(run.log) == to_json_value(log);
  });
}

bool holds_run(const fs::path& folder, const std::string& id) {
  return is_whole(SlamFiles{folder}.run(id), [&](const auto& text, const auto& source) {
    return parse_slam_run(text, source).id == id;
  });
}

bool holds_convergence(const fs::path& folder, const std::string& id) {
  return is_whole(SlamFiles{folder}.curve(id), [&](const auto& text, const auto& source) {
    return parse_convergence(text, source).id == id;
  });
}

bool holds_histories(const fs::path& folder) {
  return is_whole(SlamFiles{folder}.histories(), [](const auto& text, const auto& source) {
    parse_range_histories(text, source);
    return true;
  });
}

bool holds_space(const fs::path& folder) {
  return is_whole(SlamFiles{folder}.space(), [](const auto& text, const auto& source) {
    parse_space_run(text, source);
    return true;
  });
}

void write_paths(const SlamRun& run, const OutputFolder& folder, const fs::path& paths) {
  folder.remove(paths);
  for (const PartFile& file : path_files(run, paths)) folder.write(file.file, file.text);
}

SlamStudy read_slam_study(const fs::path& folder) {
  const SlamFiles files{folder};
  require_study(folder);
  SlamStudyStart start = parse_slam_study(read_file(files.study()), files.study().string());
  SlamStudy study;
  study.experiment = std::move(start.experiment);
  study.provenance = std::move(start.provenance);
  read_runs(files, study);
  read_convergence(files, study);
  if (study.experiment.histories && is_there(files.histories()))
    study.histories =
        parse_range_histories(read_file(files.histories()), files.histories().string());
  if (study.experiment.space && is_there(files.space()))
    study.space = parse_space_run(read_file(files.space()), files.space().string());
  return study;
}

SlamTimings read_slam_timings(const fs::path& folder) {
  const fs::path path = SlamFiles{folder}.timings();
  if (!is_there(path)) return {};
  const Timings all = parse_timings(read_file(path), path.string());
  std::map<std::pair<std::string, SlamMethod>, SlamTiming> methods;
  for (const SlamTiming& timing : all.slam.methods)
    methods.insert_or_assign({timing.run, timing.method}, timing);
  std::map<std::pair<int, long>, FactorizationCost> costs;
  for (const FactorizationCost& cost : all.slam.factorization)
    costs.insert_or_assign({cost.landmarks, cost.steps}, cost);
  SlamTimings last;
  for (const auto& [key, timing] : methods) last.methods.push_back(timing);
  for (const auto& [key, cost] : costs) last.factorization.push_back(cost);
  return last;
}

}  // namespace mapproof
