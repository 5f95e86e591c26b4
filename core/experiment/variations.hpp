#pragma once

#include <vector>

#include "core/model/experiment.hpp"
#include "core/model/study.hpp"
#include "core/model/world.hpp"

namespace mapproof {

/// Makes the maps of every variation of the experiment for one run and scores them.
///
/// The levels of a variation share their random numbers: a higher noise level is the same noise,
/// larger. Variations of the anchors and of the solver share one history over all levels.
/// @param run   Its world and anchors are read.
/// @param path  As long as the latest step of any variation, or longer.
/// @return In order of variation, level, setting.
std::vector<VariationRecord> vary(const Experiment& experiment, const Run& run, const Path& path);

}  // namespace mapproof
