#include "core/experiment/run_experiment.hpp"

#include <algorithm>

#include "core/base/errors.hpp"
#include "core/experiment/parallel.hpp"
#include "core/experiment/run.hpp"

namespace mapproof {

void run_experiment(const Experiment& experiment, StudyStore& store, int jobs,
                    const std::function<void(const Progress&)>& progress) {
  if (jobs < 1) throw InvalidInput("at least one job is needed");
  std::vector<RunId> open = runs_of(experiment);
  Progress state{.total = static_cast<int>(open.size())};
  const std::vector<RunId> finished = store.finished();
  std::erase_if(open,
                [&](const RunId& id) { return std::ranges::find(finished, id) != finished.end(); });
  state.reused = state.finished = state.total - static_cast<int>(open.size());
  progress(state);

  for_each_in_parallel(open, jobs, state, progress,
                       [&](const RunId& id) { store.write(simulate_run(experiment, id)); });
}

}  // namespace mapproof
