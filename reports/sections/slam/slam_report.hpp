#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/model/slam/slam_study.hpp"
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

/// What the study found on each log, in short.
Section slam_summary_section(const SlamStudy& study);

/// Empty if nothing was simulated.
std::optional<Section> slam_simulation_section(const SlamStudy& study, const FigureGroup* figures);

/// Errors of all methods on all logs of real robots; empty without such a log.
std::optional<Section> slam_accuracy_section(const SlamStudy& study);

/// Its sections alone, for a report with others: ids of sections and tables begin with
/// "slam-", but for the paper's "table-plaza".
std::vector<Section> slam_sections(const SlamReportInput& input);

/// What the reader is to see first.
Opening slam_opening(const SlamStudy& study, const StudyFigures& figures);
Section slam_statuses_section(const SlamStudy& study);
Section slam_provenance_section(const SlamReportInput& input);

}  // namespace mapproof
