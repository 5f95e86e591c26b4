#pragma once

#include "core/model/slam/slam_study.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {

/// The figures of a range-only study, in the order of its report; those that the values do not
/// allow are left out. docs/figures.md lists their ids. The groups are the sections that show them.
StudyFigures slam_figures(const SlamStudy& study, const SlamTimings& timings);

/// Ids of the groups, and of the sections that show them.
inline constexpr const char* kSlamSimulation = "slam-simulation";
inline constexpr const char* kSlamFit = "slam-fit-";  ///< Begins the ids of groups of tests.
inline constexpr const char* kSlamRun = "slam-run-";  ///< Begins the ids of groups of drives.
inline constexpr const char* kSlamHistories = "slam-histories";
inline constexpr const char* kSlamSpace = "slam-space";
inline constexpr const char* kSlamCost = "slam-cost";
std::string slam_run_group(const SlamRun& run);  ///< "slam-run-plaza-1".
std::string slam_fit_group(const SlamRun& run);  ///< "slam-fit-plaza-1".

}  // namespace mapproof
