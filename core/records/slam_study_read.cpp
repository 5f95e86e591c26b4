#include <algorithm>
#include <map>
#include <system_error>
#include <tuple>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/records/slam_files.hpp"
#include "core/records/slam_run_json.hpp"
#include "core/records/slam_store.hpp"
#include "core/records/space_run_json.hpp"
#include "core/records/study_store.hpp"
#include "core/records/timings_jsonl.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

bool run_is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

/// The run of that id, if it was made. @throws IoError if it is damaged.
std::optional<SlamRun> read_run(const SlamFiles& files, const std::string& id) {
  const fs::path path = files.run(id);
  if (!run_is_there(path)) return std::nullopt;
  SlamRun run = parse_slam_run(read_file(path), path.string());
  if (run.id != id) throw IoError(path.string(), "/id", "says that it is " + run.id);
  return run;
}

void read_runs(const SlamFiles& files, const SlamExperiment& experiment, SlamStudy& study) {
  if (experiment.example)
    if (auto run = read_run(files, experiment.example->noise.id))
      study.runs.push_back(*std::move(run));
  for (const SlamDataSet& set : experiment.data) {
    if (auto run = read_run(files, set.id))
      study.runs.push_back(*std::move(run));
    else
      study.missing.push_back(missing_sentence(set));
  }
}

void read_convergence(const SlamFiles& files, const SlamExperiment& experiment, SlamStudy& study) {
  if (!experiment.convergence) return;
  for (const RangeNoiseModel& noise : experiment.convergence->noises) {
    const fs::path path = files.curve(noise.id);
    if (!run_is_there(path)) continue;
    study.convergence.push_back(parse_convergence(read_file(path), path.string()));
    if (study.convergence.back().id != noise.id)
      throw IoError(path.string(), "/id", "says that it is " + study.convergence.back().id);
  }
}

}  // namespace

bool is_slam_study(const fs::path& folder) { return study_schema(folder) == "mapproof.slam_study"; }

SlamStudy read_slam_study(const fs::path& folder) {
  const SlamFiles files{folder};
  if (!run_is_there(folder)) throw IoError(folder.string(), "does not exist");
  if (!is_study(folder)) throw IoError(folder.string(), "holds no study: study.json is missing");
  SlamOrder order = parse_slam_study(read_file(files.study()), files.study().string());
  SlamStudy study;
  study.name = order.experiment.name;
  study.title = order.experiment.title;
  study.facts = facts_of(order.experiment);
  study.seed = order.experiment.seed;
  study.provenance = std::move(order.provenance);
  read_runs(files, order.experiment, study);
  read_convergence(files, order.experiment, study);
  if (order.experiment.histories && run_is_there(files.histories()))
    study.histories =
        parse_range_histories(read_file(files.histories()), files.histories().string());
  if (order.experiment.space && run_is_there(files.space()))
    study.space = parse_space_run(read_file(files.space()), files.space().string());
  return study;
}

SlamTimings read_slam_timings(const fs::path& folder) {
  const fs::path path = SlamFiles{folder}.timings();
  if (!run_is_there(path)) return {};
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
