#pragma once

#include <optional>

#include "core/model/slam_study.hpp"
#include "reports/model/report.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {

/// What the study found on each log, in short.
Section slam_summary_section(const SlamStudy& study);

/// Errors of all methods on all logs of real robots; empty without such a log.
std::optional<Section> slam_accuracy_section(const SlamStudy& study);

/// One log of a real robot.
Section slam_run_section(const SlamRun& run, const FigureGroup* figures);

/// Empty if nothing was simulated.
std::optional<Section> slam_simulation_section(const SlamStudy& study, const FigureGroup* figures);

}  // namespace mapproof
