#include "app/study_run.hpp"

#include <chrono>
#include <ctime>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include "app/build_facts.hpp"
#include "app/progress_line.hpp"
#include "app/result_json.hpp"
#include "app/slam_result.hpp"
#include "core/base/version.hpp"
#include "core/experiment/run_experiment.hpp"
#include "core/records/results_table.hpp"
#include "core/records/slam_store.hpp"
#include "core/records/study_store.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/study_counts.hpp"

namespace mapproof {
namespace {

std::string host_name() {
  char name[256] = "";
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "";
}

std::optional<double> peak_memory_mib() {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return std::nullopt;
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux counts in KiB.
}

/// When a session began.
struct Stopwatch {
  using Clock = std::chrono::steady_clock;
  Clock::time_point start = Clock::now();
  std::string started_utc = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));

  double seconds() const { return std::chrono::duration<double>(Clock::now() - start).count(); }
};

/// Makes what a study lacks, with a progress line, and notes the session.
/// @param run  Takes the function that is told of progress.
template <typename Store, typename Run>
void finish(Store& store, const std::filesystem::path& folder, int jobs, const std::string& command,
            const Console& console, const Stopwatch& watch, Run run) {
  if (store.redone())
    console.warning(fmt::format("{}: its records were made by another solver; they are made again",
                                folder.string()));
  ProgressLine line(!console.is_quiet());
  Progress last;
  run([&](const Progress& progress) {
    last = progress;
    line(progress);
  });
  if (last.reused < last.total)
    store.write_session({.command = command,
                         .started_utc = watch.started_utc,
                         .host = host_name(),
                         .jobs = jobs,
                         .seconds = watch.seconds(),
                         .peak_memory_mib = peak_memory_mib()});
  write_results_table(folder);
  console.detail(fmt::format("{}: solver {}, commit {}, {} jobs, {:.2f} s", folder.string(),
                             solver_digest().substr(0, 12), source_commit(), jobs,
                             watch.seconds()));
  console.info(fmt::format("{}: {} {}, {} of them reused", folder.string(), last.total, last.noun,
                           last.reused));
}

/// Calls `use` with the best setting of each method and sensor at its last checkpoint.
template <typename Use>
void for_each_result(const Study& study, Use use) {
  for (const SensorStudy& sensor : study.experiment.sensors)
    for (const SettingSummary& summary :
         best_of_each_method(summarize(study, sensor, last_step(sensor))))
      use(summary);
}

/// A map that came out arbitrary may be 1e14 m off.
std::string plain_or_power(double metres) {
  return metres < 1e4 ? fmt::format("{:.4f}", metres) : fmt::format("{:.4g}", metres);
}

nlohmann::ordered_json number(const std::optional<MeanEstimate>& estimate) {
  return estimate ? nlohmann::ordered_json(estimate->mean) : nlohmann::ordered_json(nullptr);
}

}  // namespace

void make_records(const Experiment& experiment, const std::filesystem::path& folder, int jobs,
                  const std::string& command, const Console& console) {
  const Stopwatch watch;
  StudyStore store = StudyStore::open(folder, experiment, build_provenance());
  finish(store, folder, jobs, command, console, watch,
         [&](const auto& progress) { run_experiment(experiment, store, jobs, progress); });
}

void make_slam_records(const SlamExperiment& experiment, const SlamData& data,
                       const std::filesystem::path& folder, int jobs, const std::string& command,
                       const Console& console) {
  const Stopwatch watch;
  for (const SlamData::Item& item : data.logs)
    for (const std::string& remark : item.log.remarks)
      console.detail(item.set.title + ": " + remark);
  SlamStore store = SlamStore::open(folder, experiment, build_provenance());
  finish(store, folder, jobs, command, console, watch, [&](const auto& progress) {
    run_slam_experiment(experiment, data, store, jobs, progress);
  });
}

void make_trial_records(const TrialOrder& order, const std::filesystem::path& folder, int jobs,
                        const std::string& command, const Console& console) {
  const Stopwatch watch;
  TrialStore store = TrialStore::open(folder, planned_study(order.experiment, build_provenance()));
  finish(store, folder, jobs, command, console, watch,
         [&](const auto& progress) { run_trials(order, store, jobs, progress); });
}

nlohmann::ordered_json study_result(const Study& study) {
  const StudyCounts counts = count(study);
  nlohmann::ordered_json object{{"experiment", study.experiment.name},
                                {"seed", study.experiment.seed},
                                {"runs", study.runs.size()},
                                {"records", counts.maps},
                                {"records_with_status", counts.with_status},
                                {"results", nlohmann::ordered_json::array()}};
  for_each_result(study, [&](const SettingSummary& result) {
    object["results"].push_back({{"sensor", name(result.sensor)},
                                 {"method", info(result.setting.method).name},
                                 {"parameter", parameter_json(result.setting)},
                                 {"step", result.step},
                                 {"mpe_m", number(result.mpe_m)},
                                 {"moe_percent", number(result.moe_percent)}});
  });
  return object;
}

std::string study_text(const Study& study) {
  std::string text;
  for_each_result(study, [&](const SettingSummary& result) {
    text += fmt::format("{:<10}  {:<28}", name(result.sensor), label(result.setting));
    text += result.mpe_m && result.moe_percent
                ? fmt::format("  MPE {} m  MOE {:5.2f} %\n", plain_or_power(result.mpe_m->mean),
                              result.moe_percent->mean)
                : std::string("  no map\n");
  });
  return text;
}

nlohmann::ordered_json slam_study_result(const SlamStudy& study) {
  nlohmann::ordered_json object{{"experiment", study.name},
                                {"seed", study.seed},
                                {"runs", study.runs.size()},
                                {"missing", study.missing},
                                {"results", nlohmann::ordered_json::array()}};
  for (const SlamRun& run : study.runs)
    for (const SlamRecord& record : run.records) {
      nlohmann::ordered_json result{{"run", run.id}, {"method", info(record.method).name}};
      put_slam_errors(result, record);
      object["results"].push_back(std::move(result));
    }
  return object;
}

std::string slam_study_text(const SlamStudy& study) {
  std::string text;
  for (const SlamRun& run : study.runs)
    for (const SlamRecord& record : run.records)
      text += fmt::format("{:<10}  {}\n", run.id, slam_record_text(record));
  return text;
}

}  // namespace mapproof
