#pragma once

#include <vector>

#include "core/model/given_path.hpp"
#include "core/model/map_record.hpp"
#include "core/results/results_study.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {

/// The maps, each landmark's error as a line where the ground truth is known, and the paths beside
/// theirs: maps as they were given, paths as their alignment says. Several maps of one world stand
/// together before them, with the same limits, the best first. Without either the group is empty.
FigureGroup given_figures(const ResultsStudy& study, const std::vector<MapRecord>& maps,
                          const std::vector<GivenPath>& paths);

}  // namespace mapproof
