#include "core/experiment/run_slam_experiment.hpp"

#include <cmath>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/experiment/parallel.hpp"
#include "core/experiment/slam_run.hpp"
#include "core/experiment/slam_worlds.hpp"
#include "core/records/range_log_files.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// All landmarks whose place was surveyed; empty if there are none.
std::optional<KnownLandmarks> surveyed(const RangeLog& log) {
  if (!log.true_landmarks) return std::nullopt;
  KnownLandmarks known;
  for (Eigen::Index n = 0; n < log.true_landmarks->rows(); ++n)
    if (log.true_landmarks->row(n).allFinite()) known.rows.push_back(n);
  if (known.rows.empty()) return std::nullopt;
  known.positions_m = (*log.true_landmarks)(known.rows, Eigen::all);
  return known;
}

SlamRunResult make_run(const SlamExperiment& experiment, const SlamData::Item& item) {
  SlamRunResult result = make_slam_run(item.set.id, item.log,
                                       {.methods = experiment.methods,
                                        .known = surveyed(item.log),
                                        .random_starts = experiment.random_starts,
                                        .seed = experiment.seed});
  result.run.figure = item.set.figure;
  result.run.published = item.set.published;
  return result;
}

/// A part that has to be made, and its work.
using Part = std::function<void()>;

/// Counts the parts of an experiment and lists those that are not there.
class Parts {
 public:
  void add(bool is_there, Part part) {
    ++total;
    if (is_there)
      ++reused;
    else
      open.push_back(std::move(part));
  }

  std::vector<Part> open;
  int total = 0;
  int reused = 0;
};

Parts parts_of(const SlamExperiment& experiment, const SlamData& data, SlamStore& store) {
  Parts parts;
  for (const SlamData::Item& item : data.logs)
    parts.add(store.has_run(item.set.id, item.log), [&] {
      const SlamRunResult result = make_run(experiment, item);
      store.write(result.run, result.timings);
    });
  if (experiment.convergence)
    for (const RangeNoiseModel& noise : experiment.convergence->noises)
      parts.add(store.has_convergence(noise.id),
                [&] { store.write(make_convergence(experiment, noise)); });
  if (experiment.histories)
    parts.add(store.has_histories(), [&] { store.write(make_histories(experiment)); });
  if (experiment.space)
    parts.add(store.has_space(), [&] { store.write(make_space_run(experiment)); });
  if (experiment.example)
    parts.add(store.has_run(experiment.example->noise.id), [&] {
      std::vector<SlamTiming> timings;
      const SlamRun run = make_example(experiment, timings);
      store.write(run, timings);
    });
  return parts;
}

}  // namespace

SlamData read_slam_data(const SlamExperiment& experiment, const std::optional<fs::path>& folder) {
  SlamData data;
  if (!folder) return data;
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
      data.logs.push_back({.set = set, .log = read_range_log(*folder / file, options)});
      break;
    }
  if (data.logs.empty())
    throw IoError(folder->string(),
                  fmt::format("holds none of the experiment's data: {}", fmt::join(tried, ", ")));
  return data;
}

void run_slam_experiment(const SlamExperiment& experiment, const SlamData& data, SlamStore& store,
                         int jobs, const std::function<void(const Progress&)>& progress) {
  if (jobs < 1) throw InvalidInput("at least one job is needed");
  const Parts parts = parts_of(experiment, data, store);
  Progress state{
      .finished = parts.reused, .reused = parts.reused, .total = parts.total, .noun = "parts"};
  progress(state);

  for_each_in_parallel(parts.open, jobs, state, progress, [](const Part& part) { part(); });
  // Alone, so that nothing disturbs the seconds.
  if (!parts.open.empty()) store.write(time_factorization(experiment));
}

}  // namespace mapproof
