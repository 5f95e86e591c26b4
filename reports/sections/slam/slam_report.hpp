#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/model/slam_study.hpp"
#include "reports/model/report.hpp"
#include "reports/sections/slam/slam_figures.hpp"

namespace mapproof {

struct SlamReportInput {
  const SlamStudy& study;
  std::span<const Session> sessions;
  const SlamTimings& timings;
  const StudyFigures& figures;  ///< slam_figures() of the two.
  std::string command;          ///< The one that makes this study and report again.
};

/// The whole report of a range-only study.
Report slam_report(const SlamReportInput& input);

/// Its sections alone, for a report with others: ids of sections and tables begin with
/// "slam-", but for the paper's "table-plaza".
std::vector<Section> slam_sections(const SlamReportInput& input);

/// The parts, each a pure function of the values.
Section slam_summary_section(const SlamStudy& study);
/// What the reader is to see first.
Opening slam_opening(const SlamStudy& study, const StudyFigures& figures);
/// Errors of all methods on all logs of real robots; empty without such a log.
std::optional<Section> slam_accuracy_section(const SlamStudy& study);
/// One log of a real robot.
Section slam_run_section(const SlamRun& run, const FigureGroup* figures);
/// Empty if nothing was simulated.
std::optional<Section> slam_simulation_section(const SlamStudy& study, const FigureGroup* figures);
Section slam_statuses_section(const SlamStudy& study);
Section slam_provenance_section(const SlamReportInput& input);

}  // namespace mapproof
