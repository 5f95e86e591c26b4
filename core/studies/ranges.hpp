#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/model/slam/slam_experiment.hpp"
#include "core/studies/study_kind.hpp"

namespace mapproof {

/// A data set of an experiment that is there.
struct LogOfSet {
  SlamDataSet set;
  RangeLog log;
};

/// The logs of an experiment's data sets that a folder has; none without a folder.
/// @throws IoError if a log cannot be read, or the folder holds none of them.
std::vector<LogOfSet> read_logs(const SlamExperiment& experiment,
                                const std::optional<std::filesystem::path>& folder);

}  // namespace mapproof
