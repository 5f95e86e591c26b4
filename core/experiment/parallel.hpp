#pragma once

#include <functional>
#include <mutex>
#include <vector>

#include "core/base/parallel.hpp"
#include "core/experiment/run_experiment.hpp"

namespace mapproof {

/// Calls `work` for each item, `jobs` at a time, in any order, and counts it in `state.finished`.
/// @param jobs      Threads, >= 1; more than there are cores are granted too, since the answer must
///                  not depend on them.
/// @param progress  Called after each item, one call at a time.
template <typename Item, typename Work>
void for_each_in_parallel(const std::vector<Item>& items, int jobs, Progress& state,
                          const std::function<void(const Progress&)>& progress, const Work& work) {
  std::mutex reporting;
  parallel_for(jobs, items.size(), [&](std::size_t i) {
    work(items[i]);
    const std::lock_guard lock(reporting);
    ++state.finished;
    progress(state);
  });
}

}  // namespace mapproof
