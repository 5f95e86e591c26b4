#pragma once

#include "core/model/slam/slam_experiment.hpp"
#include "core/model/slam/slam_study.hpp"

namespace mapproof::test {

/// A run with something in every field; what is not known is missing in one field or another.
SlamRun made_up_slam_run(const std::string& id);

ConvergenceCurve made_up_convergence(const std::string& id);

RangeHistoryStudy made_up_histories();

/// With known landmarks a map, with none a failure.
SpaceRun made_up_space_run();

/// One example, one noise model, one data set "drive".
SlamExperiment small_slam_experiment();

}  // namespace mapproof::test
