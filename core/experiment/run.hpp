#pragma once

#include "core/model/experiment.hpp"
#include "core/records/study_store.hpp"

namespace mapproof {

/// All runs of an experiment, ascending.
std::vector<RunId> runs_of(const Experiment& experiment);

/// One run: scatters the landmarks, walks, observes, maps and scores at every checkpoint
/// [yairi2007, section 3].
///
/// Pure but for the timings: the same experiment and id give the same records and maps. The world
/// depends on the seed and the layout alone, the walk on the pose too, and a sensor's noise on the
/// sensor too, so that adding a sensor or a method changes nothing else.
/// @throws InvalidInput if the landmarks do not fit the room or a sensor has no checkpoint.
RunResult simulate_run(const Experiment& experiment, const RunId& id);

}  // namespace mapproof
