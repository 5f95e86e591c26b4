#pragma once

#include <functional>
#include <string_view>

#include "core/model/experiment.hpp"
#include "core/records/study_store.hpp"

namespace mapproof {

/// How far an experiment has come.
struct Progress {
  int finished = 0;  ///< Those whose records are on disk, those of earlier sessions among them.
  int reused = 0;    ///< Of these, the ones that were there at the start.
  int total = 0;
  std::string_view noun = "runs";  ///< What is counted.
};

/// Runs whatever of the experiment the store does not hold yet, `jobs` runs at a time.
///
/// The store ends up the same for any number of jobs and after any interruption.
/// @param jobs      Threads, >= 1.
/// @param progress  Called at the start and after each run, one call at a time.
/// @throws IoError if a record cannot be written; runs already written stay.
void run_experiment(const Experiment& experiment, StudyStore& store, int jobs,
                    const std::function<void(const Progress&)>& progress);

}  // namespace mapproof
