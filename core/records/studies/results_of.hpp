#pragma once

#include <span>
#include <vector>

#include "core/model/map_record.hpp"
#include "core/model/slam/slam_study.hpp"
#include "core/model/study.hpp"
#include "core/model/topic_study.hpp"
#include "core/results/results_study.hpp"

namespace mapproof {

/// What a study found, as one table in order. Setups are sensors; levels are `steps` and, of a
/// variation, its id; groups are layouts.
Results results_of(const Study& study);

/// Setups are logs, `convergence/NOISE` with `steps` as levels, `histories/range` and
/// `histories/squared`. Of an estimate its own alignment counts: other errors follow from the same
/// path.
Results results_of(const SlamStudy& study);

/// Setups, factors and quantities are the design's; groups are layouts or data sets.
Results results_of(const TopicStudy& study);

/// The same under the labels of its design, for the report.
ResultsStudy labelled_results(const TopicStudy& study);

/// Of one log, of one map.
Results results_of(const SlamRun& run);
Results results_of(const MapRecord& map);

/// The seconds that its parts took, as results: they vary from run to run and stand in no table of
/// results.
std::vector<Result> seconds_of(std::span<const Timing> timings);
std::vector<Result> seconds_of(const SlamTimings& timings);
std::vector<Result> seconds_of(const TopicStudy& study);

}  // namespace mapproof
