#include "core/experiment/run_experiment.hpp"

#include <algorithm>
#include <mutex>

#include <tbb/global_control.h>
#include <tbb/parallel_for_each.h>
#include <tbb/task_arena.h>

#include "core/base/errors.hpp"
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

  std::mutex reporting;
  // More threads than cores are granted too: the answer must not depend on them.
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(jobs));
  tbb::task_arena arena(jobs);
  arena.execute([&] {
    tbb::parallel_for_each(open, [&](const RunId& id) {
      store.write(simulate_run(experiment, id));
      const std::lock_guard lock(reporting);
      ++state.finished;
      progress(state);
    });
  });
}

}  // namespace mapproof
