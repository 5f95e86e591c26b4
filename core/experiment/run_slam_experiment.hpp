#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "core/experiment/run_experiment.hpp"
#include "core/model/slam_experiment.hpp"
#include "core/records/slam_store.hpp"

namespace mapproof {

/// The logs of an experiment's data sets that are there.
struct SlamData {
  struct Item {
    SlamDataSet set;
    RangeLog log;
  };
  std::vector<Item> logs;
};

/// Reads the data sets of an experiment out of a folder.
/// @param folder  Empty: none is there.
/// @throws IoError if a log cannot be read, or the folder holds none of them.
SlamData read_slam_data(const SlamExperiment& experiment,
                        const std::optional<std::filesystem::path>& folder);

/// Makes whatever of the experiment the store does not hold yet, `jobs` parts at a time: a part is
/// a run, a noise model's convergence, or the mapping methods on ranges.
///
/// The store ends up the same for any number of jobs and after any interruption. Data sets that are
/// not there are left as they are.
/// @param jobs      Threads, >= 1.
/// @param progress  Called at the start and after each part, one call at a time.
/// @throws IoError if a record cannot be written; parts already written stay.
void run_slam_experiment(const SlamExperiment& experiment, const SlamData& data, SlamStore& store,
                         int jobs, const std::function<void(const Progress&)>& progress);

}  // namespace mapproof
