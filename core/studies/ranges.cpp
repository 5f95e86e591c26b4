#include "core/studies/ranges.hpp"

#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/experiment/slam_run.hpp"
#include "core/experiment/slam_worlds.hpp"
#include "core/records/experiments/profiles.hpp"
#include "core/records/experiments/slam_experiment_json.hpp"
#include "core/records/ranges/range_logs.hpp"
#include "core/records/studies/results_of.hpp"
#include "core/records/studies/slam_store.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/studies/experiment_changes.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// All landmarks whose position was surveyed; empty if there are none.
std::optional<KnownLandmarks> surveyed(const RangeLog& log) {
  if (!log.true_landmarks) return std::nullopt;
  KnownLandmarks known;
  for (Eigen::Index n = 0; n < log.true_landmarks->rows(); ++n)
    if (log.true_landmarks->row(n).allFinite()) known.rows.push_back(n);
  if (known.rows.empty()) return std::nullopt;
  known.positions_m = (*log.true_landmarks)(known.rows, Eigen::all);
  return known;
}

SlamRunResult make_run(const SlamExperiment& experiment, const LogOfSet& item) {
  SlamRunResult result = make_slam_run(item.set.id, item.log,
                                       {.methods = experiment.methods,
                                        .known = surveyed(item.log),
                                        .random_starts = experiment.random_starts,
                                        .seed = experiment.seed});
  result.run.figure = item.set.figure;
  result.run.published = item.set.published;
  return result;
}

/// What the tasks share.
using SharedExperiment = std::shared_ptr<const SlamExperiment>;

void add_log_task(const SharedExperiment& experiment, LogOfSet item, StudyPlan& plan) {
  for (const std::string& remark : item.log.remarks)
    plan.remarks.push_back(item.set.title + ": " + remark);
  const auto log = std::make_shared<const LogOfSet>(std::move(item));
  plan.tasks.push_back(
      {"run " + log->set.id,
       [=](const fs::path& folder) { return holds_run(folder, log->set.id, log->log); },
       [=] {
         const SlamRunResult result = make_run(*experiment, *log);
         return part_of(result.run, result.timings);
       }});
}

void add_simulated_tasks(const SharedExperiment& experiment, StudyPlan& plan) {
  if (experiment->convergence)
    for (const RangeNoiseModel& noise : experiment->convergence->noises)
      plan.tasks.push_back(
          {"convergence " + noise.id,
           [id = noise.id](const fs::path& folder) { return holds_convergence(folder, id); },
           [=] { return part_of(make_convergence(*experiment, noise)); }});
  if (experiment->histories)
    plan.tasks.push_back(
        {"histories", holds_histories, [=] { return part_of(make_histories(*experiment)); }});
  if (experiment->space)
    plan.tasks.push_back(
        {"space", holds_space, [=] { return part_of(make_space_run(*experiment)); }});
  if (experiment->example)
    plan.tasks.push_back({"run " + experiment->example->noise.id,
                          [id = experiment->example->noise.id](const fs::path& folder) {
                            return holds_run(folder, id);
                          },
                          [=] {
                            std::vector<SlamTiming> timings;
                            const SlamRun run = make_example(*experiment, timings);
                            return part_of(run, timings);
                          }});
}

StudyPlan plan_ranges(std::string_view text, const std::string& source,
                      const PlanOptions& options) {
  SlamExperiment read = parse_slam_experiment(text, source, options.profile);
  apply(options.one_of_several ? seed_alone(options.changes) : options.changes, read);
  std::vector<LogOfSet> logs = read_logs(read, options.plaza);
  const auto experiment = std::make_shared<const SlamExperiment>(std::move(read));
  StudyPlan plan{
      .name = experiment->name,
      .seed = experiment->seed,
      .uses_plaza = true,
      .start = [=](const Provenance& made_by) { return study_start(*experiment, made_by); },
      .last = [=] { return part_of(time_factorization(*experiment)); }};
  for (LogOfSet& log : logs) add_log_task(experiment, std::move(log), plan);
  add_simulated_tasks(experiment, plan);
  return plan;
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
          .frame = Frame::kGroundTruth,
          .names = {},
          .points = map.positions_m,
          .ground_truth = study.histories->landmarks_m};
  contents.results = results_of(study);
  if (asked.seconds) contents.seconds = seconds_of(read_slam_timings(folder));
}

void check_slam_experiment_file(std::string_view text, const std::string& source) {
  parse_slam_experiment(text, source);
  for (const std::string& profile : profile_names(text, source, kRangeStudies.experiment))
    parse_slam_experiment(text, source, profile);
}

}  // namespace

std::vector<LogOfSet> read_logs(const SlamExperiment& experiment,
                                const std::optional<fs::path>& folder) {
  std::vector<LogOfSet> logs;
  if (!folder) return logs;
  std::vector<std::string> tried;
  for (const SlamDataSet& set : experiment.data)
    for (const std::string& file : set.files) {
      std::error_code error;
      if (!fs::exists(*folder / file, error)) {
        tried.push_back(file);
        continue;
      }
      RangeLogOptions options;
      options.name = set.title;
      options.keeps_repeats = true;  // The papers count them.
      logs.push_back({.set = set, .log = read_range_log(*folder / file, options)});
      break;
    }
  if (logs.empty())
    throw IoError(folder->string(),
                  fmt::format("holds none of the experiment's data: {}", fmt::join(tried, ", ")));
  return logs;
}

const StudyKind kRangeStudies = {
    .study = "mapproof.slam_study",
    .title = "a range-only study",
    .experiment = "mapproof.slam_experiment",
    .files = {{"mapproof.slam_study",
               [](auto text, auto& source) { parse_slam_study(text, source); }},
              {"mapproof.slam_experiment", check_slam_experiment_file},
              {"mapproof.slam_run", [](auto text, auto& source) { parse_slam_run(text, source); }},
              {"mapproof.slam_convergence",
               [](auto text, auto& source) { parse_convergence(text, source); }},
              {"mapproof.range_histories",
               [](auto text, auto& source) { parse_range_histories(text, source); }},
              {"mapproof.space_run",
               [](auto text, auto& source) { parse_space_run(text, source); }}},
    .records = SlamFiles{}.records(),
    .plan = plan_ranges,
    .start =
        [](auto text, auto& source) {
          const SlamStudyStart study = parse_slam_study(text, source);
          return study_start(study.experiment, study.provenance);
        },
    .read = read_ranges,
    .check =
        [](const fs::path& folder) { return read_slam_study(folder), std::vector<std::string>(); },
};

}  // namespace mapproof
