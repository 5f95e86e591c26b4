#include "core/studies/study_plan.hpp"

#include <mutex>

#include "core/base/errors.hpp"
#include "core/base/parallel.hpp"

namespace mapproof {

void run_study(const StudyPlan& plan, StudyWriter& writer, int jobs,
               const std::function<void(const Progress&)>& progress) {
  if (jobs < 1) throw InvalidInput("at least one job is needed");
  std::vector<const Task*> open;
  for (const Task& task : plan.tasks)
    if (!task.is_done(writer.folder())) open.push_back(&task);
  Progress state{.total = static_cast<int>(plan.tasks.size()), .noun = plan.noun};
  state.reused = state.finished = state.total - static_cast<int>(open.size());
  progress(state);

  std::mutex reporting;
  parallel_for(jobs, open.size(), [&](std::size_t i) {
    writer.write(open[i]->make());
    const std::lock_guard lock(reporting);
    ++state.finished;
    progress(state);
  });
  if (plan.last && !open.empty()) writer.write(plan.last());
}

}  // namespace mapproof
